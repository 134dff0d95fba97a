#pragma once

// What the processor has to have.  A program for x86-64-v2 (packages), or for the processor that it was built on,
// ends on an older one with "illegal instruction"; processor_check.cpp says it in a sentence before that.
namespace mill {
/// The features that this program was compiled with, one bit each: sse4.2, popcnt, avx, avx2, fma, bmi2, avx512f,
/// avx512vl, avx512dq, avx512bw.
extern const unsigned compiled_features;
}  // namespace mill
