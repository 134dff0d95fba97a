#include "app/process/processor.h"

namespace mill {
namespace {
// A macro of the compiler that is not defined stays a name and gives 0.
#define MILL_TEXT(macro) #macro
#define MILL_IS_SET(macro) (MILL_TEXT(macro)[0] == '1' ? 1U : 0U)
}  // namespace

const unsigned compiled_features = MILL_IS_SET(__SSE4_2__) | MILL_IS_SET(__POPCNT__) << 1 |
                                   MILL_IS_SET(__AVX__) << 2 | MILL_IS_SET(__AVX2__) << 3 |
                                   MILL_IS_SET(__FMA__) << 4 | MILL_IS_SET(__BMI2__) << 5 |
                                   MILL_IS_SET(__AVX512F__) << 6 | MILL_IS_SET(__AVX512VL__) << 7 |
                                   MILL_IS_SET(__AVX512DQ__) << 8 | MILL_IS_SET(__AVX512BW__) << 9;
}  // namespace mill
