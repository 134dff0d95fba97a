#include "twin/analysis/owner.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double farthest_owner = 3, apart = 1, least_assurance = 0.7;  // standard deviations, -
constexpr double nearest_without_accuracy = 0.05;  // -, of a frequency whose accuracy the case does not state
constexpr double least_moved              = 0.03;  // of the largest place of a mode

// Shape of a mode of the case at the channels that are places of it; empty with fewer than three.
double assurance(const Seen &seen, const CaseModel &stand, const Eigen::Index mode)
{
  std::vector<std::complex<double>> measured, computed;
  for (std::size_t c = 0; c < seen.channels.size() && Eigen::Index(c) < seen.shape.size(); ++c)
    for (std::size_t p = 0; p < stand.places.size(); ++p)
      if (stand.places[p] == seen.channels[c]) {
        measured.push_back(seen.shape[Eigen::Index(c)]);
        computed.emplace_back(stand.shape(Eigen::Index(p), mode), 0);
      }
  if (measured.size() < 3)
    return std::numeric_limits<double>::quiet_NaN();
  const auto n = Eigen::Index(measured.size());
  return modal_assurance(Eigen::Map<const Eigen::VectorXcd>(measured.data(), n),
                         Eigen::Map<const Eigen::VectorXcd>(computed.data(), n));
}

// -, of a frequency of the case: as its run states it, else by its springs, (42.7); NaN where neither is stated.
double frequency_error_of(const CaseModel &stand, const Eigen::Index mode)
{
  constexpr double takes_part = 0.01;  // share of the strain energy
  if (mode < stand.frequency_error.size() && std::isfinite(stand.frequency_error[mode]))
    return stand.frequency_error[mode];
  double squares = 0;
  for (Eigen::Index j = 0; j < stand.spring_error.size(); ++j)
    if (const double share = stand.strain_share(mode, j);
        share > takes_part || std::isfinite(stand.spring_error[j]))
      squares += share * share * stand.spring_error[j] * stand.spring_error[j];
  return 0.5 * std::sqrt(squares);
}

// Whether a mode moves the places of the channels: of one that hardly does, the sensor shows nothing.
bool moves_the_place(const Seen &seen, const CaseModel &stand, const Eigen::Index mode)
{
  const double largest = stand.shape.rows() > 0 ? stand.shape.col(mode).cwiseAbs().maxCoeff() : 0;
  bool known           = false;
  for (const std::string &channel : seen.channels)
    for (std::size_t p = 0; p < stand.places.size() && Eigen::Index(p) < stand.shape.rows(); ++p)
      if (stand.places[p] == channel) {
        known = true;
        if (std::abs(stand.shape(Eigen::Index(p), mode)) > least_moved * largest)
          return true;
      }
  return !known;
}

std::string described(const CaseModel &stand, const Eigen::Index mode)
{
  Eigen::Index spring = 0, mass = 0;
  const double strain  = stand.strain_share.row(mode).maxCoeff(&spring);
  const double kinetic = stand.kinetic_share.row(mode).maxCoeff(&mass);
  return fmt::format("mode {} of the case ({:.4g} Hz): spring {} {:.0f} %, mass {} {:.0f} %", mode + 1,
                     stand.frequency[mode], stand.springs[std::size_t(spring)], 100 * strain,
                     (stand.bodies.empty() ? stand.places : stand.bodies)[std::size_t(mass)], 100 * kinetic);
}
}  // namespace

Owner owner_among_modes(const Seen &seen, const CaseModel &stand)
{
  struct Candidate {
    Eigen::Index mode;
    double distance;
  };
  std::vector<Candidate> candidates;
  for (Eigen::Index i = 0; i < stand.frequency.size(); ++i) {
    const double of_case  = frequency_error_of(stand, i),
                 away     = std::abs(std::log(seen.frequency / stand.frequency[i]));
    const double distance = std::isfinite(of_case) ? away / std::hypot(seen.deviation, of_case)
                                                   : farthest_owner * away / nearest_without_accuracy;
    const double mac      = assurance(seen, stand, i);
    if (distance < farthest_owner && (std::isnan(mac) || mac > least_assurance) && moves_the_place(seen, stand, i))
      candidates.push_back({i, distance});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const auto &a, const auto &b) { return a.distance < b.distance; });
  if (candidates.empty())
    return {"source not identified: no mode of the case within three standard deviations", -1, 0};
  const auto distance_text = [&](const Candidate &one) {
    return std::isfinite(frequency_error_of(stand, one.mode))
               ? fmt::format(", {:.1f} sd away", one.distance)
               : fmt::format(", {:+.1f} % away; the case does not state its accuracy",
                             100 * (seen.frequency / stand.frequency[one.mode] - 1));
  };
  std::string text = described(stand, candidates[0].mode) + distance_text(candidates[0]);
  if (candidates.size() == 1 || candidates[1].distance - candidates[0].distance > apart)
    return {text, int(candidates[0].mode), candidates[0].distance};
  text = "ambiguous: " + text;
  for (std::size_t i = 1; i < candidates.size(); ++i)
    text += "; or " + described(stand, candidates[i].mode) + distance_text(candidates[i]);
  return {text, -1, candidates[0].distance};
}

