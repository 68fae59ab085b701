// What joints and effects are shown to when they are written down as numbers and read back: both
// walk through the same list of their fields, so that the two directions cannot differ.
#pragma once

#include <variant>

#include "world/inputs.h"

namespace plumb::inline PLUMB_ABI::detail {

// Writes every value it is shown. (Not const, as what it shares its list with fills them.)
class NumberWriter {
 public:
  explicit NumberWriter(std::vector<double>& out) : out_(out) {}
  void operator()(Real& v) { out_.push_back(static_cast<double>(v)); }
  void operator()(bool& v) { out_.push_back(v ? 1.0 : 0.0); }
  void operator()(std::uint32_t& v) { out_.push_back(static_cast<double>(v)); }
  void operator()(std::uint64_t& v) { append_long(out_, v); }
  void operator()(Vec3& v) { append(out_, v); }
  template <class Tag>
  void operator()(Id<Tag>& id) {
    append_long(out_, id.value());
  }
  void position(Pos3& p) { append_position(out_, p); }
  void unit(Quat& q) { append(out_, q); }
  template <class Enum>
  void choice(Enum& v, std::uint32_t) {
    out_.push_back(static_cast<double>(v));
  }
  template <class T>
  bool presence(std::optional<T>& v) {
    out_.push_back(v.has_value() ? 1.0 : 0.0);
    return v.has_value();
  }

 protected:
  std::vector<double>& out_;
};

// Fills every value it is shown. ok becomes false where a number is no valid choice.
class NumberFiller {
 public:
  NumberFiller(NumberReader& in, bool& ok) : in_(in), ok_(ok) {}
  void operator()(Real& v) { v = in_.real(); }
  void operator()(bool& v) { v = in_.flag(); }
  void operator()(std::uint32_t& v) { v = in_.word(); }
  void operator()(std::uint64_t& v) { v = in_.long_word(); }
  void operator()(Vec3& v) { v = in_.vector(); }
  template <class Tag>
  void operator()(Id<Tag>& id) {
    id = Id<Tag>::from_value(in_.long_word());
  }
  void position(Pos3& p) { p = in_.position(); }
  void unit(Quat& q) { q = in_.orientation(); }
  template <class Enum>
  void choice(Enum& v, std::uint32_t count) {
    const std::uint32_t value = in_.word();
    if (value >= count) ok_ = false;
    v = static_cast<Enum>(value < count ? value : 0);
  }
  template <class T>
  bool presence(std::optional<T>& v) {
    if (in_.flag()) v.emplace();
    return v.has_value();
  }

 protected:
  NumberReader& in_;
  bool& ok_;
};

// Makes the variant hold its alternative of that index, with default values; a larger index leaves
// it as it is.
template <std::size_t I = 0, class... Kinds>
void choose_kind(std::variant<Kinds...>& kind, std::uint32_t index) {
  if constexpr (I < sizeof...(Kinds)) {
    if (index == I) {
      kind.template emplace<I>();
    } else {
      choose_kind<I + 1>(kind, index);
    }
  }
}

// Shows the visitor which kind it is; a filler may choose another one, with default values.
template <class To, class... Kinds>
void visit_index(To& t, std::variant<Kinds...>& kind) {
  std::uint32_t index = static_cast<std::uint32_t>(kind.index());
  t.choice(index, static_cast<std::uint32_t>(sizeof...(Kinds)));
  if (index != kind.index()) choose_kind(kind, index);
}

}  // namespace plumb::inline PLUMB_ABI::detail
