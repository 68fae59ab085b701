// Heightfields: their entry in the scene file, and files of heights.
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>

#include "scene/heights_file.h"
#include "scene/read_parts.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

constexpr double kHole = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFewestSamples = 2;  // along each side
// Heights beyond are refused by the engine; so large a number is a slip of the unit.
constexpr double kHighest = 1e6;                     // [m]
constexpr std::uintmax_t kLargestFile = 256u << 20;  // [bytes]

// A row as long as the first one; an empty text if it is good.
std::string add_row(const std::vector<double>& row, SceneHeightfield& field) {
  if (field.heights.empty()) field.samples_x = row.size();
  if (row.size() != field.samples_x) {
    return "this row has " + std::to_string(row.size()) + " heights, the first one has " +
           std::to_string(field.samples_x);
  }
  for (const double height : row) {
    if (std::abs(height * field.height_scale) > kHighest)
      return "a height lies beyond 1000 km; check height_scale";
  }
  field.heights.insert(field.heights.end(), row.begin(), row.end());
  return {};
}

std::string too_few(const SceneHeightfield& field) {
  const bool enough =
      field.samples_x >= kFewestSamples && field.heights.size() >= kFewestSamples * field.samples_x;
  return enough ? "" : "a heightfield needs two rows of two heights at least";
}

void read_rows(const ObjectReader& in, const JsonNode& node, SceneHeightfield& field) {
  const std::string remedy =
      "write a list of rows along z, each a list of heights along x, null "
      "for a hole: [[0, 1], [0, null]]";
  const auto complain = [&](int line, const std::string& what) {
    in.problems().add(line, "'heights' of " + in.what() + ": " + what, remedy);
    field.heights.clear();
  };
  if (node.kind != JsonNode::Kind::Array)
    return complain(node.line, std::string("this is ") + name_of(node.kind));
  std::vector<double> row;
  for (const JsonNode& line : node.items) {
    row.clear();
    if (line.kind != JsonNode::Kind::Array)
      return complain(line.line, std::string("a row is ") + name_of(line.kind));
    for (const JsonNode& item : line.items) {
      if (item.kind != JsonNode::Kind::Number && item.kind != JsonNode::Kind::Null)
        return complain(item.line, std::string("a height is ") + name_of(item.kind));
      row.push_back(item.kind == JsonNode::Kind::Null ? kHole : item.number);
    }
    if (const std::string wrong = add_row(row, field); !wrong.empty())
      return complain(line.line, wrong);
  }
  if (const std::string wrong = too_few(field); !wrong.empty()) complain(node.line, wrong);
}

// "1.5", "-2", or "nan" for a hole.
bool to_height(std::string_view word, double& out) {
  if (word == "nan" || word == "NaN") {
    out = kHole;
    return true;
  }
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
  return error == std::errc{} && end == word.data() + word.size() && std::isfinite(out);
}

}  // namespace

void read_heightfield(const JsonNode& node, const std::string& what, SceneHeightfield& field,
                      Problems& problems) {
  const ObjectReader in(node, what, keys::kHeightfield, problems);
  field.line = node.line;
  if (!in.is_object()) return;
  if (!in.has("spacing"))
    in.missing("spacing", "give the metres between samples along x and z: [1, 1]");
  double spacing[2];
  if (in.numbers("spacing", spacing, 2)) {
    if (spacing[0] > 0 && spacing[1] > 0) {
      field.spacing = {spacing[0], spacing[1]};
    } else {
      problems.add(in.line_of("spacing"), "'spacing' of " + what + " must be above 0",
                   "give the metres between samples along x and z: [1, 1]");
    }
  }
  in.number("height_scale", field.height_scale);
  in.text("file", field.file);
  if (in.has("file") == in.has("heights")) {
    problems.add(node.line,
                 what + (in.has("file") ? " has both 'file' and 'heights'"
                                        : " has neither 'file' nor 'heights'"),
                 "write its heights as a list of rows, or name a file that holds them");
    return;
  }
  if (in.has("file") && field.file.empty() && in.find("file")->kind == JsonNode::Kind::Text) {
    problems.add(in.line_of("file"), "'file' of " + what + " is empty",
                 "name the file of heights, relative to the folder of the scene");
  }
  if (const JsonNode* heights = in.find("heights")) read_rows(in, *heights, field);
}

std::string read_heights_file(SceneHeightfield& field) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(field.path, problem))
    return field.path + ": there is no such file";
  if (std::filesystem::file_size(field.path, problem) > kLargestFile)
    return field.path + ": the file is too large for a heightfield (256 MB)";
  std::ifstream file(field.path, std::ios::binary);
  std::string text;
  std::vector<double> row;
  field.heights.clear();
  for (int line = 1; std::getline(file, text); ++line) {
    const std::string place = field.path + ":" + std::to_string(line) + ": ";
    const std::string_view all = std::string_view(text).substr(0, text.find('#'));
    row.clear();
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t begin = all.find_first_not_of(" \t\r,;", at);
      if (begin == std::string_view::npos) break;
      at = std::min(all.find_first_of(" \t\r,;", begin), all.size());
      double height = 0;
      if (!to_height(all.substr(begin, at - begin), height)) {
        return place + "'" + std::string(all.substr(begin, std::min<std::size_t>(at - begin, 20))) +
               "' is no height; write finite numbers with commas or blanks between them, or nan "
               "for a hole";
      }
      row.push_back(height);
    }
    if (row.empty()) continue;  // a blank line, or a comment
    if (const std::string wrong = add_row(row, field); !wrong.empty()) return place + wrong;
  }
  if (file.bad()) return field.path + ": the file cannot be read; check its permissions";
  const std::string wrong = too_few(field);
  return wrong.empty() ? "" : field.path + ": " + wrong;
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
