#include "record/frame_queue.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

// Frames that wait before the encoder is woken, and those at which the stepping thread waits [-].
constexpr std::size_t kWakeAt = 8, kFullAt = 64;
// The encoder looks by itself so often: longer than a frame of a game, so that it need not be woken
// then, and few frames are in turn, which stay in the cache.
constexpr std::chrono::milliseconds kLookEvery{20};

}  // namespace

FrameQueue::FrameQueue(std::function<void(Frame&)> encode)
    : encode_(std::move(encode)), thread_([this] { run(); }) {}

FrameQueue::~FrameQueue() {
  drain();
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  work_.notify_one();
  thread_.join();
}

std::unique_ptr<Frame> FrameQueue::take_empty(bool for_snapshot) {
  const std::lock_guard lock(mutex_);
  if (empty_.empty()) return std::make_unique<Frame>();
  const auto fits = [&](const auto& frame) {
    return frame->snapshot.columns.empty() != for_snapshot;
  };
  const auto found = std::find_if(empty_.rbegin(), empty_.rend(), fits);
  if (found != empty_.rend()) std::swap(*found, empty_.back());
  std::unique_ptr<Frame> frame = std::move(empty_.back());
  empty_.pop_back();
  return frame;
}

void FrameQueue::push(std::unique_ptr<Frame> frame) {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [this] { return waiting_.size() < kFullAt; });
  waiting_.push_back(std::move(frame));
  const bool wake = asleep_ || waiting_.size() == kWakeAt;
  asleep_ = false;
  lock.unlock();
  if (wake) work_.notify_one();
}

void FrameQueue::drain() {
  std::unique_lock lock(mutex_);
  hurry_ = true;
  work_.notify_one();
  room_.wait(lock, [this] { return waiting_.empty() && !encoding_; });
  hurry_ = false;
}

void FrameQueue::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait_for(lock, kLookEvery, [this] {
      return ends_ || waiting_.size() >= kWakeAt || (hurry_ && !waiting_.empty());
    });
    asleep_ = waiting_.empty() && !ends_;  // nothing came: until something does
    work_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    asleep_ = false;
    if (ends_ && waiting_.empty()) return;
    while (!waiting_.empty()) {
      std::unique_ptr<Frame> frame = std::move(waiting_.front());
      waiting_.pop_front();
      encoding_ = true;
      lock.unlock();
      encode_(*frame);
      lock.lock();
      encoding_ = false;
      empty_.push_back(std::move(frame));
    }
    room_.notify_all();
  }
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
