// Renders on disk, to go on with and to merge: a film of some passes, exactly, with the identity of
// what was rendered. The file is OpenEXR with whole-number channels, whatever its name.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "image/image.h"
#include "render/aov.h"
#include "render/depth_cut.h"
#include "render/diagnostics.h"
#include "render/film.h"
#include "render/integrator.h"

namespace pellucid {

/// All of a checkpoint but its film.
struct CheckpointFacts {
  /// What must agree for films to be of the same picture: name -> value, e.g. "seed" -> "7".
  std::map<std::string, std::string> identity;
  std::map<std::string, MetaValue> evidence;  ///< metadata of the picture so far
  std::vector<Counter> counters = make_counters();
  DepthCuts cuts{};              ///< what --max-depth cut off
  double seconds = 0;            ///< render time of all passes
  std::vector<AovChannel> aovs;  ///< channels beside the film's, which no pass changes
};
struct Checkpoint {
  Film film;
  CheckpointFacts facts;
};

/// Most bytes of host memory per pixel that writing a checkpoint takes beside the film: its words
/// once as planes and once as a file has them.
constexpr std::uint64_t checkpoint_bytes_per_pixel = 2 * sizeof(FilmPixel);

/// Adds those of `more` whose names are not there yet.
void add_missing(std::vector<AovChannel>& channels, const std::vector<AovChannel>& more);

/// Sentence on all in which two identities differ, or "".
std::string difference(const std::map<std::string, std::string>& a,
                       const std::map<std::string, std::string>& b);

/// Appears whole or not at all. Throws OutputError.
void write_checkpoint(const std::string& path, const Film& film, const CheckpointFacts& facts);

/// Throws InputError for what is none, is damaged, or of another version.
Checkpoint read_checkpoint(const std::string& path);

/// Whether the metadata of an image is a checkpoint's.
bool is_checkpoint(const std::map<std::string, MetaValue>& metadata);

/// Adds the passes of `other` to `into`. Throws InputError that names both files where they are of
/// different pictures or share passes.
void merge_checkpoint(Checkpoint& into, const std::string& into_name, const Checkpoint& other,
                      const std::string& other_name);

/// Hash of a method's kernels with all they include: films of different kernels do not mix. Throws
/// InputError where a file is missing.
std::string kernels_hash(const Integrator& integrator, const std::string& kernel_dir);

}  // namespace pellucid
