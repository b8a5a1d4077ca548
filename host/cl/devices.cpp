// Finding and describing devices.
#include <algorithm>
#include <thread>

#include "base/error.h"
#include "cl/opencl.h"

namespace pellucid {
namespace {

constexpr const char* no_platform =
    "there is no OpenCL platform on this machine: install a driver, e.g. pocl-opencl-icd for CPUs "
    "(./start.sh installs it)";

std::string trimmed(std::string s) {
  while (!s.empty() && (s.back() == '\0' || s.back() == ' ')) s.pop_back();
  s.erase(0, s.find_first_not_of(' '));
  return s;
}

std::string why_unusable(const cl::Device& device) {
  if (!device.getInfo<CL_DEVICE_AVAILABLE>()) return "the driver says it is not available";
  if (!device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>()) return "its driver has no OpenCL C compiler";
  if (!device.getInfo<CL_DEVICE_ENDIAN_LITTLE>()) return "it is big-endian";
  int major = 0, minor = 0;
  const std::string version = device.getInfo<CL_DEVICE_OPENCL_C_VERSION>();
  if (std::sscanf(version.c_str(), "OpenCL C %d.%d", &major, &minor) != 2 ||
      major * 10 + minor < 12)
    return "it offers " + version + ", but OpenCL C 1.2 is needed";
  return "";
}

}  // namespace

DeviceInfo describe_device(const cl::Platform& platform, const cl::Device& device,
                           int platform_index, int device_index) {
  DeviceInfo info;
  info.platform = platform_index;
  info.index = device_index;
  info.platform_name = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
  info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
  info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  info.cpu = device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU;
  const std::string extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
  info.fp64 = extensions.find("cl_khr_fp64") != std::string::npos;
  info.int64_atomics = extensions.find("cl_khr_int64_base_atomics") != std::string::npos;
  info.rounded_division =
      device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
  info.native_float_width = static_cast<int>(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
  info.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.max_buffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.max_group = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.unusable = why_unusable(device);
  return info;
}

int device_cores(const DeviceInfo& device) {
  return int(std::max(1u, std::min(device.compute_units, std::thread::hardware_concurrency())));
}

std::vector<DeviceInfo> list_devices() {
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error& e) {
    throw DeviceError(std::string(no_platform) + " [" + status_name(e.err()) + "]");
  }
  if (platforms.empty()) throw DeviceError(no_platform);
  std::vector<DeviceInfo> all;
  for (size_t p = 0; p < platforms.size(); ++p) {
    std::vector<cl::Device> devices;
    try {
      platforms[p].getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error& e) {
      if (e.err() != CL_DEVICE_NOT_FOUND)
        throw_device_error(e, "listing devices", "platform " + std::to_string(p));
    }
    for (size_t d = 0; d < devices.size(); ++d)
      all.push_back(describe_device(platforms[p], devices[d], int(p), int(d)));
  }
  if (all.empty())
    throw DeviceError(std::string("no OpenCL platform here has a device: ") + no_platform);
  return all;
}

}  // namespace pellucid
