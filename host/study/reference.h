// What errors are measured against: a file, or the agreement of two methods that see all.
#pragma once

#include <memory>

#include "study/contender.h"

namespace pellucid {

struct Reference {
  Picture picture;
  std::vector<double> weights;  ///< of relMSE
  StudyReference facts;
  bool read = false;  ///< from a file
};

/// R, G, B of a picture file; its variance from channels variance.R, .G, .B, else taken as 0, which
/// `facts.doubt` says. Throws InputError where size or channels do not fit, or a value is no
/// number.
Reference read_reference(const std::string& file, int width, int height);

/// By two voices with several runs each, as long as `seconds` allow, weighed by their variances;
/// untrusted where their light differs by more than chance. Progress is told by `tell`.
Reference make_reference(Contender& one, Contender& other, std::uint64_t seed, double seconds,
                         const std::function<void(const std::string&)>& tell);

/// By a method that merges, where no other sees all: fixed radii r, r / sqrt 2, r / 2, and the
/// straight line in r^2 of every value continued to 0 [Hachisuka10: bias is of order r^2].
Reference extrapolate_reference(const Contender& merging, double radius, std::uint64_t seed,
                                double seconds,
                                const std::function<void(const std::string&)>& tell);

}  // namespace pellucid
