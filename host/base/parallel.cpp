// The limit on threads.
#include "base/parallel.h"

#include <cstdlib>
#include <string>

namespace pellucid {
namespace {

std::atomic<unsigned> limit{0};  // 0: none

}  // namespace

void limit_threads(unsigned count) {
  limit = count;
  const std::string text = std::to_string(count);
  // PoCL's name up to version 3 and from 4 on; whoever calls this wins over the user's environment.
  for (const char* name :
       {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT", "OPENIMAGEIO_THREADS"})
    setenv(name, text.c_str(), 1);
}

unsigned host_threads() {
  return limit > 0 ? limit.load() : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace pellucid
