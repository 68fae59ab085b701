// The search for axes with vectors of 256 bits (axes_wide.h); compiled for processors that have
// them.
#define PLUMB_VECTOR_BITS 256
#include "collision/axes_wide.h"
