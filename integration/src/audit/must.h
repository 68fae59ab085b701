// For what cannot fail unless the audit itself is wrong.
#pragma once

#include <stdexcept>

#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI::audit {

inline void must(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message);
}
template <class Id>
Id must(const Created<Id>& made) {
  must(made.status);
  return made.id;
}

}  // namespace plumb::inline PLUMB_ABI::audit
