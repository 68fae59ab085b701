// The thread pool that comes with Plumb: fixed chunks taken from a counter, a bounded spin, then
// sleep.
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "plumb/job_system.h"

namespace plumb::inline PLUMB_ABI {
namespace {

// How often an idle worker looks for work before it sleeps [-]: some 20 microseconds, about the
// time between two parallel loops of a step. Longer would burn a core that the game needs.
constexpr int kSpins = 2000;

inline void pause_briefly() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

class ThreadPool final : public JobSystem {
 public:
  explicit ThreadPool(int threads) {
    for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
  }
  ~ThreadPool() override {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      generation_.fetch_add(1, std::memory_order_release);
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  [[nodiscard]] int worker_count() const override { return static_cast<int>(workers_.size()) + 1; }

  void parallel_for(std::uint32_t count, std::uint32_t grain, const RangeTask& task) override {
    if (count == 0) return;
    grain = std::max(grain, 1u);
    if (workers_.empty() || count <= grain) {
      for (std::uint32_t begin = 0; begin < count; begin += grain)
        task(begin, std::min(begin + grain, count));
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      task_ = &task;
      count_ = count;
      grain_ = grain;
      next_.store(0, std::memory_order_relaxed);
      busy_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
      generation_.fetch_add(1, std::memory_order_release);
    }
    wake_.notify_all();
    run_chunks();
    while (busy_.load(std::memory_order_acquire) != 0) {
      pause_briefly();
      if (++idle_ > kSpins) {
        idle_ = 0;
        std::this_thread::yield();
      }
    }
  }

 private:
  void run_chunks() {
    const std::uint32_t chunks = (count_ - 1) / grain_ + 1;
    for (;;) {
      const std::uint32_t chunk = next_.fetch_add(1, std::memory_order_relaxed);
      if (chunk >= chunks) return;
      const std::uint32_t begin = chunk * grain_;
      (*task_)(begin, count_ - begin < grain_ ? count_ : begin + grain_);
    }
  }

  void work() {
    std::uint64_t seen = 0;
    for (;;) {
      int spins = 0;
      while (generation_.load(std::memory_order_acquire) == seen && spins < kSpins) {
        pause_briefly();
        ++spins;
      }
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return generation_.load(std::memory_order_relaxed) != seen; });
        seen = generation_.load(std::memory_order_relaxed);
        if (stopping_) return;
      }
      run_chunks();
      busy_.fetch_sub(1, std::memory_order_release);
    }
  }

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<std::uint64_t> generation_{0};
  std::atomic<std::uint32_t> next_{0};
  std::atomic<int> busy_{0};
  const RangeTask* task_ = nullptr;
  std::uint32_t count_ = 0, grain_ = 1;
  int idle_ = 0;
  bool stopping_ = false;
};

}  // namespace

std::unique_ptr<JobSystem> make_thread_pool(int threads) {
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  return std::make_unique<ThreadPool>(std::clamp(threads, 1, 256));
}

}  // namespace plumb::inline PLUMB_ABI
