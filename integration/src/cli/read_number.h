// Numbers as users write them on a command line.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

namespace plumb::cli {

// The finite number at the start of a text; what follows it in `rest`.
inline bool parse_number(const std::string& text, double& value, std::string& rest) {
  if (text.empty()) return false;
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(value)) return false;
  rest = end;
  return true;
}

// "1/60" or "0.01" [s]; false where the text is no such thing or the number is not finite.
inline bool parse_seconds(const std::string& text, double& seconds) {
  std::string rest;
  if (!parse_number(text, seconds, rest)) return false;
  if (rest.empty()) return true;
  double divisor = 0;
  std::string more;
  if (rest[0] != '/' || !parse_number(rest.substr(1), divisor, more) || !more.empty()) return false;
  seconds /= divisor;
  return std::isfinite(seconds);
}

}  // namespace plumb::cli
