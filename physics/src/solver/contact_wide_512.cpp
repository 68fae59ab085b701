// The contact kernel for vectors of 512 bits (contact_wide.h); compiled for processors that have them.
#define PLUMB_VECTOR_BITS 512
#include "solver/contact_wide.h"
