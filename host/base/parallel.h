// Work on all cores of the host: a range in chunks, or a list of tasks. Results must not depend on
// how the work is cut.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace pellucid {

/// Bounds the threads of this process from now on: our own, and by their environment variables
/// those of libraries that are loaded later (PoCL, OpenImageIO).
void limit_threads(unsigned count);

/// Threads to use for work on the host: all cores, or the limit.
unsigned host_threads();

/// Runs task(i) for i in [0, count) on all cores; the first exception is thrown on after all have
/// ended.
template <typename Task>
void parallel_tasks(std::size_t count, const Task& task) {
  const std::size_t threads = std::min<std::size_t>(host_threads(), count);
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex error_lock;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next.fetch_add(1)) < count;) task(i);
    } catch (...) {
      const std::lock_guard<std::mutex> hold(error_lock);
      if (!error) error = std::current_exception();
    }
  };
  std::vector<std::thread> pool;
  for (std::size_t t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}

/// Cuts [first, first + count) into one chunk per core: chunk(index, begin, end).
template <typename Chunk>
void parallel_chunks(std::size_t first, std::size_t count, std::size_t chunks, const Chunk& chunk) {
  parallel_tasks(chunks, [&](std::size_t i) {
    chunk(i, first + count * i / chunks, first + count * (i + 1) / chunks);
  });
}

}  // namespace pellucid
