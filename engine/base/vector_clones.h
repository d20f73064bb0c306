/// Functions compiled once more for wider vectors.
#pragma once

/// Before a function: the program chooses, when it starts, between its code for every CPU and that for AVX2, where
/// loops take twice as many numbers at once. Answers are the same bits: nothing is fused or reordered. Functions that it
/// calls gain only where they are compiled into it. Not for sanitizers, which are not set up yet when the program chooses.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    defined(__GNUC__) && !defined(__clang__)
#define SPLATRAY_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SPLATRAY_VECTOR_CLONES
#endif
