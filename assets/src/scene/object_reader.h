// Typed access to the members of a JSON object. Every method leaves its target alone when the key
// is absent, and notes a problem with line and remedy when the value does not fit.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "scene/json_tree.h"
#include "scene/keys.h"
#include "scene/problems.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool above_lower = false;  // the lower end itself is not allowed
};
inline constexpr Range kAnyNumber{};
inline constexpr Range kNotNegative{0, std::numeric_limits<double>::infinity(), false};
// Masses and densities [kg, kg/m^3] that the build's numbers hold, and the inverse of which too.
inline constexpr Range kMassRange{static_cast<double>(std::numeric_limits<Real>::min()),
                                  1 / static_cast<double>(std::numeric_limits<Real>::min()), false};
inline constexpr Range kPositive{0, std::numeric_limits<double>::infinity(), true};

class ObjectReader {
 public:
  // `what` names the object in messages: "body 'crate'". Keys that are not in the list are noted.
  ObjectReader(const JsonNode& node, std::string what, Keys keys, Problems& problems);

  [[nodiscard]] bool is_object() const { return node_.kind == JsonNode::Kind::Object; }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  // Whether the key is one that this kind of object may have; only such keys may be asked for.
  [[nodiscard]] bool knows(std::string_view key) const;
  [[nodiscard]] const JsonNode* find(std::string_view key) const;
  [[nodiscard]] int line() const { return node_.line; }
  [[nodiscard]] int line_of(std::string_view key) const;
  [[nodiscard]] const std::string& what() const { return what_; }
  [[nodiscard]] Problems& problems() const { return problems_; }

  bool number(std::string_view key, double& out, const Range& range = kAnyNumber) const;
  // Bounds of up to 53 bits.
  bool integer(std::string_view key, std::int64_t& out, std::int64_t lower,
               std::int64_t upper) const;
  bool flag(std::string_view key, bool& out) const;
  bool text(std::string_view key, std::string& out) const;
  bool vector(std::string_view key, Eigen::Vector3d& out, const Range& range = kAnyNumber) const;
  // A list of exactly this many numbers.
  bool numbers(std::string_view key, double* out, std::size_t count) const;
  // The place of the text in the list of words.
  bool choice(std::string_view key, Keys words, std::size_t& out) const;

  template <class T>
    requires std::is_integral_v<T>
  bool integer(std::string_view key, T& out, T lower, T upper) const {
    std::int64_t wide = 0;
    if (!integer(key, wide, std::int64_t{lower}, std::int64_t{upper})) return false;
    out = static_cast<T>(wide);
    return true;
  }
  template <class T>
    requires std::is_same_v<T, float>
  bool number(std::string_view key, T& out, const Range& range = kAnyNumber) const {
    double wide = 0;
    if (!number(key, wide, range)) return false;
    out = static_cast<T>(wide);
    return true;
  }
  template <class T>
    requires std::is_same_v<T, float>
  bool vector(std::string_view key, Eigen::Matrix<T, 3, 1>& out,
              const Range& range = kAnyNumber) const {
    Eigen::Vector3d wide;
    if (!vector(key, wide, range)) return false;
    out = wide.cast<T>();
    return true;
  }
  template <class Enum>
    requires std::is_enum_v<Enum>
  bool choice(std::string_view key, Keys words, Enum& out) const {
    std::size_t index = 0;
    if (!choice(key, words, index)) return false;
    out = static_cast<Enum>(index);
    return true;
  }

  void missing(std::string_view key, const std::string& remedy) const;

 private:
  bool wrong_kind(std::string_view key, const JsonNode& value, const std::string& wanted) const;

  const JsonNode& node_;
  std::string what_;
  Keys keys_;
  Problems& problems_;
};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
