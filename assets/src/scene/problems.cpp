#include "scene/problems.h"

#include <algorithm>

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

// More than fit on a screen help nobody.
constexpr std::size_t kShownProblems = 20;

}  // namespace

void Problems::add(int line, const std::string& what, const std::string& remedy) {
  add(line, 0, what, remedy);
}

void Problems::add(int line, int column, const std::string& what, const std::string& remedy) {
  std::string text = file_;
  if (line > 0) text += ":" + std::to_string(line);
  if (column > 0) text += ":" + std::to_string(column);
  text += ": " + what;
  if (!remedy.empty()) text += "; " + remedy;
  lines_.push_back({line, std::move(text)});
}

std::string Problems::text() const {
  std::vector<Entry> sorted = lines_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Entry& a, const Entry& b) { return a.line < b.line; });
  std::string out;
  for (std::size_t k = 0; k < std::min(sorted.size(), kShownProblems); ++k) {
    if (k > 0) out += "\n";
    out += sorted[k].text;
  }
  if (sorted.size() > kShownProblems) {
    out += "\n" + file_ + ": and " + std::to_string(sorted.size() - kShownProblems) + " more";
  }
  return out;
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
