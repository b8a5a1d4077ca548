// The one include of the OpenCL C++ bindings, for this folder only.
#pragma once

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 110
#include <CL/opencl.hpp>
#include <string>

#include "cl/device.h"

namespace pellucid {

/// "CL_OUT_OF_RESOURCES (-5)".
std::string status_name(int status);

/// What a failed call becomes: `what` says what was being done, on which device.
[[noreturn]] void throw_device_error(const cl::Error& error, const std::string& what,
                                     const std::string& device);

/// Facts of one device.
DeviceInfo describe_device(const cl::Platform& platform, const cl::Device& device,
                           int platform_index, int device_index);

}  // namespace pellucid
