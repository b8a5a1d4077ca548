// Device: context, queue, buffers, programs, launches.
#include "cl/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "base/phase_clock.h"
#include "base/text.h"
#include "cl/opencl.h"

namespace pellucid {

struct Buffer::Impl {
  cl::Buffer buffer;
};
struct Kernel::Impl {
  cl::Kernel kernel;
  std::string device;
};
struct Device::Impl {
  DeviceInfo info;
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;
  std::vector<std::pair<cl::Event, std::shared_ptr<PassTime>>> pending;

  template <typename F>
  auto guarded(const std::string& what, F&& call) {
    try {
      return call();
    } catch (const cl::Error& e) {
      throw_device_error(e, what, info.name);
    }
  }
};

namespace {

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return std::tolower(c); });
  return s;
}

bool matches(const DeviceInfo& info, const std::string& spec) {
  return spec.empty() || spec == info.spec() ||
         (spec.find(':') == std::string::npos &&
          lower(info.name + " " + info.platform_name).find(lower(spec)) != std::string::npos);
}

DeviceInfo choose(const std::string& spec) {
  const std::vector<DeviceInfo> all = list_devices();
  std::string list;
  for (const DeviceInfo& info : all) {
    if (matches(info, spec)) {
      if (info.unusable.empty()) return info;
      if (!spec.empty())
        throw DeviceError(fmt::format("device {} ({}) cannot be used: {}", info.spec(), info.name,
                                      info.unusable));
    }
    list += fmt::format("\n  {}  {}{}", info.spec(), info.name,
                        info.unusable.empty() ? "" : "  (unusable: " + info.unusable + ")");
  }
  throw DeviceError(fmt::format("{}; there are:{}",
                                spec.empty() ? std::string("no OpenCL device here can be used")
                                             : fmt::format("no OpenCL device matches '{}'", spec),
                                list));
}

}  // namespace

void Kernel::set_buffer(unsigned index, const Buffer& buffer) {
  try {
    impl_->kernel.setArg(index, buffer.impl_->buffer);
  } catch (const cl::Error& e) {
    throw_device_error(e, fmt::format("argument {} of {}", index, name_), impl_->device);
  }
}

void Kernel::set_bytes(unsigned index, const void* data, std::size_t bytes) {
  try {
    impl_->kernel.setArg(index, bytes, data);
  } catch (const cl::Error& e) {
    throw_device_error(e, fmt::format("argument {} of {}", index, name_), impl_->device);
  }
}

std::vector<std::string> Kernel::parameter_names() const {
  std::vector<std::string> names;
  const auto count = impl_->kernel.getInfo<CL_KERNEL_NUM_ARGS>();
  for (cl_uint i = 0; i < count; ++i) {
    std::string name = impl_->kernel.getArgInfo<CL_KERNEL_ARG_NAME>(i);
    names.push_back(name.c_str());  // drivers differ on whether the final zero is part of it
  }
  return names;
}

Device Device::open(const std::string& spec) {
  Device out;
  out.impl_ = std::make_shared<Impl>();
  Impl& impl = *out.impl_;
  impl.info = choose(spec);
  impl.guarded("opening the device", [&] {
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    std::vector<cl::Device> devices;
    platforms.at(size_t(impl.info.platform)).getDevices(CL_DEVICE_TYPE_ALL, &devices);
    impl.device = devices.at(size_t(impl.info.index));
    impl.context = cl::Context(impl.device);
    impl.queue = cl::CommandQueue(impl.context, impl.device, CL_QUEUE_PROFILING_ENABLE);
  });
  return out;
}

const DeviceInfo& Device::info() const {
  return impl_->info;
}

Buffer Device::create_buffer(const std::string& name, std::size_t bytes, const void* data) {
  if (bytes > impl_->info.max_buffer)
    throw DeviceError(fmt::format("buffer '{}' needs {}, but one buffer on {} holds at most {}",
                                  name, format_bytes(bytes), impl_->info.name,
                                  format_bytes(impl_->info.max_buffer)));
  Buffer out;
  out.bytes_ = bytes;
  out.impl_ = std::make_shared<Buffer::Impl>();
  impl_->guarded(fmt::format("allocating buffer '{}' ({})", name, format_bytes(bytes)), [&] {
    out.impl_->buffer = cl::Buffer(impl_->context, CL_MEM_READ_WRITE, bytes);
    if (data) {
      impl_->queue.enqueueWriteBuffer(out.impl_->buffer, CL_TRUE, 0, bytes, data);
    } else {
      impl_->queue.enqueueFillBuffer<cl_uchar>(out.impl_->buffer, 0, 0, bytes);
      impl_->queue.finish();
    }
  });
  return out;
}

void Device::read(const Buffer& buffer, void* data, std::size_t bytes) {
  impl_->guarded("reading a buffer", [&] {
    impl_->queue.enqueueReadBuffer(buffer.impl_->buffer, CL_TRUE, 0, bytes, data);
  });
}

void Device::write(const Buffer& buffer, const void* data, std::size_t bytes) {
  impl_->guarded("writing a buffer", [&] {
    impl_->queue.enqueueWriteBuffer(buffer.impl_->buffer, CL_TRUE, 0, bytes, data);
  });
}

Kernel Device::build(const std::string& name, const std::string& source,
                     const std::string& options) {
  const PhaseScope phase(Phase::kernels);
  Kernel out;
  out.name_ = name;
  out.impl_ = std::make_shared<Kernel::Impl>();
  out.impl_->device = impl_->info.name;
  cl::Program program;
  try {
    program = cl::Program(impl_->context, source);
    program.build({impl_->device}, options.c_str());
    out.impl_->kernel = cl::Kernel(program, name.c_str());
    out.max_group_ = out.impl_->kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(impl_->device);
  } catch (const cl::Error& e) {
    std::string log;
    try {
      log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(impl_->device);
    } catch (const cl::Error&) {  // no log: the status must do
    }
    throw DeviceError(
        fmt::format("kernel '{}' does not build on {}: {}\noptions: {}\n{}\n('pellucid kernels "
                    "SCENE --dump DIR' "
                    "writes the exact source)",
                    name, impl_->info.name, status_name(e.err()), options, log));
  }
  return out;
}

void Device::launch(const Kernel& kernel, std::size_t domain, std::size_t group,
                    std::shared_ptr<PassTime> time) {
  const std::size_t global = (domain + group - 1) / group * group;
  impl_->guarded(fmt::format("launching '{}'", kernel.name()), [&] {
    cl::Event event;
    impl_->queue.enqueueNDRangeKernel(kernel.impl_->kernel, cl::NullRange, cl::NDRange(global),
                                      cl::NDRange(group), nullptr, &event);
    if (time) impl_->pending.emplace_back(event, std::move(time));
  });
}

void Device::finish() {
  impl_->guarded("running the queue", [&] {
    impl_->queue.finish();
    for (auto& [event, time] : impl_->pending) {
      const auto start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
      const auto end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
      const double seconds = 1e-9 * static_cast<double>(end - start);
      time->seconds += seconds;
      time->longest = std::max(time->longest, seconds);
      time->longest_lately = std::max(time->longest_lately, seconds);
      ++time->launches;
    }
    impl_->pending.clear();
  });
}

}  // namespace pellucid
