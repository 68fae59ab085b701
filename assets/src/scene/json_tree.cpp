#include "scene/json_tree.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>

#include "scene/json_fault.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

using Json = nlohmann::json;

// A scene needs about six levels; the cap keeps a hostile file from exhausting the stack when the
// tree is taken down.
constexpr std::size_t kDeepestNesting = 64;

// An iterator that tells how far the parser has read: the parser's callbacks carry no position.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** read_up_to) : at_(at), read_up_to_(read_up_to) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    *read_up_to_ = ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) {
    return a.at_ == b.at_;
  }

 private:
  const char* at_;
  const char** read_up_to_;
};

class LineTable {
 public:
  explicit LineTable(std::string_view text) {
    for (std::size_t k = 0; k < text.size(); ++k)
      if (text[k] == '\n') ends_.push_back(k);
  }
  // Of the character at this offset; the first line is 1.
  [[nodiscard]] int line_at(std::size_t offset) const {
    return 1 +
           static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), offset) - ends_.begin());
  }

 private:
  std::vector<std::size_t> ends_;
};

// In characters of UTF-8, from 1.
int column_at(std::string_view text, std::size_t offset) {
  int column = 1;
  for (std::size_t k = std::min(offset, text.size()); k-- > 0 && text[k] != '\n';)
    if ((static_cast<unsigned char>(text[k]) & 0xc0u) != 0x80u) ++column;
  return column;
}

class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const char* const* read_up_to, JsonNode& root,
              Problems& problems)
      : text_(text), lines_(text), read_up_to_(read_up_to), root_(root), problems_(problems) {}

  bool null() { return add(JsonNode::Kind::Null) != nullptr; }
  bool boolean(bool value) {
    JsonNode* node = add(JsonNode::Kind::Boolean);
    if (node) node->boolean = value;
    return node != nullptr;
  }
  bool number_integer(Json::number_integer_t value) {
    return add_number(static_cast<double>(value));
  }
  bool number_unsigned(Json::number_unsigned_t value) {
    if (!add_number(static_cast<double>(value))) return false;
    last_->is_unsigned = true;
    last_->integer = value;
    return true;
  }
  bool number_float(Json::number_float_t value, const std::string&) { return add_number(value); }
  bool string(std::string& value) {
    JsonNode* node = add(JsonNode::Kind::Text);
    if (node) node->text = std::move(value);
    return node != nullptr;
  }
  bool binary(Json::binary_t&) { return false; }  // no such thing in a text
  bool start_object(std::size_t) { return open(JsonNode::Kind::Object); }
  bool start_array(std::size_t) { return open(JsonNode::Kind::Array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    JsonNode& object = *open_.back();
    if (const JsonMember* first = object.find(name)) {
      problems_.add(line(), "the key '" + name + "' stands here a second time",
                    "remove this one or the one in line " + std::to_string(first->line));
    }
    object.members.push_back({std::move(name), line(), {}});
    return true;
  }
  bool parse_error(std::size_t read, const std::string&, const nlohmann::detail::exception& e) {
    const JsonFault fault = explain_json_fault(text_, read, e.what());
    problems_.add(lines_.line_at(fault.offset), column_at(text_, fault.offset), fault.what,
                  fault.remedy);
    return false;
  }

 private:
  // When a callback comes, the last character read belongs to the token or is the one after it, so
  // that the line of that character, its own line end not counted, is where the token ends.
  [[nodiscard]] int line() const {
    const auto read = static_cast<std::size_t>(*read_up_to_ - text_.data());
    return lines_.line_at(read > 0 ? read - 1 : 0);
  }
  JsonNode* add(JsonNode::Kind kind) {
    if (open_.empty()) {
      last_ = &root_;
    } else if (open_.back()->kind == JsonNode::Kind::Array) {
      last_ = &open_.back()->items.emplace_back();
    } else {
      last_ = &open_.back()->members.back().value;
    }
    last_->kind = kind;
    last_->line = line();
    return last_;
  }
  bool add_number(double value) {
    add(JsonNode::Kind::Number)->number = value;
    return true;
  }
  bool open(JsonNode::Kind kind) {
    if (open_.size() >= kDeepestNesting) {
      problems_.add(line(), "brackets are nested deeper than any scene needs",
                    "check the brackets");
      return false;
    }
    open_.push_back(add(kind));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::string_view text_;
  LineTable lines_;
  const char* const* read_up_to_;
  JsonNode& root_;
  Problems& problems_;
  // Only the innermost open container grows, so pointers to those around it stay good.
  std::vector<JsonNode*> open_;
  JsonNode* last_ = nullptr;
};

}  // namespace

const JsonMember* JsonNode::find(std::string_view key) const {
  for (const JsonMember& member : members)
    if (member.key == key) return &member;
  return nullptr;
}

const char* name_of(JsonNode::Kind kind) {
  switch (kind) {
    case JsonNode::Kind::Null:
      return "null";
    case JsonNode::Kind::Boolean:
      return "true or false";
    case JsonNode::Kind::Number:
      return "a number";
    case JsonNode::Kind::Text:
      return "a text";
    case JsonNode::Kind::Array:
      return "a list";
    case JsonNode::Kind::Object:
      return "an object";
  }
  return "";
}

bool parse_json(std::string_view text, JsonNode& root, Problems& problems) {
  const char* read_up_to = text.data();
  TreeBuilder builder(text, &read_up_to, root, problems);
  const CountingIterator first(text.data(), &read_up_to);
  const CountingIterator last(text.data() + text.size(), &read_up_to);
  return Json::sax_parse(first, last, &builder) && problems.empty();
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
