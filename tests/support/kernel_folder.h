// Which kernels tests run: the program's own, or those of a folder in which tests/mutation has
// planted a fault.
#pragma once

#include <cstdlib>
#include <string>

namespace pellucid::test {

/// For PlanOptions.kernel_dir: PELLUCID_TEST_KERNELS, which tests alone know, or nothing.
inline std::string kernel_folder() {
  const char* folder = std::getenv("PELLUCID_TEST_KERNELS");
  return folder ? folder : "";
}

}  // namespace pellucid::test
