#pragma once
#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

namespace mill::twin {
/// Discrete Fourier transforms of one thread; tables of a length are made once.
class Fourier {
public:
  Fourier();
  ~Fourier();
  Fourier(const Fourier &)            = delete;
  Fourier &operator=(const Fourier &) = delete;
  /// sum x_n exp(-2 pi i n k / N), k = 0 .. N/2.  N even.
  void forward(const std::vector<double> &x, std::vector<std::complex<double>> &X);
  void forward(const std::vector<std::complex<double>> &x, std::vector<std::complex<double>> &X);
  /// 1/N sum X_k exp(+2 pi i n k / N)
  void inverse(const std::vector<std::complex<double>> &X, std::vector<std::complex<double>> &x);

private:
  struct Plans;
  std::unique_ptr<Plans> plans;
};

/// Largest even number of at most n samples without prime factors above 5; 0 below 2.
std::ptrdiff_t quick_length(std::ptrdiff_t n);
}  // namespace mill::twin
