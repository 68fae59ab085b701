// For files that are compiled once per vector length, each for its own processors, with
// PLUMB_VECTOR_BITS set: puts all templates and inline functions that follow into an inline
// namespace of their own, so that the linker never takes a copy compiled for a newer processor for
// everyone. PLUMB_SHARED_ABI stays the library's; of it such a file may use plain memory only.
//
// To be included after the headers that are shared and before those that are not.
#pragma once

#define PLUMB_JOIN_(a, b, c) a##b##c
#define PLUMB_JOIN(a, b, c) PLUMB_JOIN_(a, b, c)
#if defined(PLUMB_PRECISION_F64)
#define PLUMB_SHARED_ABI f64
#elif defined(PLUMB_PRECISION_F32D)
#define PLUMB_SHARED_ABI f32d
#else
#define PLUMB_SHARED_ABI f32
#endif
#undef PLUMB_ABI
#define PLUMB_ABI PLUMB_JOIN(PLUMB_SHARED_ABI, _v, PLUMB_VECTOR_BITS)
