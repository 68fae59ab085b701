// The one definition that says which public headers this library was built with.
#include "plumb/abi_tag.h"

namespace plumb::inline PLUMB_ABI {

const char detail::PLUMB_HEADERS_SYMBOL = 0;

}  // namespace plumb::inline PLUMB_ABI
