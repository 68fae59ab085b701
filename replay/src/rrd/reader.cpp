#include "rrd/reader.h"

#include <array>
#include <cstring>
#include <exception>

namespace plumb::rrd {
namespace {

constexpr std::size_t kErrorBytes = 2048;

// No exception may pass through the bridge: it waits here until the bridge has returned.
struct Visit {
  const std::function<bool(const Cell&)>& visitor;
  std::exception_ptr thrown;
};

extern "C" int plumb_rrd_visit(void* user, const plumb_rr_cell* cell) {
  auto& visit = *static_cast<Visit*>(user);
  try {
    return visit.visitor(Cell(*cell)) ? 0 : 1;
  } catch (...) {
    visit.thrown = std::current_exception();
    return 1;
  }
}

}  // namespace

std::optional<std::uint64_t> Cell::frame() const {
  for (std::size_t i = 0; i < cell_.time_count; ++i)
    if (std::strcmp(cell_.time_names[i], kFrameTimeline) == 0 && cell_.times[i] >= 0)
      return static_cast<std::uint64_t>(cell_.times[i]);
  return std::nullopt;
}

std::string_view Cell::text(std::size_t instance) const {
  if (type() != PLUMB_RR_TEXT || instance >= instances()) return {};
  const std::uint64_t begin = instance == 0 ? 0 : cell_.text_ends[instance - 1];
  return {static_cast<const char*>(cell_.data) + begin, cell_.text_ends[instance] - begin};
}

ReadResult read(const std::string& path, const std::string& entity_prefix,
                const std::function<bool(const Cell&)>& visit) {
  std::array<char, kErrorBytes> error{};
  plumb_rr_summary summary{};
  Visit user{visit, nullptr};
  const int code = plumb_rr_read(path.c_str(), entity_prefix.c_str(), plumb_rrd_visit, &user,
                                 &summary, error.data(), error.size());
  if (user.thrown) std::rethrow_exception(user.thrown);
  ReadResult result;
  result.summary = {summary.finished != 0, summary.file_bytes,     summary.cut_bytes,
                    summary.chunks,        summary.application_id, summary.recording_id};
  if (code != PLUMB_RR_OK && code != PLUMB_RR_STOPPED)
    result.outcome = Outcome::failed(error.data());
  return result;
}

}  // namespace plumb::rrd
