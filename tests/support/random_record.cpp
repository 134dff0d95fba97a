#include "tests/support/random_record.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

namespace random_record {
namespace {
using mill::twin::Quantity;

// Numbers of one seed; written out, since the distributions of the library differ from one library to the next.
class Draw {
public:
  explicit Draw(const std::uint64_t seed) : engine(seed * 0x9e3779b97f4a7c15ULL + 1) {}
  double uniform(const double low = 0, const double high = 1)
  {
    return low + (high - low) * double(engine() >> 11) / 9007199254740992.0;
  }
  double logarithmic(const double low, const double high)
  {
    return low * std::pow(high / low, uniform());
  }
  int whole(const int low, const int high)
  {
    return low + int(uniform() * (high - low + 1));
  }
  double normal()
  {
    if (spare) {
      spare = false;
      return kept;
    }
    const double r = std::sqrt(-2 * std::log(1 - uniform())), phase = 2 * M_PI * uniform();
    kept  = r * std::sin(phase);
    spare = true;
    return r * std::cos(phase);
  }

private:
  std::mt19937_64 engine;
  double kept = 0;
  bool spare  = false;
};

// Noise of one pole on top of white noise: density of both, one-sided.
struct Noise {
  double white = 1, pole = 0, share = 0;  // rms of the input of the pole against the white part
  double density(const double f, const double rate) const
  {
    const double w = 2 * M_PI * f / rate;
    return 2 / rate * (white * white + share * share / (1 + pole * pole - 2 * pole * std::cos(w)));
  }
};

// A mode under white noise: two poles; peak of its density against a floor.
double resonator_gain(const double f, const double damping, const double rate, const double frequency)
{
  const double w = 2 * M_PI * f / rate, r = std::exp(-damping * w),
               a               = 2 * r * std::cos(w * std::sqrt(1 - damping * damping));
  const std::complex<double> q = std::polar(1.0, -2 * M_PI * frequency / rate);
  return 1 / std::norm(1.0 - a * q + r * r * q * q);
}

void add_mode(Eigen::VectorXd &x, const Content::Mode &mode, const double rate, const double floor,
              const double weight, Draw &draw)
{
  const double w = 2 * M_PI * mode.frequency / rate, r = std::exp(-mode.damping * w),
               a    = 2 * r * std::cos(w * std::sqrt(1 - mode.damping * mode.damping));
  const double size = weight * std::sqrt(std::pow(10, mode.decibel / 10) * floor * rate / 2 /
                                         resonator_gain(mode.frequency, mode.damping, rate, mode.frequency));
  double before = 0, last = 0;
  const auto warm = Eigen::Index(std::min(5e5, 6 * rate / (mode.damping * 2 * M_PI * mode.frequency)));
  for (Eigen::Index k = -warm; k < x.size(); ++k) {
    const double now = a * last - r * r * before + size * draw.normal();
    before           = last;
    last             = now;
    if (k >= 0)
      x[k] += now;
  }
}

// a sin(w k + phase): the phasor is stepped, and set right every block.
void add_line(Eigen::VectorXd &x, const double a, const double w, const double phase)
{
  constexpr Eigen::Index block    = 1024;
  const std::complex<double> step = std::polar(1.0, w);
  for (Eigen::Index first = 0; first < x.size(); first += block) {
    std::complex<double> phasor = std::polar(a, w * double(first) + phase);
    for (Eigen::Index k = first; k < std::min(first + block, x.size()); ++k, phasor *= step)
      x[k] += phasor.imag();
  }
}

double segment_bandwidth(const Eigen::Index n, const double rate)
{
  Eigen::Index L = 2;
  while (9 * L <= n)
    L *= 2;
  L = std::min<Eigen::Index>(L, 1 << 17);
  return 1.5 * rate / double(L);
}
}  // namespace

Record make(const std::uint64_t seed, const Wish &wish)
{
  Draw draw(seed);
  Record record;
  Content &content = record.content;
  double rate, T;
  int channels;
  do {
    rate     = std::round(draw.logarithmic(1000, 50000));
    T        = draw.logarithmic(4, 600);
    channels = draw.whole(1, 4);
  } while (rate * T * channels > wish.most_samples);
  const auto n           = Eigen::Index(rate * T);
  const double bandwidth = segment_bandwidth(n, rate), bin = bandwidth / 1.5;
  const double low = std::max(10.0, 12 * bin), high = rate / 2.6;
  Noise noise;
  if (draw.uniform() < 0.5) {
    noise.pole  = draw.uniform(0.3, 0.97);
    noise.share = draw.logarithmic(0.1, 3);
  }
  if (wish.modes)
    for (int i = draw.whole(0, 6); i > 0; --i) {
      Content::Mode mode{draw.logarithmic(low, high), draw.logarithmic(0.001, 0.05), draw.uniform(20, 40), 0};
      mode.decays      = mode.damping * 2 * M_PI * mode.frequency * T;
      const bool apart = std::all_of(content.modes.begin(), content.modes.end(), [&](const auto &other) {
        return std::abs(other.frequency - mode.frequency) >
                   4 * (other.damping * other.frequency + mode.damping * mode.frequency) + 12 * bin &&
               std::abs(std::log(other.frequency / mode.frequency)) > 0.25;
      });
      if (apart)
        content.modes.push_back(mode);
    }
  const auto density_at = [&](const double f) {
    double density = noise.density(f, rate);
    for (const auto &mode : content.modes)
      density += std::pow(10, mode.decibel / 10) * noise.density(mode.frequency, rate) *
                 resonator_gain(mode.frequency, mode.damping, rate, f) /
                 resonator_gain(mode.frequency, mode.damping, rate, mode.frequency);
    return density;
  };
  if (wish.lines)
    for (int i = draw.whole(0, 30); i > 0; --i) {
      const Content::Line line{draw.uniform(low, high), draw.uniform(10, 60), draw.whole(0, channels - 1),
                               draw.uniform() < 0.1};
      const bool apart = std::all_of(content.lines.begin(), content.lines.end(), [&](const auto &other) {
        return std::abs(other.frequency - line.frequency) > (line.modulated || other.modulated ? 60 : 10) * bin;
      });
      if (apart)
        content.lines.push_back(line);
    }
  if (wish.impacts && rate > 6000 && draw.uniform() < 0.15) {
    content.impacts = draw.uniform(20, 200);
    content.ring    = draw.uniform(0.15, 0.35) * rate;
  }
  if (wish.growth && T > 8) {
    content.growth           = draw.uniform(0.5, 2);
    const double lasts       = std::max(3.0, 2.0 / content.growth);
    content.growth_from      = draw.uniform(4, T - lasts - 0.5);
    content.growth_to        = content.growth_from + lasts;
    content.growth_frequency = draw.uniform(std::max(low, 30.0), std::min(high, 900.0));
  }
  std::vector<Eigen::VectorXd> x;
  for (int c = 0; c < channels; ++c)
    x.emplace_back(n);
  for (auto &values : x) {
    double state = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      state     = noise.pole * state + noise.share * draw.normal();
      values[k] = noise.white * draw.normal() + state;
    }
  }
  for (const auto &mode : content.modes) {
    const double floor = noise.density(mode.frequency, rate);
    for (int c = 0; c < channels; ++c)  // channels of one mode move together; here each has a noise of its own
      add_mode(x[std::size_t(c)], mode, rate, floor, c == 0 ? 1 : draw.uniform(0.3, 1), draw);
  }
  for (auto &line : content.lines) {
    const double a     = std::sqrt(2 * std::pow(10, line.decibel / 10) * density_at(line.frequency) * bandwidth);
    const double phase = draw.uniform(0, 2 * M_PI), depth = draw.uniform(0.1, 0.6);
    const double beat = draw.uniform(8, 40) * bin;
    if (line.modulated)
      for (const double side : {-1.0, 1.0})
        content.side_bands.push_back(line.frequency + side * beat);
    const double w = 2 * M_PI * line.frequency / rate, wb = 2 * M_PI * beat / rate;
    const bool in_frequency = draw.uniform() < 0.5;
    if (!line.modulated)
      add_line(x[std::size_t(line.channel)], a, w, phase);
    for (Eigen::Index k = 0; line.modulated && k < n; ++k) {
      const double m = depth * std::sin(wb * double(k));
      x[std::size_t(line.channel)][k] +=
          a * (in_frequency ? 1 : 1 + m) * std::sin(w * double(k) + phase + (in_frequency ? m : 0));
    }
  }
  if (content.impacts > 0) {
    const double size = draw.logarithmic(2, 30), damping = draw.uniform(0.02, 0.05), w = 2 * M_PI * content.ring;
    for (double time = 0.1; time < T - 0.1; time += (1 + 0.01 * draw.normal()) / content.impacts)
      for (auto k = Eigen::Index(std::ceil(time * rate)); k < std::min(n, Eigen::Index((time + 0.02) * rate));
           ++k) {
        const double s = double(k) / rate - time;
        x[0][k] += size * std::exp(-damping * w * s) * std::sin(w * s);
      }
  }
  if (content.growth > 0) {
    // 20 dB over the noise in the band of the envelope, 40 Hz wide, before it grows
    const double top = std::sqrt(2 * std::pow(10, 2.0) * density_at(content.growth_frequency) * 40) *
                       std::exp(content.growth * (content.growth_to - content.growth_from));
    const double w = 2 * M_PI * content.growth_frequency / rate;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double t = double(k) / rate;
      const double a =
          t < content.growth_to
              ? top * std::exp(content.growth * (std::max(t, content.growth_from) - content.growth_to))
              : top * std::exp(-2 * (t - content.growth_to));
      x[0][k] += a * std::sin(w * double(k));
    }
  }
  record.raw.file   = "seed-" + std::to_string(seed) + ".csv";
  record.raw.format = "made";
  record.raw.rate   = rate;
  for (int c = 0; c < channels; ++c) {
    const std::string name = "sensor_" + std::to_string(c + 1);
    record.raw.channels.push_back({name, name, "m/s2", Quantity::acceleration, true, {}, x[std::size_t(c)]});
  }
  return record;
}
}  // namespace random_record
