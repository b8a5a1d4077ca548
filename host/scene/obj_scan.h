// A strict look over OBJ and MTL texts before tinyobjloader reads them: it takes broken numbers for
// zero and skips what it does not know, without a word.
#pragma once

#include <map>
#include <string>

namespace pellucid {

struct ObjScan {
  std::map<std::string, int> materials;              ///< usemtl name -> line of its first use
  int first_face_without_material = 0;               ///< line, 0: every face has a material
  bool names_library = false;                        ///< there is an mtllib line
  std::map<std::string, std::string> not_supported;  ///< kind -> file
};

/// Checks every number, index and keyword of an OBJ text. Throws InputError with file:line.
/// Comments and lines of unknown keywords become blanks: tinyobjloader would read some of them,
/// unchecked.
ObjScan scan_obj(const std::string& path, std::string& text);

/// Checks the numbers of an MTL text and collects the keywords that pellucid has no use for.
/// Comments become blanks.
void scan_mtl(const std::string& path, std::string& text,
              std::map<std::string, std::string>& not_supported);

}  // namespace pellucid
