#include "scene/json_fault.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

constexpr std::size_t kShownLength = 30;  // [byte] of a token in a message

struct Token {
  enum class Kind { None, Mark, Text, Word, Comment } kind = Kind::None;
  std::size_t begin = 0, end = 0;  // [byte]
};

// The tokens around the place where the parser gave up, and the brackets that are open there.
struct Surroundings {
  Token before_previous, previous, found;  // found: of kind None at the end of the text
  std::vector<std::size_t> open;           // offsets of brackets
};

// A text ends with its quote, or, if that is missing, with its line.
std::size_t end_of_text(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  for (std::size_t k = begin + 1; k < text.size(); ++k) {
    if (text[k] == '\\') {
      ++k;
    } else if (text[k] == quote) {
      return k + 1;
    } else if (text[k] == '\n') {
      return k + 1;
    }
  }
  return text.size();
}

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

Token token_at(std::string_view text, std::size_t begin) {
  constexpr std::string_view kMarks = "[]{},:";
  const char first = text[begin];
  if (kMarks.find(first) != std::string_view::npos) return {Token::Kind::Mark, begin, begin + 1};
  if (first == '"' || first == '\'') return {Token::Kind::Text, begin, end_of_text(text, begin)};
  if (first == '#' || first == '/')
    return {Token::Kind::Comment, begin, std::min(text.size(), begin + 2)};
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end]) && text[end] != '"' &&
         kMarks.find(text[end]) == std::string_view::npos)
    ++end;
  return {Token::Kind::Word, begin, end};
}

// read > 0: the character before it is part of the token that was not expected, or ends it.
Surroundings look_around(std::string_view text, std::size_t read) {
  Surroundings out;
  const bool has_mark = text.starts_with("\xef\xbb\xbf");  // the byte order mark of UTF-8
  for (std::size_t at = has_mark ? 3 : 0; at < text.size();) {
    if (is_blank(text[at])) {
      ++at;
      continue;
    }
    const Token token = token_at(text, at);
    if (token.end >= read) {
      out.found = token;
      return out;
    }
    const char first = text[token.begin];
    if (token.kind == Token::Kind::Mark && (first == '[' || first == '{'))
      out.open.push_back(token.begin);
    if (token.kind == Token::Kind::Mark && (first == ']' || first == '}') && !out.open.empty())
      out.open.pop_back();
    out.before_previous = out.previous;
    out.previous = token;
    at = token.end;
  }
  out.found.begin = out.found.end = text.size();
  return out;
}

class Explainer {
 public:
  Explainer(std::string_view text, std::size_t read, const std::string& message)
      : text_(text), message_(message), around_(look_around(text, read)) {}

  JsonFault explain() const {
    const Token& found = around_.found;
    if (around_.previous.kind == Token::Kind::None && found.kind == Token::Kind::None)
      return fault("the file is empty", "write a scene, { \"plumb_scene\": 1, ... }");
    if (found.kind == Token::Kind::Comment)
      return fault("JSON has no comments", "remove it; \"description\" is for texts");
    if (around_.open.empty() && around_.previous.kind != Token::Kind::None)
      return fault("there is more after the end of the scene",
                   "look before this for a bracket that closes too early, or remove the rest");
    if (is_torn(around_.previous)) return bad_text(around_.previous);
    if (found.kind == Token::Kind::None) return cut_off();
    // The parser goes one character beyond a number that ends too early.
    if (around_.previous.kind == Token::Kind::Word &&
        message_.find("invalid number") != std::string::npos)
      return bad_word(around_.previous);
    if (after(',') && is_closing(found)) {
      return {around_.previous.begin,
              std::string("JSON does not allow a comma before ") + first_of(found), "remove it"};
    }
    if (closes_another()) {
      return fault(std::string(1, first_of(found)) + " closes a bracket of the other kind",
                   "look for a bracket too few or too many before it");
    }
    if (found.kind == Token::Kind::Text && first_of(found) == '\'')
      return fault("texts and keys stand in double quotes", "write \"...\"");
    if (follows_value() && (!is_mark(found) || is_opening(found)))
      return fault("a comma is missing before " + shown(found), "add it");
    if (follows_key()) return fault("a colon is missing before " + shown(found), "add it");
    if (wants_key()) {
      return found.kind == Token::Kind::Word
                 ? fault("the key " + shown(found) + " has no quotes",
                         "write \"" + std::string(raw(found)) + "\"")
                 : fault(shown(found) + " stands where a key is expected",
                         "write \"key\": value, and no comma too many");
    }
    if (found.kind == Token::Kind::Word) return bad_word(found);
    if (found.kind == Token::Kind::Text) return bad_text(found);
    return fault(shown(found) + " stands where a value is expected",
                 "look here and just before for a comma, quote or bracket too few or too many");
  }

