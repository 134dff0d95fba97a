#include "twin/spectra/fourier.h"
#include <algorithm>
#include <unsupported/Eigen/FFT>

namespace mill::twin {
struct Fourier::Plans {
  Eigen::FFT<double> half, full;
  Plans()
  {
    half.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  }
};

Fourier::Fourier() : plans(std::make_unique<Plans>()) {}
Fourier::~Fourier() = default;

void Fourier::forward(const std::vector<double> &x, std::vector<std::complex<double>> &X)
{
  plans->half.fwd(X, x);
}

void Fourier::forward(const std::vector<std::complex<double>> &x, std::vector<std::complex<double>> &X)
{
  plans->full.fwd(X, x);
}

void Fourier::inverse(const std::vector<std::complex<double>> &X, std::vector<std::complex<double>> &x)
{
  plans->full.inv(x, X);
}

std::ptrdiff_t quick_length(const std::ptrdiff_t n)
{
  std::ptrdiff_t best = 0;
  for (std::ptrdiff_t five = 1; five <= n; five *= 5)
    for (std::ptrdiff_t three = five; three <= n; three *= 3)
      for (std::ptrdiff_t two = 2 * three; two <= n; two *= 2)
        best = std::max(best, two);
  return best;
}
}  // namespace mill::twin
