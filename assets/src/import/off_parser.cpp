// The text of an OFF file: header, counts, a line for each vertex, a line for each face.
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "import/off_reader.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

// Words between blanks and comments, and the line each stands in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  // The next word, on this line or a later one; empty at the end of the file.
  std::string_view next() {
    skip_blanks(true);
    return take();
  }
  // The next word of this line; empty if there is none.
  std::string_view next_here() {
    skip_blanks(false);
    return take();
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  // Of the word last taken.
  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::size_t left() const { return text_.size() - at_; }  // [byte]

 private:
  void skip_blanks(bool over_lines) {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '#') {
        skip_line();
        if (at_ == text_.size()) return;
      }
      if (text_[at_] == '\n') {
        if (!over_lines) return;
        ++line_;
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) == 0) {
        return;
      }
    }
  }
  std::string_view take() {
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] != '#' &&
           std::isspace(static_cast<unsigned char>(text_[at_])) == 0)
      ++at_;
    return text_.substr(first, at_ - first);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

// Of the whole word; readers of other programs write a plus sign.
template <class Number>
bool parse(std::string_view word, Number& out) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), out);
  return problem == std::errc() && end == word.data() + word.size() && !word.empty();
}

struct Header {
  bool homogeneous = false;  // a fourth coordinate divides the others
  std::size_t vertices = 0, faces = 0;
};

class Parser {
 public:
  explicit Parser(std::string_view text) : words_(text) {}

  Result<OffPolygons> parse_all() {
    Header header;
    OffPolygons out;
    std::string wrong = read_header(header);
    for (std::size_t k = 0; wrong.empty() && k < header.vertices; ++k)
      wrong = read_vertex(k, header, out);
    for (std::size_t k = 0; wrong.empty() && k < header.faces; ++k)
      wrong = read_face(k, header, out);
    if (!wrong.empty()) return Error{std::move(wrong)};
    if (!words_.next().empty()) {
      return Error{at_line() + "there is more after the last of the " +
                   std::to_string(header.faces) + " faces that the header counts"};
    }
    return out;
  }

 private:
  [[nodiscard]] std::string at_line() const {
    return "line " + std::to_string(words_.line()) + ": ";
  }
  // Of a word that is no number, or is not there.
  [[nodiscard]] std::string not_a(const char* wanted, const std::string& where,
                                  std::string_view word) const {
    if (word.empty()) return "the file ends before " + where + "; is it cut off?";
    return at_line() + "'" + std::string(word.substr(0, 40)) + "' is no " + wanted + " of " + where;
  }

  std::string read_header(Header& header) {
    std::string_view word = words_.next();
    const std::string_view whole = word;
    const auto take = [&](std::string_view prefix) {
      if (!word.starts_with(prefix)) return false;
      word.remove_prefix(prefix.size());
      return true;
    };
    (void)take("ST");
    (void)take("C");
    (void)take("N");
    header.homogeneous = take("4");
    const bool any_dimension = take("n");
    if (word != "OFF") return at_line() + "it does not begin with OFF";
    if (any_dimension) {
      std::size_t dimension = 0;
      if (!parse(words_.next(), dimension) || dimension != 3)
        return at_line() + "of " + std::string(whole) + " only 3 dimensions can be read";
    }
    std::string_view count = words_.next();
    if (count == "BINARY") return "binary OFF cannot be read; export it as text";
    if (!parse(count, header.vertices)) return not_a("count", "the vertices", count);
    count = words_.next();
    if (!parse(count, header.faces)) return not_a("count", "the faces", count);
    words_.skip_line();  // the number of edges, which nobody needs and some leave out
    return {};
  }

  std::string read_vertex(std::size_t k, const Header& header, OffPolygons& out) {
    const std::string where =
        "vertex " + std::to_string(k) + " of " + std::to_string(header.vertices);
    double v[4] = {0, 0, 0, 1};
    for (int i = 0; i < (header.homogeneous ? 4 : 3); ++i) {
      const std::string_view word = words_.next();
      if (!parse(word, v[i])) return not_a("coordinate", where, word);
    }
    if (!(v[3] != 0)) return at_line() + where + " lies at infinity";
    out.vertices.emplace_back(v[0] / v[3], v[1] / v[3], v[2] / v[3]);
    words_.skip_line();  // normal, colour and texture
    return {};
  }

  std::string read_face(std::size_t k, const Header& header, OffPolygons& out) {
    const std::string where = "face " + std::to_string(k) + " of " + std::to_string(header.faces);
    std::string_view word = words_.next();
    std::size_t corners = 0;
    if (!parse(word, corners)) return not_a("number of corners", where, word);
    for (std::size_t i = 0; i < corners; ++i) {
      word = words_.next();
      std::int64_t index = 0;
      if (!parse(word, index)) return not_a("index", where, word);
      if (index < 0 || static_cast<std::uint64_t>(index) >= header.vertices) {
        return at_line() + where + " names vertex " + std::to_string(index) + " of " +
               std::to_string(header.vertices) + ", which count from 0";
      }
      out.corners.push_back(static_cast<std::uint32_t>(index));
    }
    out.ends.push_back(out.corners.size());
    words_.skip_line();  // its colour
    return {};
  }

  Words words_;
};

}  // namespace

Result<OffPolygons> parse_off(std::string_view text) { return Parser(text).parse_all(); }

}  // namespace plumb::inline PLUMB_ABI::assets::detail
