// The memory of lists that live no longer than the step that makes them.
//
// One block that grows until a step fits into it, so that steps ask the system for nothing once the
// world has warmed up. For the thread that steps the world, outside its parallel loops.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <memory_resource>
#include <vector>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

class StepMemory final : public std::pmr::memory_resource {
 public:
  // All lists made in it are gone. To be called between steps.
  void reset() {
    if (blocks_.size() > 1) {  // the step did not fit: one block for the next one like it
      blocks_.clear();
      add_block(used_before_ + used_);
    }
    used_ = used_before_ = 0;
  }

 private:
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;
  };
  static constexpr std::size_t kSmallest = std::size_t{1} << 16;  // [byte]
  static constexpr std::size_t kAlignment = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

  static std::size_t rounded(std::size_t bytes) {
    return (bytes + kAlignment - 1) / kAlignment * kAlignment;
  }
  void add_block(std::size_t needed) {
    const std::size_t size = std::max(kSmallest, needed + needed / 2);
    blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(size), size});
  }

  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (alignment > kAlignment) return std::pmr::new_delete_resource()->allocate(bytes, alignment);
    const std::size_t taken = rounded(bytes);
    if (blocks_.empty() || taken > blocks_.back().size - used_) {
      used_before_ += used_;
      used_ = 0;
      add_block(std::max(taken, used_before_));
    }
    std::byte* const at = blocks_.back().bytes.get() + used_;
    used_ += taken;
    return at;
  }
  // What was taken last can be taken again.
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
    if (alignment > kAlignment)
      return std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
    const std::size_t taken = rounded(bytes);
    if (taken <= used_ && memory == blocks_.back().bytes.get() + (used_ - taken)) used_ -= taken;
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override {
    return this == &other;
  }

  std::vector<Block> blocks_;    // the last one is in use
  std::size_t used_ = 0;         // [byte] of the last block
  std::size_t used_before_ = 0;  // [byte] of the others
};

template <class T>
using StepList = std::pmr::vector<T>;  // made with &world.memory

}  // namespace plumb::inline PLUMB_ABI::detail
