// The contact kernel for vectors of 256 bits (contact_wide.h); compiled for processors that have them.
#define PLUMB_VECTOR_BITS 256
#include "solver/contact_wide.h"
