// operator new of this test program: the standard one, counted. What was asked for stands in front
// of it, so that it is known again when it is given back.
#include "counted_new.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> counting{false};
std::atomic<long> count{0};
std::atomic<long long> asked{0};  // [byte] while counting
std::atomic<long long> held{0};   // [byte] always

// Room in front of what is handed out: for its size, and as much as keeps it aligned.
std::size_t room_before(std::size_t alignment) {
  return std::max(alignment, std::size_t{__STDCPP_DEFAULT_NEW_ALIGNMENT__});
}

void* taken_or_null(std::size_t bytes, std::size_t alignment) noexcept {
  const std::size_t room = room_before(alignment);
  const std::size_t all = (room + bytes + room - 1) / room * room;
  void* const begin = std::aligned_alloc(room, all);
  if (begin == nullptr) return nullptr;
  if (counting) {
    ++count;
    asked += static_cast<long long>(bytes);
  }
  held += static_cast<long long>(bytes);
  std::byte* const memory = static_cast<std::byte*>(begin) + room;
  *reinterpret_cast<std::size_t*>(memory - sizeof(std::size_t)) = bytes;
  return memory;
}
void* taken(std::size_t bytes, std::size_t alignment) {
  void* const memory = taken_or_null(bytes, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void give_back(void* memory, std::size_t alignment) noexcept {
  if (memory == nullptr) return;
  std::byte* const bytes = static_cast<std::byte*>(memory);
  held -= static_cast<long long>(*reinterpret_cast<std::size_t*>(bytes - sizeof(std::size_t)));
  std::free(bytes - room_before(alignment));
}

constexpr std::size_t kUsual = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

}  // namespace

namespace plumb::test {

void begin_counting() {
  count = 0;
  asked = 0;
  counting = true;
}
long end_counting() {
  counting = false;
  return count;
}
long long counted_bytes() { return asked; }
long long live_bytes() { return held; }

}  // namespace plumb::test

void* operator new(std::size_t bytes) { return taken(bytes, kUsual); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return taken(bytes, static_cast<std::size_t>(alignment));
}
// (a sanitizer brings its own of these two, whose memory give_back() must not be given)
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return taken_or_null(bytes, kUsual);
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return taken_or_null(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { give_back(memory, kUsual); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory, kUsual); }
void operator delete(void* memory, std::align_val_t alignment) noexcept {
  give_back(memory, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory, std::size_t, std::align_val_t alignment) noexcept {
  give_back(memory, static_cast<std::size_t>(alignment));
}
