#include "scene/object_reader.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "scene/nearest.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

std::string printed(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string printed(const Range& range) {
  const bool low = std::isfinite(range.lower);
  const bool high = std::isfinite(range.upper);
  if (low && high) return "from " + printed(range.lower) + " to " + printed(range.upper);
  if (low) return (range.above_lower ? "> " : ">= ") + printed(range.lower);
  return "that is finite";
}

bool inside(double value, const Range& range) {
  return std::isfinite(value) && value >= range.lower && value <= range.upper &&
         !(range.above_lower && value == range.lower);
}

std::string quoted(std::string_view key) { return "'" + std::string(key) + "'"; }

}  // namespace

ObjectReader::ObjectReader(const JsonNode& node, std::string what, Keys keys, Problems& problems)
    : node_(node), what_(std::move(what)), keys_(keys), problems_(problems) {
  if (!is_object()) {
    problems_.add(node.line, what_ + " is " + name_of(node.kind),
                  "write an object, { ... }, with keys among " + joined(keys));
    return;
  }
  for (const JsonMember& member : node.members) {
    if (!knows(member.key)) {
      problems_.add(member.line, "unknown key " + quoted(member.key) + " in " + what_,
                    suggestion(member.key, keys));
    }
  }
}

bool ObjectReader::knows(std::string_view key) const {
  return std::find(keys_.begin(), keys_.end(), key) != keys_.end();
}

const JsonNode* ObjectReader::find(std::string_view key) const {
  assert(knows(key));
  const JsonMember* member = node_.find(key);
  return member ? &member->value : nullptr;
}

int ObjectReader::line_of(std::string_view key) const {
  const JsonMember* member = node_.find(key);
  return member ? member->line : node_.line;
}

bool ObjectReader::wrong_kind(std::string_view key, const JsonNode& value,
                              const std::string& wanted) const {
  problems_.add(value.line, quoted(key) + " of " + what_ + " is " + name_of(value.kind),
                "write " + wanted);
  return false;
}

void ObjectReader::missing(std::string_view key, const std::string& remedy) const {
  problems_.add(node_.line, what_ + " has no " + quoted(key), remedy);
}

bool ObjectReader::number(std::string_view key, double& out, const Range& range) const {
  const JsonNode* value = find(key);
  if (!value) return false;
  if (value->kind != JsonNode::Kind::Number)
    return wrong_kind(key, *value, "a number " + printed(range));
  if (!inside(value->number, range)) {
    problems_.add(value->line, quoted(key) + " of " + what_ + " is " + printed(value->number),
                  "write a number " + printed(range));
    return false;
  }
  out = value->number;
  return true;
}

bool ObjectReader::integer(std::string_view key, std::int64_t& out, std::int64_t lower,
                           std::int64_t upper) const {
  double wide = 0;
  if (!number(key, wide, {static_cast<double>(lower), static_cast<double>(upper), false}))
    return false;
  if (wide != std::floor(wide)) {
    problems_.add(line_of(key), quoted(key) + " of " + what_ + " is " + printed(wide),
                  "write a whole number");
    return false;
  }
  out = static_cast<std::int64_t>(wide);
  return true;
}

bool ObjectReader::flag(std::string_view key, bool& out) const {
  const JsonNode* value = find(key);
  if (!value) return false;
  if (value->kind != JsonNode::Kind::Boolean) return wrong_kind(key, *value, "true or false");
  out = value->boolean;
  return true;
}

bool ObjectReader::text(std::string_view key, std::string& out) const {
  const JsonNode* value = find(key);
  if (!value) return false;
  if (value->kind != JsonNode::Kind::Text) return wrong_kind(key, *value, "a text in quotes");
  out = value->text;
  return true;
}

bool ObjectReader::numbers(std::string_view key, double* out, std::size_t count) const {
  const JsonNode* value = find(key);
  if (!value) return false;
  const std::string wanted = "a list of " + std::to_string(count) + " finite numbers";
  if (value->kind != JsonNode::Kind::Array) return wrong_kind(key, *value, wanted);
  if (value->items.size() != count) {
    problems_.add(value->line,
                  quoted(key) + " of " + what_ + " has " + std::to_string(value->items.size()) +
                      (value->items.size() == 1 ? " entry" : " entries"),
                  "write " + wanted);
    return false;
  }
  for (const JsonNode& item : value->items)
    if (item.kind != JsonNode::Kind::Number) return wrong_kind(key, item, wanted);
  for (std::size_t k = 0; k < count; ++k) out[k] = value->items[k].number;
  return true;
}

bool ObjectReader::vector(std::string_view key, Eigen::Vector3d& out, const Range& range) const {
  Eigen::Vector3d read;
  if (!numbers(key, read.data(), 3)) return false;
  for (const double entry : read) {
    if (inside(entry, range)) continue;
    problems_.add(line_of(key), quoted(key) + " of " + what_ + " holds " + printed(entry),
                  "write three numbers " + printed(range));
    return false;
  }
  out = read;
  return true;
}

bool ObjectReader::choice(std::string_view key, Keys words, std::size_t& out) const {
  const JsonNode* value = find(key);
  if (!value) return false;
  if (value->kind != JsonNode::Kind::Text)
    return wrong_kind(key, *value, "one of " + joined(words));
  const auto found = std::find(words.begin(), words.end(), value->text);
  if (found == words.end()) {
    problems_.add(value->line, quoted(key) + " of " + what_ + " is '" + value->text + "'",
                  suggestion(value->text, words));
    return false;
  }
  out = static_cast<std::size_t>(found - words.begin());
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
