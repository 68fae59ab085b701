// How numbers, vectors and words are written into a scene file.
#pragma once

#include <charconv>
#include <nlohmann/json.hpp>
#include <string>

#include "plumb/math.h"
#include "scene/keys.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// Keys in the order in which they are written.
using Json = nlohmann::ordered_json;

inline double tidy(double value) { return value; }
// The shortest decimal that is this float, so that 0.1f is written 0.1 and not 0.10000000149.
inline double tidy(float value) {
  char digits[32];
  const char* end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  double wide = 0;
  std::from_chars(digits, end, wide);
  return wide;
}

template <class T>
Json list(const Eigen::Matrix<T, 3, 1>& v) {
  return Json::array({tidy(v.x()), tidy(v.y()), tidy(v.z())});
}

template <class T, int Options>
Json orientation(const Eigen::Quaternion<T, Options>& q) {
  return {{"quaternion", Json::array({tidy(q.x()), tidy(q.y()), tidy(q.z()), tidy(q.w())})}};
}

template <class Enum>
std::string word(Keys words, Enum value) {
  return std::string(words[static_cast<std::size_t>(value)]);
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
