#include "replay/compare.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <set>
#include <type_traits>

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

// Numbers in order as integers: neighbours in the type are neighbours here, and -0 lies at 0.
template <class T>
std::int64_t rank_of(T x) {
  using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
  const auto bits = std::bit_cast<Bits>(x);
  return bits >= 0 ? bits : std::int64_t{std::numeric_limits<Bits>::min()} - bits;
}

template <class T>
double ulps_between(T a, T b) {
  if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
  return std::abs(static_cast<double>(rank_of(a)) - static_cast<double>(rank_of(b)));
}

template <class T>
bool same_bits(T a, T b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

class Comparison {
 public:
  Comparison(const std::vector<std::uint64_t>& ids, Difference& out) : ids_(ids), out_(out) {}
  ~Comparison() { out_.bodies = differing_.size(); }
  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  template <class T>
  void compare(const char* quantity, const char* axes, const std::vector<T>& recorded,
               const std::vector<T>& computed) {
    const std::size_t width = recorded.size() / ids_.size();
    double largest = -1;
    for (std::size_t i = 0; i < recorded.size(); ++i) {
      if (same_bits(recorded[i], computed[i])) continue;
      differing_.insert(ids_[i / width]);
      if (named_) continue;
      const double a = static_cast<double>(recorded[i]), b = static_cast<double>(computed[i]);
      const double size =
          std::isfinite(a - b) ? std::abs(a - b) : std::numeric_limits<double>::infinity();
      if (size <= largest) continue;
      largest = size;
      out_.body = BodyId::from_value(ids_[i / width]);
      out_.quantity = quantity;
      if (axes[0] != 0) out_.quantity += std::string(".") + axes[i % width];
      out_.recorded = a;
      out_.computed = b;
      if constexpr (std::is_floating_point_v<T>)
        out_.ulps = ulps_between(recorded[i], computed[i]);
      else
        out_.ulps = std::abs(a - b);
    }
    named_ = named_ || largest >= 0;
  }

 private:
  const std::vector<std::uint64_t>& ids_;
  Difference& out_;
  std::set<std::uint64_t> differing_;
  bool named_ = false;
};

template <class T, class V>
void append(std::vector<T>& out, const V& values) {
  out.insert(out.end(), values.data(), values.data() + values.size());
}

}  // namespace

BodyRow body_row(const PhysicsWorld& world) {
  std::vector<BodyState> states;
  world.copy_body_states(states);
  BodyRow row;
  for (const BodyState& body : states) {
    if (body.type == MotionType::Static) continue;
    row.ids.push_back(body.id.value());
    row.awake.push_back(body.awake ? 1 : 0);
    append(row.position, body.pose.position);
    append(row.orientation, body.pose.orientation.coeffs());
    append(row.linear_velocity, body.linear_velocity);
    append(row.angular_velocity, body.angular_velocity);
  }
  return row;
}

void name_difference(const BodyRow& recorded, const BodyRow& computed, Difference& difference) {
  if (recorded.ids != computed.ids) {
    difference.quantity = "which bodies there are";
    difference.recorded = static_cast<double>(recorded.ids.size());
    difference.computed = static_cast<double>(computed.ids.size());
    return;
  }
  if (recorded.ids.empty()) return;
  Comparison comparison(recorded.ids, difference);
  comparison.compare("position", "xyz", recorded.position, computed.position);
  comparison.compare("orientation", "xyzw", recorded.orientation, computed.orientation);
  comparison.compare("linear_velocity", "xyz", recorded.linear_velocity, computed.linear_velocity);
  comparison.compare("angular_velocity", "xyz", recorded.angular_velocity,
                     computed.angular_velocity);
  comparison.compare("awake", "", recorded.awake, computed.awake);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
