// A strict look over OBJ and MTL texts before tinyobjloader reads them: it takes broken numbers for
// zero and skips what it does not know, without a word.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <set>
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

/// A map_Kd line.
struct MtlTexture {
  std::string place;  ///< of the line, for messages
  std::string file;   ///< relative to where the MTL file is
  glm::dvec2 scale{1.0}, offset{0.0};
  bool clamp = false;  ///< else the picture repeats
};

struct MtlScan {
  std::map<std::string, MtlTexture> textures;        ///< by material
  std::set<std::string> coloured;                    ///< materials that have Kd
  std::set<std::string> principled;                  ///< materials that have Pr or Pm
  std::map<std::string, std::string> not_supported;  ///< kind -> file

  /// Adds what another file says; what is there already stays.
  void merge(MtlScan other) {
    textures.merge(other.textures);
    coloured.merge(other.coloured);
    principled.merge(other.principled);
    not_supported.merge(other.not_supported);
  }
};

/// Checks the numbers of an MTL text and collects its textures and the keywords that pellucid has
/// no use for. Comments become blanks.
MtlScan scan_mtl(const std::string& path, std::string& text);

}  // namespace pellucid
