// What errors are measured against: a file, what two methods agree on, or what merging says at
// radius 0.
#pragma once

#include <memory>

#include "study/contender.h"

namespace pellucid {

struct Reference {
  Picture picture;
  std::vector<double> weights;  ///< of relMSE
  StudyReference facts;
};

/// What a file must be a picture of.
struct ReferenceWanted {
  int width = 0, height = 0;
  std::string scene_hash, settings;             ///< as renders store them
  std::uint64_t first_seed = 0, last_seed = 0;  ///< of the study's own runs
};

/// R, G, B of a picture file; its variance from channels variance.R, .G, .B, else it is unknown,
/// which `facts.doubt` says, as it does of another scene's hash; untrusted if made by a method that
/// did not see all paths. Throws InputError where size, depth, filter or channels do not fit, where
/// it shares random numbers with the study, or where a value is no number.
Reference read_reference(const std::string& file, const ReferenceWanted& wanted);

/// By two voices with several runs each, as long as `seconds` allow, weighed by their variances;
/// untrusted where their light differs by more than chance, in all or in any tile. Progress is told
/// by `tell`.
Reference make_reference(Contender& one, Contender& other, std::uint64_t seed, double seconds,
                         const std::function<void(const std::string&)>& tell);

/// Throws InputError if a value is no number.
void require_numbers(const Reference& reference);

/// By an unbiased method that finds some light by chance alone (`by_chance` says which), with one
/// that merges and sees it, from `radius` on, as witness; untrusted where they differ.
Reference confirm_reference(Contender& unbiased, const std::string& by_chance,
                            const Contender& merging, double radius, std::uint64_t seed,
                            double seconds, const std::function<void(const std::string&)>& tell);

/// By a method that merges, where no other sees all: fixed radii r, r / sqrt 2, r / 2, and the
/// straight line in r^2 of every value continued to 0 [Hachisuka10: bias is of order r^2];
/// untrusted where these lie on no straight line.
Reference extrapolate_reference(const Contender& merging, double radius, std::uint64_t seed,
                                double seconds,
                                const std::function<void(const std::string&)>& tell);

}  // namespace pellucid
