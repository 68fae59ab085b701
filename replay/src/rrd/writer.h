// A recording being written: RAII over the C interface of the Rerun bridge. The first failure is
// kept and everything after it is a no-op, so that who records need not ask at every row.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "plumb/replay/outcome.h"
#include "rrd/plumb_rerun.h"

namespace plumb::rrd {

struct View {
  plumb_rr_view_kind kind;
  std::string name;
  std::string contents;  // entity expressions, one a line
  std::uint32_t tab;     // views with one number share a place
};

struct Layout {
  std::vector<View> views;
  std::string timeline;
  float frames_per_second = 60;
  float eye[3] = {0, 0, 0}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
  std::string followed;    // entity that the eye goes with; empty: none
  float grid_height = 0;   // [m] along up
  float grid_spacing = 0;  // [m] 0: no grid
};

class Writer {
 public:
  Writer() = default;
  ~Writer();  // closes; call close() to hear how that went
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  Outcome open(const std::string& path, const std::string& application_id,
               const std::string& recording_name);
  void send(const plumb_rr_chunk& chunk);
  void send_layout(const Layout& layout);
  Outcome flush(double timeout, bool durable);  // [s]
  Outcome close(double timeout);                // [s]

  [[nodiscard]] bool is_open() const { return handle_ != nullptr; }
  [[nodiscard]] const Outcome& status() const { return status_; }
  [[nodiscard]] std::uint64_t bytes_written() const;

 private:
  Outcome keep(int code, const char* error);

  plumb_rr_writer* handle_ = nullptr;
  Outcome status_;
  std::string path_;
  std::uint64_t final_bytes_ = 0;
};

}  // namespace plumb::rrd
