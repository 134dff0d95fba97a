#include "tests/manual/bite/karman_models.h"

namespace mill::verify {
namespace {
bite::RollBite one_mm_of(bite::RollBite b)
{
  b.strip.width          = 1e-3;
  b.strip.youngs_modulus = 2.1e11;
  b.strip.poisson_ratio  = 0.28;
  return b;
}
}  // namespace

bite::RollBite one_mm_wide(const PassRow &row)
{
  return one_mm_of(bite_of(row));
}

bite::RollBite numbered(const int i)
{
  return one_mm_of(reference_pass("B" + std::to_string(i)));
}

Check printed(const std::string &quantity, const std::string &unit, const double result, const double reference,
              const double half_digit)
{
  return {quantity, unit, result, reference, half_digit * 1.01, Judged::absolute};
}

bite::KarmanOptions without_curves()
{
  bite::KarmanOptions options;
  options.points = 0;
  return options;
}

double force_on_parabola(const int i, const bool capped)
{
  bite::RollBite b = numbered(i);
  if (!capped)
    b.strip.friction.shear_limit = not_given;
  bite::KarmanOptions options = without_curves();
  options.small_angles        = true;
  return bite::solve_karman(b, bite::Theory::karman, bite::Arc::rigid, nullptr, options).force;
}

}  // namespace mill::verify
