#include "reduce/chain/film_in_series.h"
#include <cmath>

namespace mill::reduce {
std::complex<double> film_in_series(const double rest, const SpringAndDamper &film, const double frequency)
{
  const std::complex<double> k(film.stiffness, 2 * M_PI * frequency * film.damper);
  return std::isinf(rest) ? k : rest * (k / (rest + k));
}

SpringAndDamper equivalent_in_series(const double rest, const SpringAndDamper &film, const double frequency)
{
  const std::complex<double> k = film_in_series(rest, film, frequency);
  if (frequency > 0)
    return {k.real(), k.imag() / (2 * M_PI * frequency)};
  const double part = std::isinf(rest) ? 1 : rest / (rest + film.stiffness);  // of the motion that the film has
  return {k.real(), film.damper * part * part};
}
}  // namespace mill::reduce