namespace {
constexpr double speed_error = 0.002;  // of a frequency that follows the speed or the mains
constexpr int most_orders = 5, most_mains = 20, most_of_bearing = 3, most_harmonics = 10;
constexpr double most_by_chance = 0.01;  // an image that chance makes more often is not reported

void add_orders(std::vector<std::string> &owners, const TurningPeak &peak, const CaseModel &stand,
                const double speed)
{
  for (const TurningRoll &roll : stand.rolls) {
    const double turn = speed / (M_PI * roll.diameter), whole = std::round(peak.frequency / turn);
    if (std::isfinite(turn) && whole >= 1 && whole <= most_orders &&
        std::abs(peak.frequency - whole * turn) <= peak.reach + speed_error * peak.frequency)
      owners.push_back(
          fmt::format("{} turn{} of the {} ({:.3f} Hz each)", whole, whole == 1 ? "" : "s", roll.name, turn));
  }
}

// With the slip that the rule of bearings allows.
void add_bearing_lines(std::vector<std::string> &owners, const TurningPeak &peak, const CaseModel &stand,
                       const double speed)
{
  for (const TurningBearing &bearing : stand.bearings) {
    const double turn                                = speed / (M_PI * bearing.roll_diameter);
    const std::pair<const char *, double> families[] = {
        {"BPFO", bearing.outer}, {"BPFI", bearing.inner}, {"2 BSF", 2 * bearing.roller}};
    for (const auto &[family, order] : families)
      for (int h = 1; h <= most_of_bearing; ++h) {
        const double line = h * order * turn;
        if (std::isfinite(line) && peak.frequency >= 0.985 * line - peak.reach &&
            peak.frequency <= 1.008 * line + peak.reach)
          owners.push_back(
              fmt::format("{} x {} of bearing {} ({:.2f} Hz without slip)", h, family, bearing.name, line));
      }
  }
}

// Harmonics of other lines above half the rate come back mirrored.  Tried are so many lines and harmonics, that
// one of them falls near any frequency by chance: (41.30).
void add_images(std::vector<std::string> &owners, const TurningPeak &peak, const std::vector<double> &lines,
                const double rate)
{
  const double reach = peak.image_reach > 0 ? peak.image_reach : 0.5 * peak.reach;
  double expected    = 0;
  std::vector<std::string> fitting;
  for (const double line : lines)
    for (int h = 2; h <= most_harmonics; ++h) {
      const double above = h * line, times = std::round(above / rate);
      if (above < rate / 2 || std::abs(line - peak.frequency) < 4 * peak.reach)
        continue;
      expected += 2 * (1 + h) * reach / (rate / 2);
      if (std::abs(std::abs(above - times * rate) - peak.frequency) <= (1 + h) * reach)
        fitting.push_back(fmt::format(
            "image of {} x {:.2f} Hz, which lies above half of the {:.0f} samples per second", h, line, rate));
    }
  if (expected < most_by_chance)
    owners.insert(owners.end(), fitting.begin(), fitting.end());
}

void add_mains(std::vector<std::string> &owners, const TurningPeak &peak, const std::optional<double> &mains)
{
  for (const double grid : {50.0, 60.0}) {
    const double order = std::round(peak.frequency / grid);
    if ((mains && std::abs(*mains - grid) > 1) || order < 1 || order > most_mains ||
        std::abs(peak.frequency - grid * order) > peak.reach + speed_error * peak.frequency)
      continue;
    owners.push_back(order == 1 ? fmt::format("mains, {:.0f} Hz", grid)
                                : fmt::format("mains, {} x {:.0f} Hz", order, grid));
  }
}
}  // namespace

std::string turning_owner(const TurningPeak &peak, const CaseModel *stand, const double speed,
                          const std::vector<double> &lines, const double rate, const std::optional<double> mains)
{
  std::vector<std::string> owners;
  if (stand && speed > 0)
    add_orders(owners, peak, *stand, speed);
  if (peak.line) {
    add_mains(owners, peak, mains);
    if (stand && speed > 0)
      add_bearing_lines(owners, peak, *stand, speed);
    add_images(owners, peak, lines, rate);
  }
  if (owners.empty())
    return "";
  std::string text = owners.size() > 1 ? "ambiguous: " + owners[0] : owners[0];
  for (std::size_t i = 1; i < owners.size(); ++i)
    text += "; or " + owners[i];
  return text;
}
}  // namespace mill::twin
