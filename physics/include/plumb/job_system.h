// The one hook through which a world uses threads. An engine passes its own scheduler; the pool
// that comes with Plumb will do otherwise.
#pragma once

#include <cstdint>
#include <memory>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

// A reference to any callable (begin, end), which must outlive the call it is passed to.
class RangeTask {
 public:
  template <class F>
  RangeTask(const F& f)  // NOLINT(google-explicit-constructor): meant to be passed a lambda
      : object_(&f), call_([](const void* object, std::uint32_t begin, std::uint32_t end) {
          (*static_cast<const F*>(object))(begin, end);
        }) {}
  void operator()(std::uint32_t begin, std::uint32_t end) const { call_(object_, begin, end); }

 private:
  const void* object_;
  void (*call_)(const void*, std::uint32_t, std::uint32_t);
};

class JobSystem {
 public:
  virtual ~JobSystem() = default;
  [[nodiscard]] virtual int worker_count() const = 0;  // >= 1, the calling thread included
  // Runs task over [0, count) in chunks of exactly `grain` (the last one may be shorter), in any
  // order on any thread, and returns when all are done. The chunk borders never depend on the
  // number of threads; that is what keeps results bit-identical.
  virtual void parallel_for(std::uint32_t count, std::uint32_t grain, const RangeTask& task) = 0;
};

// threads: 1..256, the calling thread included; 0: as many as the machine has.
std::unique_ptr<JobSystem> make_thread_pool(int threads);

}  // namespace plumb::inline PLUMB_ABI
