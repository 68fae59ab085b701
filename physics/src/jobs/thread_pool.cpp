// The thread pool that comes with Plumb: fixed chunks, a bounded spin, then sleep. Nobody waits for
// a worker that has taken no chunk.
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

// Which chunks of a loop are taken, in one word, so that one look at it is a whole truth. The
// caller takes them from the front and workers from the back: with one worker, each meets in loop
// after loop the data that its own caches hold.
class Claims {
 public:
  static constexpr std::uint32_t kMostChunks = 1u << 20;

  static Claims of(std::uint32_t chunks) { return Claims(std::uint64_t{chunks} << kChunks); }
  explicit Claims(std::uint64_t word) : word_(word) {}
  [[nodiscard]] std::uint64_t word() const { return word_; }

  [[nodiscard]] bool some_left() const { return front() + back() < chunks(); }
  // The chunk that is taken next from there, so long as some are left.
  [[nodiscard]] std::uint32_t front() const { return field(0); }
  [[nodiscard]] std::uint32_t last() const { return chunks() - 1 - back(); }

  static constexpr std::uint64_t kOneFromFront = 1;
  static constexpr std::uint64_t kOneFromBack = std::uint64_t{1} << 21;

 private:
  static constexpr int kChunks = 42;
  [[nodiscard]] std::uint32_t field(int shift) const {
    return static_cast<std::uint32_t>(word_ >> shift) & ((1u << 21) - 1);
  }
  [[nodiscard]] std::uint32_t back() const { return field(21); }
  [[nodiscard]] std::uint32_t chunks() const { return field(kChunks); }

  std::uint64_t word_;
};

class ThreadPool final : public JobSystem {
 public:
  explicit ThreadPool(int threads) {
    for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
  }
  ~ThreadPool() override {
    stopping_.store(true);
    wake_sleepers();
    for (std::thread& worker : workers_) worker.join();
  }

  [[nodiscard]] int worker_count() const override { return static_cast<int>(workers_.size()) + 1; }

  void parallel_for(std::uint32_t count, std::uint32_t grain, const RangeTask& task) override {
    grain = std::max(grain, 1u);
    const std::uint32_t chunks = count / grain + (count % grain != 0 ? 1 : 0);
    if (workers_.empty() || chunks <= 1) {
      for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) run(task, count, grain, chunk);
      return;
    }
    for (std::uint32_t first = 0; first < chunks; first += Claims::kMostChunks)
      share({&task, count, grain, first}, std::min(chunks - first, Claims::kMostChunks));
  }

 private:
  struct Loop {
    const RangeTask* task = nullptr;
    std::uint32_t count = 0, grain = 1;
    std::uint32_t first = 0;  // chunk
  };

  static void run(const RangeTask& task, std::uint32_t count, std::uint32_t grain,
                  std::uint32_t chunk) {
    const std::uint32_t begin = chunk * grain;
    task(begin, count - begin < grain ? count : begin + grain);
  }

  // What a worker reads of `loop_` holds still: it has taken a chunk, and this waits for that.
  void share(const Loop& loop, std::uint32_t chunks) {
    loop_ = loop;
    done_.store(0, std::memory_order_relaxed);
    claims_.store(Claims::of(chunks).word());
    if (sleepers_.load() > 0) wake_sleepers();
    take_chunks<Claims::kOneFromFront>();
    int spins = 0;
    while (done_.load(std::memory_order_acquire) != chunks) {
      pause_briefly();
      if (++spins % kSpins == 0) std::this_thread::yield();
    }
  }

  template <std::uint64_t kOne>
  void take_chunks() {
    while (Claims(claims_.load(std::memory_order_relaxed)).some_left()) {
      const Claims claims(claims_.fetch_add(kOne, std::memory_order_acq_rel));
      if (!claims.some_left()) return;
      const std::uint32_t chunk = kOne == Claims::kOneFromFront ? claims.front() : claims.last();
      run(*loop_.task, loop_.count, loop_.grain, loop_.first + chunk);
      done_.fetch_add(1, std::memory_order_release);
    }
  }

  [[nodiscard]] bool some_left() const { return Claims(claims_.load()).some_left(); }

  void work() {
    while (!stopping_.load(std::memory_order_relaxed)) {
      for (int spins = 0; spins < kSpins && !some_left(); ++spins) pause_briefly();
      if (!some_left()) sleep();
      take_chunks<Claims::kOneFromBack>();
    }
  }

  // The caller publishes chunks, then asks for sleepers; a worker is counted, then asks for chunks:
  // one of them sees the other.
  void sleep() {
    std::unique_lock lock(mutex_);
    sleepers_.fetch_add(1);
    wake_.wait(lock, [&] { return some_left() || stopping_.load(); });
    sleepers_.fetch_sub(1);
  }
  void wake_sleepers() {
    { const std::lock_guard lock(mutex_); }  // none is between its question and its sleep
    wake_.notify_all();
  }

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable wake_;
  Loop loop_;
  // Each on a line of its own: the one is written at every chunk's beginning, the other at its end.
  alignas(64) std::atomic<std::uint64_t> claims_{0};
  alignas(64) std::atomic<std::uint32_t> done_{0};
  alignas(64) std::atomic<int> sleepers_{0};
  std::atomic<bool> stopping_{false};
};

}  // namespace

std::unique_ptr<JobSystem> make_thread_pool(int threads) {
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  return std::make_unique<ThreadPool>(std::clamp(threads, 1, 256));
}

}  // namespace plumb::inline PLUMB_ABI
