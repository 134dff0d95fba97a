#include "twin/bearings/fault_lines.h"
#include "core/base/choice.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace mill::twin {
namespace {
enum class Fault { outer, inner, roller, cage };
constexpr auto words_of(Fault)
{
  return choice_words<Fault>("BPFO", "BPFI", "2 BSF", "FTF");
}

constexpr double slip_low = -0.015, slip_high = 0.008, neighbourhood = 0.08;
constexpr Eigen::Index fewest_neighbours = 10;  // bins to each side
constexpr int harmonics = 4, side_bands = 3, shaft_harmonics = 40;

// Squared envelope of the band, from the half of the spectrum above zero.
std::vector<double> squared_envelope(const std::vector<std::complex<double>> &half, const Eigen::Index n,
                                     const double rate, const double low, const double high, Fourier &fourier,
                                     double &kurtosis)
{
  std::vector<std::complex<double>> band(std::size_t(n), 0.0), z;
  const double df = rate / double(n);
  for (auto k = std::size_t(std::ceil(low / df)); k < half.size() && double(k) * df < high; ++k)
    band[k] = 2.0 * half[k];
  fourier.inverse(band, z);
  std::vector<double> square(z.size());
  double second = 0, fourth = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    square[i]      = std::norm(z[i]);
    const double x = z[i].real() * z[i].real();
    second += x;
    fourth += x * x;
  }
  kurtosis = second > 0 ? fourth * double(n) / (second * second) : 0;
  return square;
}

// A spectrum in which bins can be taken out.
class Lines {
public:
  explicit Lines(const EnvelopeSpectrum &s) : spectrum(s), blocked(std::size_t(s.magnitude.size()), false) {}
  void block(const double frequency)
  {
    const auto k = Eigen::Index(std::lround(frequency / spectrum.resolution));
    for (Eigen::Index i = k - 2; i <= k + 2; ++i)
      if (i >= 0 && i < spectrum.magnitude.size())
        blocked[std::size_t(i)] = true;
  }
  // Largest of three bins at a frequency over the median of its neighbourhood; 0 where it is blocked or outside.
  double ratio(const double frequency) const
  {
    const auto k     = Eigen::Index(std::lround(frequency / spectrum.resolution));
    const auto reach = std::max(fewest_neighbours, Eigen::Index(neighbourhood * frequency / spectrum.resolution));
    if (k - 1 < 1 || k + 1 >= spectrum.magnitude.size())
      return 0;
    double largest = 0;
    for (Eigen::Index i = k - 1; i <= k + 1; ++i)
      if (!blocked[std::size_t(i)])
        largest = std::max(largest, spectrum.magnitude[i]);
    const double median = median_at(k, reach);
    return median > 0 ? largest / median : 0;
  }

private:
  double median_at(const Eigen::Index k, const Eigen::Index reach) const
  {
    std::vector<double> around;
    for (Eigen::Index i = std::max<Eigen::Index>(1, k - reach);
         i <= std::min(k + reach, spectrum.magnitude.size() - 1); ++i)
      around.push_back(spectrum.magnitude[i]);
    const auto middle = around.begin() + std::ptrdiff_t(around.size() / 2);
    std::nth_element(around.begin(), middle, around.end());
    return *middle;
  }
  const EnvelopeSpectrum &spectrum;
  std::vector<bool> blocked;
};

FaultLines best_slip(const Lines &lines, const std::string &family, const double frequency,
                     const double resolution)
{
  FaultLines best{family, frequency, 0, {}, 0};
  const double step = std::clamp(resolution / (harmonics * frequency), 1e-4, 2e-3);
  for (double slip = slip_low; slip <= slip_high + 1e-12; slip += step) {
    FaultLines tried{family, frequency, slip, {}, 0};
    for (int h = 1; h <= harmonics; ++h)
      tried.ratio[std::size_t(h - 1)] = lines.ratio(h * frequency * (1 + slip));
    auto sorted = tried.ratio;
    std::sort(sorted.rbegin(), sorted.rend());
    tried.score       = sorted[2];
    const auto sum_of = [](const FaultLines &lines) {
      return std::accumulate(lines.ratio.begin(), lines.ratio.end(), 0.0);
    };
    if (tried.score > best.score || (tried.score == best.score && sum_of(tried) > sum_of(best)))
      best = tried;
  }
  return best;
}

