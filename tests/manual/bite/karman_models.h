#pragma once
#include "reduce/bite/slab/karman.h"
#include "tests/manual/bite/bite_passes.h"
#include "tests/manual/check/verification.h"

// What the cases of the integrated slab theories share.
namespace mill::verify {
/// A pass 1 mm wide, so that forces are N per mm of width; strip as elastic as the roll.
bite::RollBite one_mm_wide(const PassRow &row);

/// Pass B1..B9 of the reference tables, 1 mm wide: forces are N per mm of width.
bite::RollBite numbered(int i);

/// Half a unit of the last digit the reference is printed with.
Check printed(const std::string &quantity, const std::string &unit, double result, double reference,
              double half_digit);

bite::KarmanOptions without_curves();

/// N.  The equation of slices with small angles; `capped` is false where the reference lets mu p pass the shear
/// limit.
double force_on_parabola(int i, bool capped);
}  // namespace mill::verify