 private:
  [[nodiscard]] char first_of(const Token& token) const { return text_[token.begin]; }
  [[nodiscard]] std::string_view raw(const Token& token) const {
    return text_.substr(token.begin, std::min(token.end - token.begin, kShownLength));
  }
  [[nodiscard]] std::string shown(const Token& token) const {
    std::string out(raw(token));
    while (!out.empty() && is_blank(out.back())) out.pop_back();
    for (char& c : out)
      if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = '?';
    return out;
  }
  [[nodiscard]] static bool is_mark(const Token& token) { return token.kind == Token::Kind::Mark; }
  [[nodiscard]] bool is_closing(const Token& token) const {
    return is_mark(token) && (first_of(token) == ']' || first_of(token) == '}');
  }
  [[nodiscard]] bool is_opening(const Token& token) const {
    return is_mark(token) && (first_of(token) == '[' || first_of(token) == '{');
  }
  [[nodiscard]] bool after(char mark) const {
    return is_mark(around_.previous) && first_of(around_.previous) == mark;
  }
  [[nodiscard]] bool in_object() const {
    return !around_.open.empty() && text_[around_.open.back()] == '{';
  }
  [[nodiscard]] bool closes_another() const {
    return is_closing(around_.found) && (first_of(around_.found) == '}') != in_object();
  }
  [[nodiscard]] bool wants_key() const { return in_object() && (after('{') || after(',')); }
  [[nodiscard]] bool follows_key() const {
    const Token& before = around_.before_previous;
    return in_object() && around_.previous.kind == Token::Kind::Text && is_mark(before) &&
           (first_of(before) == '{' || first_of(before) == ',');
  }
  [[nodiscard]] bool follows_value() const {
    return (!is_mark(around_.previous) || is_closing(around_.previous)) && !follows_key() &&
           around_.previous.kind != Token::Kind::None;
  }
  [[nodiscard]] JsonFault fault(std::string what, std::string remedy) const {
    return {around_.found.begin, std::move(what), std::move(remedy)};
  }

  [[nodiscard]] JsonFault cut_off() const {
    const auto line =
        1 + std::count(text_.begin(),
                       text_.begin() + static_cast<std::ptrdiff_t>(
                                           around_.open.empty() ? 0 : around_.open.back()),
                       '\n');
    return {around_.previous.end > 0 ? around_.previous.end - 1 : 0,
            "the file ends before the bracket of line " + std::to_string(line) + " is closed",
            "close it, or fetch the whole file"};
  }

  [[nodiscard]] JsonFault bad_word(const Token& token) const {
    const char first = first_of(token);
    const std::string word = shown(token);
    if (message_.find("overflow") != std::string::npos)
      return {token.begin, "the number " + word + " is too large", "write one below 1e308"};
    if (first == '+' || first == '-' || first == '.' ||
        std::isdigit(static_cast<unsigned char>(first)) != 0) {
      return {token.begin, word + " is no number of JSON",
              "begin it with a digit or -, without leading zeros, with digits on both sides of a "
              "point"};
    }
    return {token.begin, word + " is no value of JSON",
            "write a number, a text in double quotes, true, false or null"};
  }

  // A text without its second quote.
  [[nodiscard]] bool is_torn(const Token& token) const {
    return token.kind == Token::Kind::Text &&
           (token.end - token.begin < 2 || text_[token.end - 1] != first_of(token));
  }

  [[nodiscard]] JsonFault bad_text(const Token& token) const {
    const std::string words = "the text " + shown(token);
    if (is_torn(token))
      return {token.begin, words + " does not end in its line", "close it with \""};
    if (message_.find("UTF-8") != std::string::npos)
      return {token.begin, words + " is not in UTF-8", "save the file as UTF-8"};
    return {token.begin, words + " holds a \\ or a control character that JSON does not know",
            "write \\\\ for a backslash, \\n for a new line, \\t for a tab"};
  }

  std::string_view text_;
  const std::string& message_;
  Surroundings around_;
};

}  // namespace

JsonFault explain_json_fault(std::string_view text, std::size_t read, const std::string& message) {
  return Explainer(text, read, message).explain();
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
