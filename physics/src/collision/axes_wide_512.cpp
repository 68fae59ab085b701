// The search for axes with vectors of 512 bits (axes_wide.h); compiled for processors that have
// them.
#define PLUMB_VECTOR_BITS 512
#include "collision/axes_wide.h"