// Harmonics of a family that was found, with the side bands it makes.
void block_family(Lines &lines, const FaultLines &family, const double shaft, const double cage)
{
  const bool by_shaft = family.family != word_of(Fault::roller),
             by_cage  = !by_shaft || family.family == word_of(Fault::outer);
  for (int h = 1; h <= 2 * harmonics; ++h) {
    const double f = h * family.frequency * (1 + family.slip);
    lines.block(f);
    for (int k = 1; k <= side_bands; ++k)
      for (const double sign : {-1.0, 1.0}) {
        if (by_shaft)
          lines.block(f + sign * k * shaft);
        if (by_cage)
          lines.block(f + sign * k * cage);
      }
  }
}
}  // namespace

EnvelopeSpectrum envelope_spectrum(const Eigen::Ref<const Eigen::VectorXd> &value, const double rate,
                                   const double low, const double high, Fourier &fourier)
{
  const Eigen::Index n = value.size() / 2 * 2;
  std::vector<double> x(value.data(), value.data() + n);
  std::vector<std::complex<double>> half;
  fourier.forward(x, half);
  EnvelopeSpectrum result;
  std::vector<double> square;
  if (high > low)
    square = squared_envelope(half, n, rate, result.low = low, result.high = high, fourier, result.kurtosis);
  else
    for (double f = 1250; f * 1.122 < rate / 2.56; f *= 1.2599) {
      double kurtosis = 0;
      auto tried      = squared_envelope(half, n, rate, f / 1.122, f * 1.122, fourier, kurtosis);
      if (kurtosis > result.kurtosis) {
        result.kurtosis = kurtosis;
        result.low      = f / 1.122;
        result.high     = f * 1.122;
        square          = std::move(tried);
      }
    }
  if (square.empty())
    return result;
  double mean = 0;
  for (const double s : square)
    mean += s / double(n);
  for (Eigen::Index i = 0; i < n; ++i)
    square[std::size_t(i)] =
        (square[std::size_t(i)] - mean) * (0.5 - 0.5 * std::cos(2 * M_PI * double(i) / double(n)));
  fourier.forward(square, half);
  result.resolution = rate / double(n);
  const auto kept   = std::min<Eigen::Index>(Eigen::Index(half.size()), Eigen::Index(2000 / result.resolution));
  result.magnitude.resize(kept);
  for (Eigen::Index k = 0; k < kept; ++k)
    result.magnitude[k] = 4 / double(n) * std::abs(half[std::size_t(k)]);
  return result;
}

std::vector<FaultLines> fault_lines(const EnvelopeSpectrum &spectrum, const TurningBearing &bearing,
                                    const double shaft)
{
  std::vector<FaultLines> families;
  if (spectrum.magnitude.size() == 0 || !std::isfinite(bearing.cage))
    return families;
  Lines lines(spectrum);
  for (int k = 1; k <= shaft_harmonics; ++k)
    lines.block(k * shaft);
  std::vector<std::pair<std::string, double>> left{{word_of(Fault::outer), bearing.outer * shaft},
                                                   {word_of(Fault::inner), bearing.inner * shaft},
                                                   {word_of(Fault::roller), 2 * bearing.roller * shaft},
                                                   {word_of(Fault::cage), bearing.cage * shaft}};
  while (!left.empty()) {
    FaultLines best;
    for (const auto &[family, frequency] : left)
      if (FaultLines tried = best_slip(lines, family, frequency, spectrum.resolution);
          best.family.empty() || tried.score > best.score)
        best = tried;
    families.push_back(best);
    if (best.indicated())
      block_family(lines, best, shaft, bearing.cage * shaft);
    left.erase(std::find_if(left.begin(), left.end(), [&](const auto &f) { return f.first == best.family; }));
  }
  return families;
}
}  // namespace mill::twin
