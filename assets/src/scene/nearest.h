// "Did you mean ...?"
#pragma once

#include <string>
#include <string_view>

#include "scene/keys.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// Insertions, deletions, replacements and swaps of neighbours that turn one text into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The word of the list nearest to `word` if it is near enough to be meant, else an empty text.
std::string_view nearest_of(std::string_view word, Keys list);

// "did you mean 'x'?" or, if nothing is near, "use one of a, b, c".
std::string suggestion(std::string_view word, Keys list);

// "a, b, c"
std::string joined(Keys list);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
