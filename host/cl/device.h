// OpenCL behind a small door: devices, buffers, programs, launches. No other module sees OpenCL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pellucid {

/// What a device is, and why it cannot be used, if so.
struct DeviceInfo {
  int platform = 0, index = 0;  ///< "0:0" as the user names it
  std::string platform_name, name, vendor, version, driver;
  bool cpu = false;
  bool fp64 = false, int64_atomics = false;
  bool rounded_division = false;  ///< correctly rounded float divide and sqrt can be asked for
  int native_float_width = 1;     ///< lanes of the native float vector
  std::uint64_t memory = 0, max_buffer = 0;  ///< bytes; as reported, which is not always the truth
  std::size_t max_group = 1;
  unsigned compute_units = 0;  ///< on CPUs the driver's threads
  std::string unusable;        ///< reason, empty if usable
  std::string spec() const { return std::to_string(platform) + ":" + std::to_string(index); }
};

/// All devices of all platforms. Throws DeviceError (with the remedy) if there is no platform at
/// all.
std::vector<DeviceInfo> list_devices();

/// What the seconds of a CPU device are shared among: its driver's threads, if there are cores for
/// them. 1 at least.
int device_cores(const DeviceInfo& device);

/// Seconds that the device itself spent in launches of one pass.
struct PassTime {
  double seconds = 0;
  double longest = 0, longest_lately = 0;  ///< of one launch; whoever reads the latter clears it
  std::uint64_t launches = 0;
};

class Buffer {
 public:
  std::size_t bytes() const { return bytes_; }

 private:
  friend class Device;
  friend class Kernel;
  struct Impl;
  std::shared_ptr<Impl> impl_;
  std::size_t bytes_ = 0;
};

class Kernel {
 public:
  const std::string& name() const { return name_; }
  /// Largest work-group that this kernel can run in on its device.
  std::size_t max_group() const { return max_group_; }
  void set_buffer(unsigned index, const Buffer& buffer);
  void set_bytes(unsigned index, const void* data, std::size_t bytes);
  /// Parameter names as the device compiler saw them.
  std::vector<std::string> parameter_names() const;

 private:
  friend class Device;
  struct Impl;
  std::shared_ptr<Impl> impl_;
  std::string name_;
  std::size_t max_group_ = 1;
};

/// A device with its context and one in-order queue. All failures are DeviceError with the call,
/// the status and the device.
class Device {
 public:
  /// `spec`: "platform:index", part of a name, or "" for the first usable one. Throws DeviceError
  /// that lists the devices if none matches.
  static Device open(const std::string& spec);

  const DeviceInfo& info() const;

  /// `name` is for messages. `data` may be null: the buffer is then filled with zeros.
  Buffer create_buffer(const std::string& name, std::size_t bytes, const void* data = nullptr);
  void read(const Buffer& buffer, void* data, std::size_t bytes);
  void write(const Buffer& buffer, const void* data, std::size_t bytes);

  /// Compiles `source` and returns its kernel `name`. On failure the message carries the log.
  Kernel build(const std::string& name, const std::string& source, const std::string& options);

  /// Enqueues `kernel` over at least `domain` work-items in groups of `group`; `time` (may be null)
  /// grows at the next finish().
  /// The time is shared: whoever asked may be gone by then, as where an error ends a render.
  void launch(const Kernel& kernel, std::size_t domain, std::size_t group,
              std::shared_ptr<PassTime> time);
  void finish();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace pellucid
