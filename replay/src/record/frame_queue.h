// Frames on their way from the thread that steps the world to the one that encodes them.
//
// Frames are reused, so that copying into one allocates nothing after a while. The encoder looks
// for work by itself, or is woken for several frames at once: waking it costs more than a frame.
// When it falls behind by too many, the stepping thread waits for it: memory stays bounded and
// nothing is lost.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "record/frame.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

class FrameQueue {
 public:
  // `encode` is called on a thread of its own, once for each frame, in order.
  explicit FrameQueue(std::function<void(Frame&)> encode);
  ~FrameQueue();  // after what is queued was encoded
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;

  // A frame to be filled, with the storage of an older one; one that has held a snapshot if such a
  // one is there and asked for.
  std::unique_ptr<Frame> take_empty(bool for_snapshot);
  void push(std::unique_ptr<Frame> frame);
  // Returns when all frames have been encoded.
  void drain();

 private:
  void run();

  std::function<void(Frame&)> encode_;
  std::mutex mutex_;
  std::condition_variable work_, room_;
  std::deque<std::unique_ptr<Frame>> waiting_;
  std::vector<std::unique_ptr<Frame>> empty_;
  bool hurry_ = false, encoding_ = false, asleep_ = false, ends_ = false;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
