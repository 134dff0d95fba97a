#include "twin/live/display/place_spectrum.h"
#include "core/base/si_unit.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::live {
namespace {
constexpr double wanted_distance    = 1.25;  // Hz between points, about
constexpr std::size_t most_points   = 1024;
constexpr std::size_t most_pieces   = 24;
constexpr double pieces_every       = 0.25;  // s of record
constexpr double shown_at_most      = 0.2;   // s of the clock
constexpr std::int64_t wave_samples = 512;

// Place of a sample in a ring, also where the numbers are below zero.
std::size_t in_ring(const std::int64_t s, const std::size_t length)
{
  const std::int64_t n = std::int64_t(length);
  return std::size_t((s % n + n) % n);
}

std::vector<double> hann(const std::size_t n)
{
  std::vector<double> window(n);
  for (std::size_t i = 0; i < n; ++i)
    window[i] = 0.5 - 0.5 * std::cos(2 * M_PI * double(i) / double(n));
  return window;
}

double mean(const std::vector<double> &values)
{
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum / double(values.size());
}

// Root of the mean of the pieces that have it; empty where none has.
template <class Pieces, class Member> std::vector<float> density(const Pieces &pieces, const Member member)
{
  std::vector<double> sum;
  int n = 0;
  for (const auto &piece : pieces) {
    const std::vector<double> &values = piece.*member;
    if (values.empty())
      continue;
    sum.resize(values.size());
    for (std::size_t k = 0; k < values.size(); ++k)
      sum[k] += values[k];
    ++n;
  }
  std::vector<float> out;
  for (const double value : sum)
    out.push_back(float(std::sqrt(value / n)));
  return out;
}
}  // namespace

void PlaceSpectrum::begin(const LiveSource &source)
{
  rate_       = source.rate;
  start_time_ = source.start_time;
  length_     = std::size_t(1) << std::max(6, int(std::lround(std::log2(rate_ / wanted_distance))));
  points_     = std::min(most_points, length_ / 2 + 1);
  window_     = hann(length_);
  places_.clear();
  for (const std::string &name : source.places) {
    Place place{name, -1, {}, std::vector<double>(length_, 0)};
    for (std::size_t c = 0; c < source.channels.size(); ++c)
      if (source.channels[c].name == name && is_in(source.channels[c].unit, SiUnit::acceleration))
        place.channel = Eigen::Index(c);
    if (place.channel >= 0)
      place.measured.assign(length_, 0);
    places_.push_back(std::move(place));
  }
  // The one that was wanted, else the first that is measured, else the first.
  chosen_          = 0;
  const auto first = std::find_if(places_.begin(), places_.end(), [](const Place &p) { return p.channel >= 0; });
  if (first != places_.end())
    chosen_ = std::size_t(first - places_.begin());
  choose(wanted_);
  filled_ = 0;
  end_ = changed_at_ = std::numeric_limits<std::int64_t>::min();  // nothing came, so nothing is of another twin
  start_again();
}

void PlaceSpectrum::choose(const std::string &place)
{
  wanted_ = place;
  for (std::size_t p = 0; p < places_.size(); ++p)
    if (places_[p].name == place && p != chosen_) {
      chosen_ = p;
      start_again();
    }
}

const std::string &PlaceSpectrum::place() const
{
  return places_.empty() ? wanted_ : places_[chosen_].name;
}

void PlaceSpectrum::start_again()
{
  pieces_.clear();
  since_ = 0;
}

void PlaceSpectrum::twin_changed()
{
  changed_at_ = end_;
  start_again();
}

void PlaceSpectrum::put(const LiveBlock &block)
{
  if (block.after_gap) {
    filled_ = 0;
    start_again();
  }
  const Eigen::Index n = block.force.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t index = in_ring(block.first + i, length_);
    for (std::size_t p = 0; p < places_.size(); ++p) {
      places_[p].simulated[index] = block.simulated(i, Eigen::Index(p));
      if (places_[p].channel >= 0)
        places_[p].measured[index] = block.measured(i, places_[p].channel);
    }
  }
  end_ = block.first + n;
  filled_ += n;
  since_ += n;
}

// Two real signals in one complex transform: Z = A + i B, 2 A_k = Z_k + conj Z_-k, 2 i B_k = Z_k - conj Z_-k.
void PlaceSpectrum::add_piece(const Place &place)
{
  const auto n          = std::int64_t(length_);
  const double level[2] = {mean(place.simulated), place.channel >= 0 ? mean(place.measured) : NAN};
  const bool measured = std::isfinite(level[1]), driven = std::isfinite(level[0]);
  std::vector<std::complex<double>> z(length_), Z;
  double power = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    const std::size_t index = in_ring(end_ + i, length_), k = std::size_t(i);  // the oldest first
    z[k] = window_[k] * std::complex<double>(driven ? place.simulated[index] - level[0] : 0,
                                             measured ? place.measured[index] - level[1] : 0);
    power += window_[k] * window_[k];
  }
  fourier_.forward(z, Z);
  const double factor = 2 / (rate_ * power);
  Piece piece;
  for (std::size_t k = 0; k < points_; ++k) {
    const std::complex<double> a = Z[k], b = std::conj(Z[(length_ - k) % length_]);
    if (driven)
      piece.simulated.push_back(factor * std::norm((a + b) / 2.0));
    if (measured)
      piece.measured.push_back(factor * std::norm((a - b) / 2.0));
  }
  piece.whole = end_ - n >= changed_at_;
  if (!pieces_.empty() && !pieces_.back().whole)
    pieces_.clear();
  pieces_.push_back(std::move(piece));
  if (pieces_.size() > most_pieces)
    pieces_.pop_front();
}

PageSpectrum PlaceSpectrum::text_of(const Place &place) const
{
  PageSpectrum out;
  out.place     = place.name;
  out.utc       = start_time_ + double(end_ - 1) / rate_;
  out.df        = rate_ / double(length_);
  out.segments  = int(pieces_.size());
  out.enbw      = 1.5 * out.df;
  out.simulated = density(pieces_, &Piece::simulated);
  out.measured  = density(pieces_, &Piece::measured);
  const std::deque<Piece> last{pieces_.back()};
  out.latest    = density(last, last.back().measured.empty() ? &Piece::simulated : &Piece::measured);
  out.wave_step = 1 / rate_;
  for (std::int64_t s = end_ - std::min<std::int64_t>(wave_samples, std::int64_t(length_)); s < end_; ++s) {
    const std::size_t index = in_ring(s, length_);
    if (std::isfinite(place.simulated[index]))
      out.wave_simulated.push_back(float(place.simulated[index]));
    if (place.channel >= 0)
      out.wave_measured.push_back(float(place.measured[index]));
  }
  return out;
}

std::optional<PageSpectrum> PlaceSpectrum::take(const LiveBlock &block, const double now)
{
  if (places_.empty() || block.force.size() == 0)
    return {};
  put(block);
  const bool enough = filled_ >= std::int64_t(length_);
  if (!enough || (!pieces_.empty() && double(since_) < pieces_every * rate_) || now - sent_ < shown_at_most)
    return {};
  const double late = double(since_) - pieces_every * rate_;  // blocks end when they end: the next is in time
  since_            = !pieces_.empty() && late < pieces_every * rate_ ? std::int64_t(late) : 0;
  add_piece(places_[chosen_]);
  sent_ = now;
  return text_of(places_[chosen_]);
}
}  // namespace mill::live
