// The version of Plumb, as in the top-level CMakeLists.txt (a test holds the two together).
#pragma once

#define PLUMB_VERSION_STRING "0.1.0"
