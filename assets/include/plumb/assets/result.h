// A value, or the reason why there is none. Every loader and every mesh routine that can be given
// bad input returns one; the error text says what is wrong, where, and what would be right.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets {

struct Error {
  std::string text;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : data_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : data_(std::in_place_index<1>, std::move(error)) {}

  [[nodiscard]] bool ok() const { return data_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // Only if ok().
  [[nodiscard]] const T& value() const& {
    assert(ok());
    return *std::get_if<0>(&data_);
  }
  [[nodiscard]] T& value() & {
    assert(ok());
    return *std::get_if<0>(&data_);
  }
  [[nodiscard]] T&& value() && {
    assert(ok());
    return std::move(*std::get_if<0>(&data_));
  }
  const T& operator*() const& { return value(); }
  const T* operator->() const { return &value(); }

  // Empty if ok().
  [[nodiscard]] std::string error() const {
    return ok() ? std::string() : std::get_if<1>(&data_)->text;
  }

 private:
  std::variant<T, Error> data_;
};

}  // namespace plumb::inline PLUMB_ABI::assets
