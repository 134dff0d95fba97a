#include "twin/spectra/fourier.h"
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
}  // namespace mill::twin
