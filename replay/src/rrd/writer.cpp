#include "rrd/writer.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace plumb::rrd {
namespace {

// Room for a message with two paths in it.
constexpr std::size_t kErrorBytes = 2048;
using ErrorText = std::array<char, kErrorBytes>;

// A destructor waits this long [s] for the disk before it lets go.
constexpr double kDestructorTimeout = 10;

}  // namespace

Writer::~Writer() {
  if (is_open()) (void)close(kDestructorTimeout);
}

Outcome Writer::keep(int code, const char* error) {
  if (code == PLUMB_RR_OK) return {};
  Outcome outcome = Outcome::failed(error);
  // A timeout is not the end: the thread goes on, and the next flush may do.
  if (status_.ok() && code != PLUMB_RR_TIMEOUT) status_ = outcome;
  return outcome;
}

Outcome Writer::open(const std::string& path, const std::string& application_id,
                     const std::string& recording_name) {
  if (is_open()) return Outcome::failed("a recording is open already: close it first");
  ErrorText error{};
  status_ = {};
  path_ = path;
  handle_ = plumb_rr_open(path.c_str(), application_id.c_str(), recording_name.c_str(),
                          error.data(), error.size());
  return handle_ ? Outcome{} : keep(PLUMB_RR_IO, error.data());
}

void Writer::send(const plumb_rr_chunk& chunk) {
  if (!is_open() || !status_.ok()) return;
  ErrorText error{};
  (void)keep(plumb_rr_send(handle_, &chunk, error.data(), error.size()), error.data());
}

void Writer::send_layout(const Layout& layout) {
  if (!is_open() || !status_.ok()) return;
  std::vector<plumb_rr_view> views;
  for (const View& view : layout.views)
    views.push_back({static_cast<std::uint32_t>(view.kind), view.name.c_str(),
                     view.contents.c_str(), view.tab});
  plumb_rr_layout c_layout{};
  c_layout.views = views.data();
  c_layout.view_count = views.size();
  c_layout.timeline = layout.timeline.c_str();
  c_layout.frames_per_second = layout.frames_per_second;
  std::copy(std::begin(layout.eye), std::end(layout.eye), c_layout.eye);
  std::copy(std::begin(layout.target), std::end(layout.target), c_layout.target);
  std::copy(std::begin(layout.up), std::end(layout.up), c_layout.up);
  c_layout.followed = layout.followed.empty() ? nullptr : layout.followed.c_str();
  c_layout.grid_height = layout.grid_height;
  c_layout.grid_spacing = layout.grid_spacing;
  ErrorText error{};
  (void)keep(plumb_rr_send_layout(handle_, &c_layout, error.data(), error.size()), error.data());
}

Outcome Writer::flush(double timeout, bool durable) {
  if (!status_.ok()) return status_;
  if (!is_open()) return Outcome::failed("no recording is open");
  ErrorText error{};
  return keep(plumb_rr_flush(handle_, timeout, durable ? 1 : 0, error.data(), error.size()),
              error.data());
}

Outcome Writer::close(double timeout) {
  if (!is_open()) return status_.ok() ? Outcome::failed("no recording is open") : status_;
  ErrorText error{};
  const int code = plumb_rr_close(handle_, timeout, error.data(), error.size());
  handle_ = nullptr;
  std::error_code no_size;
  const std::uintmax_t size = std::filesystem::file_size(path_, no_size);
  final_bytes_ = no_size ? 0 : size;
  const Outcome outcome = keep(code, error.data());
  return status_.ok() ? outcome : status_;
}

std::uint64_t Writer::bytes_written() const {
  return is_open() ? plumb_rr_bytes_written(handle_) : final_bytes_;
}

}  // namespace plumb::rrd
