// What a call reports. Physics throws nothing and prints nothing: every call that can be given bad
// input returns a Status and, when it is not ok, has changed nothing.
#pragma once

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

enum class StatusCode : unsigned char {
  Ok,
  StaleHandle,      // the handle is null, or what it named was destroyed
  NotFinite,        // a number is NaN or infinite
  OutOfRange,       // a number lies outside its documented range
  BadShape,         // the shape has no volume, is not convex, or does not fit the motion type
  BadMass,          // mass or inertia is not that of any body
  WrongMotionType,  // the call makes no sense for a static (or kinematic) body
  CapacityExceeded,
  BadSnapshot,  // a snapshot does not fit this build or is damaged
  InsideStep,   // called from an observer or a job while the world steps
  Unreachable,  // nothing known is as good, or as cheap, as asked for
};

struct [[nodiscard]] Status {
  StatusCode code = StatusCode::Ok;
  const char* message = "";  // one sentence: what is wrong and what would be right

  [[nodiscard]] constexpr bool ok() const { return code == StatusCode::Ok; }
  constexpr explicit operator bool() const { return ok(); }
};

// A handle, or the reason why there is none.
template <class IdType>
struct [[nodiscard]] Created {
  IdType id{};
  Status status{};

  [[nodiscard]] constexpr bool ok() const { return status.ok(); }
  constexpr explicit operator bool() const { return ok(); }
};

}  // namespace plumb::inline PLUMB_ABI
