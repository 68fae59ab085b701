// What is written is what is read: every bit of every number, every byte of every text, every row
// in its order and with its time.
#include <array>
#include <bit>
#include <limits>
#include <map>

#include "recorded_run.h"

namespace plumb {
namespace {

using replay_test::TemporaryFolder;

// Numbers that a conversion on the way would change.
const std::array<std::uint64_t, 9> kDoubleBits{
    0x0000000000000000,  // 0
    0x8000000000000000,  // -0
    0x7ff8000000000abc,  // quiet NaN with a payload
    0xfff4000000000001,  // signalling NaN, negative, with a payload
    0x7ff0000000000000,  // infinity
    0x0000000000000001,  // smallest denormal
    0x800fffffffffffff,  // largest denormal, negative
    0x7fefffffffffffff,  // largest
    0x3fb999999999999a,  // 0.1
};
const std::array<std::uint32_t, 7> kFloatBits{0x80000000, 0x7fc00123, 0xff800001, 0x00000001,
                                              0x007fffff, 0x7f7fffff, 0x3dcccccd};

TEST(RoundTrip, KeepsEveryBitOfEveryType) {
  const TemporaryFolder folder;
  const std::string path = folder.file("bits.rrd");
  std::array<double, 9> doubles{};
  std::memcpy(doubles.data(), kDoubleBits.data(), sizeof(doubles));
  std::array<float, 7> floats{};
  std::memcpy(floats.data(), kFloatBits.data(), sizeof(floats));
  const std::array<std::uint64_t, 3> longs{0, std::numeric_limits<std::uint64_t>::max(),
                                           (1ull << 53) + 1};  // more than a double can hold
  const std::array<std::uint8_t, 2> bytes{0, 255};
  const std::array<std::string, 4> texts{"", "naïve Ω", std::string(100000, 'x'), "{\"a\": 1}\n"};
  {
    rrd::Writer writer;
    ASSERT_TRUE(writer.open(path, "test", "bits").ok());
    rrd::Table table("plumb/test");
    const auto d = table.add_column<double>("plumb.Test:doubles", 3);
    const auto f = table.add_column<float>("plumb.Test:floats");
    const auto u = table.add_column<std::uint64_t>("plumb.Test:longs");
    const auto b = table.add_column<std::uint8_t>("plumb.Test:bytes", 2);
    const auto t = table.add_text_column("plumb.Test:texts");
    table.column(d).append(std::span<const double>(doubles));
    table.column(f).append(std::span<const float>(floats));
    table.column(u).append(std::span<const std::uint64_t>(longs));
    table.column(b).append(std::span<const std::uint8_t>(bytes));
    for (const std::string& text : texts) table.column(t).append_text(text);
    table.end_row(12, 0.5);
    table.send(writer);
    ASSERT_TRUE(writer.close(60).ok()) << writer.status().error;
  }
  int seen = 0;
  const auto read = rrd::read(path, "plumb/", [&](const rrd::Cell& cell) {
    ++seen;
    EXPECT_EQ(cell.entity(), "plumb/test");
    EXPECT_EQ(cell.frame(), 12u);
    const auto same = [](auto got, const auto& put) {
      EXPECT_EQ(got.size_bytes(), sizeof(put));
      EXPECT_EQ(std::memcmp(got.data(), put.data(), sizeof(put)), 0);
    };
    if (cell.component() == "plumb.Test:doubles") {
      EXPECT_EQ(cell.width(), 3u);
      same(cell.numbers<double>(), doubles);
    } else if (cell.component() == "plumb.Test:floats") {
      same(cell.numbers<float>(), floats);
    } else if (cell.component() == "plumb.Test:longs") {
      same(cell.numbers<std::uint64_t>(), longs);
    } else if (cell.component() == "plumb.Test:bytes") {
      EXPECT_EQ(cell.width(), 2u);
      same(cell.numbers<std::uint8_t>(), bytes);
    } else {
      EXPECT_EQ(cell.component(), "plumb.Test:texts");
      EXPECT_EQ(cell.instances(), texts.size());
      for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(cell.text(i), texts[i]);
    }
    return true;
  });
  EXPECT_TRUE(read.outcome.ok()) << read.outcome.error;
  EXPECT_TRUE(read.summary.finished);
  EXPECT_EQ(read.summary.application_id, "test");
  EXPECT_EQ(seen, 5);
}

TEST(RoundTrip, KeepsRowsOfDifferentLengthInTheirOrder) {
  const TemporaryFolder folder;
  const std::string path = folder.file("rows.rrd");
  constexpr std::uint64_t kRows = 100;
  {
    rrd::Writer writer;
    ASSERT_TRUE(writer.open(path, "test", "rows").ok());
    rrd::Table table("plumb/rows");
    const auto column = table.add_column<std::uint64_t>("plumb.Rows:numbers");
    for (std::uint64_t row = 0; row < kRows; ++row) {
      for (std::uint64_t i = 0; i < row % 4; ++i)  // some rows are empty
        table.column(column).append_one(row * 1000 + i);
      table.end_row(row, 0.01 * static_cast<double>(row));
      if (row % 7 == 6) table.send(writer);
    }
    table.send(writer);
    ASSERT_TRUE(writer.close(60).ok()) << writer.status().error;
  }
  std::uint64_t next = 0;
  const auto read = rrd::read(path, "plumb/rows", [&](const rrd::Cell& cell) {
    EXPECT_EQ(cell.frame(), next);
    const auto numbers = cell.numbers<std::uint64_t>();
    EXPECT_EQ(numbers.size(), next % 4);
    for (std::uint64_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], next * 1000 + i);
    ++next;
    return true;
  });
  EXPECT_TRUE(read.outcome.ok()) << read.outcome.error;
  EXPECT_EQ(next, kRows);
}

// Components are checked where they are written, so that no file holds what a viewer would not
// show.
TEST(RoundTrip, RefusesWhatIsNoComponent) {
  const TemporaryFolder folder;
  const auto error_of = [&](const std::string& component, auto number, std::uint32_t width) {
    rrd::Writer writer;
    EXPECT_TRUE(writer.open(folder.file("bad.rrd"), "test", "bad").ok());
    rrd::Table table("plumb/bad");
    using Number = decltype(number);
    const auto at = table.add_column<Number>(component, width);
    for (Number* n = table.column(at).template extend<Number>(1); width > 0; --width) *n++ = number;
    table.end_row(0, 0);
    table.send(writer);
    return writer.close(60).error;
  };
  EXPECT_NE(error_of("Boxes3D:centres", 1.0f, 3).find("unknown component"), std::string::npos);
  EXPECT_NE(error_of("Boxes3D:centers", 1.0, 3).find("takes F32 x 3"), std::string::npos);
  EXPECT_NE(error_of("other.Thing:x", 1.0f, 1).find("unknown component"), std::string::npos);
  EXPECT_EQ(error_of("Boxes3D:centers", 1.0f, 3), "");
}

}  // namespace
}  // namespace plumb
