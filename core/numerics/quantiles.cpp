#include "core/numerics/quantiles.h"
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace mill {
double chi_square_above(const double probability, const double degrees_of_freedom)
{
  return quantile(complement(boost::math::chi_squared(degrees_of_freedom), probability));
}

double student_above(const double probability, const double degrees_of_freedom)
{
  return quantile(complement(boost::math::students_t(degrees_of_freedom), probability));
}
}  // namespace mill
