// The search for axes with vectors of 128 bits (axes_wide.h).
#define PLUMB_VECTOR_BITS 128
#include "collision/axes_wide.h"
