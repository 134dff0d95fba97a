#include "app/twin/calibrate/levels_text.h"
#include "core/case/fields.h"
#include "core/records/chain_number.h"
#include "twin/calibration/plan.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double g        = 9.80665;        // m/s2
constexpr double factor_2 = 0.69314718056;  // ln: damping, and bandwidth of a force that was not recorded

std::string measured(const MeasuredLevel &level)
{
  return std::isnan(level.rms) ? fmt::format("{:.3g} g peak", level.peak / g)
                               : fmt::format("{:.3g} g", level.rms / g);
}
}  // namespace

std::string levels_text(const PriorChain &chain, const RecordSet &set)
{
  std::vector<Eigen::Index> places;
  for (const MeasuredLevel &level : set.levels) {
    const auto place = std::find(chain.places.begin(), chain.places.end(), level.place);
    if (place == chain.places.end())
      throw InputError(set.folder + "/records.toml: " + "the chain has no place " + level.place +
                       suggestion(level.place, chain.places));
    places.push_back(place - chain.places.begin());
  }
  std::vector<std::string> contacts;
  std::vector<twin::Unknown> unknowns{{twin::ratios_name, factor_2, 0}, {"bandwidth", factor_2, 0}};
  for (const twin::Unknown &spring : chain.springs)
    if (is_roll_contact(spring.name)) {
      contacts.push_back(spring.name);
      unknowns.push_back(spring);
    }
  const double rms  = std::isnan(set.level_force) ? 1000 : set.level_force;
  const auto slopes = white_force_levels(chain.stand, places, rms, set.level_bandwidth, contacts);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(Eigen::Index(unknowns.size()), Eigen::Index(unknowns.size()));
  std::string text  = fmt::format("Levels alone: {} numbers; {}, white force of {:.4g} kN rms up to {:.4g} Hz{}\n",
                                  set.levels.size(), chain.source, rms / 1e3, set.level_bandwidth,
                                 std::isnan(set.level_force) ? " (assumed)" : "");
  text += fmt::format("  {:<18} {:>11} {:>9}   percent per percent of", "level of", "measured", "rms");
  for (const std::string &name : slopes.names)
    text += fmt::format(" {:>9}", name);
  text += "\n";
  for (std::size_t j = 0; j < places.size(); ++j) {
    const auto row = slopes.slope.row(Eigen::Index(j));
    text += fmt::format("  {:<18} {:>11} {:>7.3g} g                        ", set.levels[j].place,
                        measured(set.levels[j]), slopes.rms[Eigen::Index(j)] / g);
    for (Eigen::Index q = 0; q < row.size(); ++q)
      text += fmt::format(" {:>+9.3f}", row[q]);
    text += "\n";
    A += row.transpose() * row / (set.levels[j].error * set.levels[j].error);
  }
  const twin::Identification identified = twin::identification(A, unknowns);
  text += "  singular values in units of the priors:";
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(identified.singular.size(), Eigen::Index(places.size()));
       ++i)
    text += fmt::format(" {:.3g}", identified.singular[i]);
  text += "\n";
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    text += fmt::format("  {:<10} {:.2g} of its prior deviation is left: {}\n", unknowns[i].name,
                        identified.shrink[Eigen::Index(i)],
                        identified.shrink[Eigen::Index(i)] <= 0.5 ? "identified" : "not identified");
  const int numbers = int((identified.singular.array() > std::sqrt(3.0)).count());
  text +=
      fmt::format("refused: these levels determine {} {}, damping x bandwidth of the force (both slopes are near "
                  "-0.5); neither of the two is printed, and no case is written\n",
                  numbers, numbers == 1 ? "number" : "numbers");
  return text +
         "a record of force and accelerations would identify them; --plan shows which sensors, and how long\n";
}
}  // namespace mill
