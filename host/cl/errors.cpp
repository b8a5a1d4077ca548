// Names for OpenCL's status numbers.
#include <fmt/format.h>

#include "base/error.h"
#include "cl/opencl.h"

namespace pellucid {

std::string status_name(int status) {
  switch (status) {
#define STATUS(name) \
  case name:         \
    return fmt::format("{} ({})", #name, status)
    STATUS(CL_DEVICE_NOT_FOUND);
    STATUS(CL_DEVICE_NOT_AVAILABLE);
    STATUS(CL_COMPILER_NOT_AVAILABLE);
    STATUS(CL_MEM_OBJECT_ALLOCATION_FAILURE);
    STATUS(CL_OUT_OF_RESOURCES);
    STATUS(CL_OUT_OF_HOST_MEMORY);
    STATUS(CL_BUILD_PROGRAM_FAILURE);
    STATUS(CL_INVALID_VALUE);
    STATUS(CL_INVALID_BUFFER_SIZE);
    STATUS(CL_INVALID_BINARY);
    STATUS(CL_INVALID_BUILD_OPTIONS);
    STATUS(CL_INVALID_KERNEL_NAME);
    STATUS(CL_INVALID_ARG_INDEX);
    STATUS(CL_INVALID_ARG_VALUE);
    STATUS(CL_INVALID_ARG_SIZE);
    STATUS(CL_INVALID_KERNEL_ARGS);
    STATUS(CL_INVALID_WORK_GROUP_SIZE);
    STATUS(CL_INVALID_COMMAND_QUEUE);
    STATUS(CL_PLATFORM_NOT_FOUND_KHR);
#undef STATUS
    default:
      return fmt::format("OpenCL status {}", status);
  }
}

void throw_device_error(const cl::Error& error, const std::string& what,
                        const std::string& device) {
  const int status = error.err();
  const bool memory = status == CL_MEM_OBJECT_ALLOCATION_FAILURE ||
                      status == CL_OUT_OF_HOST_MEMORY || status == CL_INVALID_BUFFER_SIZE;
  throw DeviceError(fmt::format("{}: {} failed with {} on {}{}", what, error.what(),
                                status_name(status), device,
                                memory ? "; the device has not enough memory for this" : ""));
}

}  // namespace pellucid
