#include "scene/nearest.h"

#include <algorithm>
#include <vector>

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

// Words longer than any key are not worth a quadratic comparison.
constexpr std::size_t kLongestWord = 64;

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Optimal string alignment: three rows of the usual table, the third for swaps.
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({replace, previous[j] + 1, current[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string_view nearest_of(std::string_view word, Keys list) {
  if (word.size() > kLongestWord) return {};
  std::string_view best;
  std::size_t best_distance = word.size();
  for (const std::string_view candidate : list) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  // More than every third letter wrong: it was meant to be something else.
  const std::size_t longest_slip = std::max<std::size_t>(2, word.size() / 3);
  return best_distance <= longest_slip ? best : std::string_view{};
}

std::string joined(Keys list) {
  std::string out;
  for (const std::string_view word : list) {
    if (!out.empty()) out += ", ";
    out += word;
  }
  return out;
}

std::string suggestion(std::string_view word, Keys list) {
  const std::string_view nearest = nearest_of(word, list);
  if (!nearest.empty()) return "did you mean '" + std::string(nearest) + "'?";
  return "use one of " + joined(list);
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
