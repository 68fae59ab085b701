// operator new of this test program: the standard one, and counted while somebody asks for it.
#include "counted_new.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> counting{false};
std::atomic<long> count{0};

void* taken_or_null(std::size_t bytes, std::size_t alignment) noexcept {
  if (counting) ++count;
  return alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
             ? std::malloc(bytes > 0 ? bytes : 1)
             : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}
void* taken(std::size_t bytes, std::size_t alignment) {
  void* const memory = taken_or_null(bytes, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

namespace plumb::test {

void begin_counting() {
  count = 0;
  counting = true;
}
long end_counting() {
  counting = false;
  return count;
}

}  // namespace plumb::test

void* operator new(std::size_t bytes) { return taken(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return taken(bytes, static_cast<std::size_t>(alignment));
}
// (a sanitizer brings its own of these two, whose memory std::free must not be given)
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return taken_or_null(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return taken_or_null(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
