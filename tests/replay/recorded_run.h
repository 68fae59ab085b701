// A small world recorded into a file of its own, and files made from it by changing one thing.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "plumb/replay/recorder.h"
#include "plumb/replay/replay.h"
#include "rrd/reader.h"
#include "rrd/table.h"
#include "rrd/writer.h"
#include "schema.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace replay_test {

inline constexpr double kDt = 1.0 / 60;  // [s]

// A path in the test's own folder, which goes when the test ends.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("plumb_replay_" + std::to_string(::getpid()) + "_" + test->test_suite_name() + "_" +
               test->name());
    std::filesystem::create_directories(folder_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] std::string path() const { return folder_.string(); }

 private:
  std::filesystem::path folder_;
};

// A tumbling stack with things done to it between the steps, some of which change what there is.
inline void act_between_steps(PhysicsWorld& world, std::vector<BodyId>& bodies, int step) {
  if (step == 7) {
    EXPECT_TRUE(world.apply_impulse(bodies[1], Vec3(40, 5, 0)).ok());
  }
  if (step == 20)
    bodies.push_back(scenes::add(world, scenes::body_at(scenes::at(0.3, 9, 0.2)),
                                 scenes::with(scenes::sphere(0.4))));
  if (step == 33) {
    EXPECT_TRUE(world.destroy_body(bodies[0]).ok());
  }
  if (step % 9 == 4) {
    EXPECT_TRUE(world.apply_force(bodies[2], Vec3(0, 60, 30)).ok());
  }
}

// Records `steps` steps; the recorder is closed on return.
inline void record_run(const std::string& path, int steps, replay::RecorderOptions options = {}) {
  options.path = path;
  PhysicsWorld world;
  std::vector<BodyId> bodies = scenes::build_stack(world, {.count = 5, .shift = 0.1}).bodies;
  replay::Recorder recorder;
  const auto opened = recorder.open(options);
  ASSERT_TRUE(opened.ok()) << opened.error;
  world.attach(&recorder);
  for (int step = 0; step < steps; ++step) {
    act_between_steps(world, bodies, step);
    ASSERT_TRUE(world.step(kDt).status.ok());
  }
  world.detach(&recorder);
  const auto closed = recorder.close();
  ASSERT_TRUE(closed.ok()) << closed.error;
}

// One component of one row, to be changed before it is written again.
struct EditableCell {
  std::string entity, component;
  std::optional<std::uint64_t> frame;
  plumb_rr_type type = PLUMB_RR_F32;
  std::uint32_t width = 1;
  std::vector<std::byte> bytes;
  std::vector<std::string> texts;

  template <class T>
  T number(std::size_t i) const {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    return value;
  }
  template <class T>
  void set(std::size_t i, T value) {
    std::memcpy(bytes.data() + i * sizeof(T), &value, sizeof(T));
  }
};

template <class T>
void write_numbers(rrd::Table& table, const EditableCell& cell) {
  const std::size_t at = table.add_column<T>(cell.component, cell.width);
  T* out = table.column(at).extend<T>(cell.bytes.size() / sizeof(T) / cell.width);
  if (!cell.bytes.empty()) std::memcpy(out, cell.bytes.data(), cell.bytes.size());
}

// Copies what a replay needs from one recording to another; edit may change a cell, or drop it by
// returning false.
inline void rewrite(const std::string& from, const std::string& to,
                    const std::function<bool(EditableCell&)>& edit) {
  rrd::Writer writer;
  ASSERT_TRUE(writer.open(to, "plumb", "rewritten").ok());
  const auto read = rrd::read(from, rrd::schema::kPrefix, [&](const rrd::Cell& cell) {
    EditableCell copy{std::string(cell.entity()),
                      std::string(cell.component()),
                      cell.frame(),
                      cell.type(),
                      cell.width(),
                      {},
                      {}};
    const auto keep = [&](auto numbers) {
      const auto bytes = std::as_bytes(numbers);
      copy.bytes.assign(bytes.begin(), bytes.end());
    };
    keep(cell.numbers<float>());
    if (cell.type() == PLUMB_RR_F64) keep(cell.numbers<double>());
    if (cell.type() == PLUMB_RR_U8) keep(cell.numbers<std::uint8_t>());
    if (cell.type() == PLUMB_RR_U32) keep(cell.numbers<std::uint32_t>());
    if (cell.type() == PLUMB_RR_U64) keep(cell.numbers<std::uint64_t>());
    if (cell.type() == PLUMB_RR_TEXT)
      for (std::size_t i = 0; i < cell.instances(); ++i) copy.texts.emplace_back(cell.text(i));
    if (!edit(copy)) return true;

    rrd::Table table(copy.entity);
    switch (copy.type) {
      case PLUMB_RR_F32:
        write_numbers<float>(table, copy);
        break;
      case PLUMB_RR_F64:
        write_numbers<double>(table, copy);
        break;
      case PLUMB_RR_U8:
        write_numbers<std::uint8_t>(table, copy);
        break;
      case PLUMB_RR_U32:
        write_numbers<std::uint32_t>(table, copy);
        break;
      case PLUMB_RR_U64:
        write_numbers<std::uint64_t>(table, copy);
        break;
      case PLUMB_RR_TEXT: {
        const std::size_t at = table.add_text_column(copy.component);
        for (const std::string& text : copy.texts) table.column(at).append_text(text);
        break;
      }
    }
    if (copy.frame) {
      table.end_row(*copy.frame, 0);
      table.send(writer);
    } else {
      table.send_static(writer);
    }
    return true;
  });
  ASSERT_TRUE(read.outcome.ok()) << read.outcome.error;
  const auto closed = writer.close(60);
  ASSERT_TRUE(closed.ok()) << closed.error;
}

inline std::uintmax_t size_of(const std::string& path) { return std::filesystem::file_size(path); }

}  // namespace replay_test
}  // namespace plumb::inline PLUMB_ABI
