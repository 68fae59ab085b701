// What is being done, for people who wait.
#pragma once

#include <functional>
#include <string>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets {

// Called before each piece of work that takes long on large meshes, on the calling thread, with the
// work's name: "mesh 'gear': convex hull of 8000 vertices". May be empty.
using WorkListener = std::function<void(const std::string& work)>;

}  // namespace plumb::inline PLUMB_ABI::assets
