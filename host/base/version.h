// What was built, from which commit, with which options; fixed when CMake configures.
#pragma once

namespace pellucid {

const char* version();        ///< "0.1.0"
const char* commit();         ///< git describe, "-dirty" if files differed; "unknown" without git
const char* build_options();  ///< build type, compiler and flags on one line

}  // namespace pellucid
