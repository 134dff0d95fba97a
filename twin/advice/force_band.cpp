#include "twin/advice/force_band.h"
#include "core/base/require.h"
#include "twin/spectra/welch.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
ForceBand midpoints(const double low, const double high, const double step)
{
  require(low >= 0 && high > low && step > 0, "a band of the force rises and has a step");
  ForceBand band;
  const auto k       = std::max<Eigen::Index>(1, std::llround(std::ceil((high - low) / step - 1e-9)));
  const double width = (high - low) / double(k);
  band.frequency     = Eigen::VectorXd::LinSpaced(k, low + 0.5 * width, high - 0.5 * width);
  band.square        = Eigen::VectorXd::Constant(k, width);
  return band;
}
}  // namespace

ForceBand white_force(const double low, const double high, const double step, const double rms)
{
  ForceBand band = midpoints(low, high, step);
  band.square.setConstant(rms * rms / double(band.frequency.size()));
  return band;
}

ForceBand measured_force(const WelchSpectrum &spectrum, const double low, const double high, const double step)
{
  require(spectrum.n > 0 && spectrum.density.size() > 1, "a measured force needs a spectrum");
  const double end = spectrum.resolution() * double(spectrum.density.size() - 1);
  ForceBand band   = midpoints(low, std::min(high, end), step);
  for (Eigen::Index i = 0; i < band.frequency.size(); ++i) {
    const double bin = band.frequency[i] / spectrum.resolution();
    const auto k     = std::min<Eigen::Index>(Eigen::Index(bin), spectrum.density.size() - 2);
    const double t   = bin - double(k);
    band.square[i] *= (1 - t) * spectrum.density[k] + t * spectrum.density[k + 1];
  }
  band.measured = true;
  return band;
}
}  // namespace mill::twin
