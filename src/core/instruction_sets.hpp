/// @file For functions that are compiled for several instruction sets; private to the core.
#pragma once

// The processor's is chosen when the program starts. The results are the same with each, as
// contraction into fused operations is off (core.cmake).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PPF_BIN_PICKING_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define PPF_BIN_PICKING_CLONES
#endif

// For what they call: inlined, or it would be compiled for the least instruction set alone, to
// which wider vectors are passed in another way.
#define PPF_BIN_PICKING_INLINE inline __attribute__((always_inline))
