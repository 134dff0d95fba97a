#include "dynamics/chatter/growth_map.h"
#include "core/base/errors.h"
#include "core/laws/scaled_friction.h"
#include "core/process/parallel.h"
#include "dynamics/chatter/speed.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace mill::dynamics {
namespace {
using bite::MapQuantity;

struct QuantityRow {
  MapQuantity quantity;
  const char *word, *unit;
};

const std::array<QuantityRow, 5> &quantity_rows()
{
  static const std::array<QuantityRow, 5> rows{{{MapQuantity::reduction, "reduction", "1"},
                                                {MapQuantity::friction, "friction", "1"},
                                                {MapQuantity::entry_tension, "entry_tension", "Pa"},
                                                {MapQuantity::exit_tension, "exit_tension", "Pa"},
                                                {MapQuantity::roll_speed, "roll_speed", "m/s"}}};
  return rows;
}

const QuantityRow &row_of(const MapQuantity quantity)
{
  return *std::find_if(quantity_rows().begin(), quantity_rows().end(),
                       [&](const QuantityRow &row) { return row.quantity == quantity; });
}

// Of the bite as it is; NaN: a friction law without a single number.
double present(const bite::RollBite &bite, const MapQuantity quantity)
{
  switch (quantity) {
  case MapQuantity::reduction:
    return 1 - bite.strip.exit_thickness / bite.strip.entry_thickness;
  case MapQuantity::friction:
    return is_a_number(bite.strip.friction) ? plain_coefficient(bite.strip.friction) : 1;
  case MapQuantity::entry_tension:
    return bite.strip.entry_tension;
  case MapQuantity::exit_tension:
    return bite.strip.exit_tension;
  case MapQuantity::roll_speed:
    return bite.roll_speed;
  }
  return not_given;
}

// Friction by a law of several constants goes with a factor.
bite::RollBite changed(bite::RollBite bite, const MapQuantity quantity, const double value)
{
  if (quantity != MapQuantity::friction || is_a_number(bite.strip.friction))
    return bite::with_quantity(std::move(bite), quantity, value);
  bite.strip.friction = scaled(bite.strip.friction, value);
  return bite;
}
}  // namespace

std::string word_of(const MapQuantity quantity)
{
  return row_of(quantity).word;
}

std::string unit_of(const MapQuantity quantity)
{
  return row_of(quantity).unit;
}

MapQuantity map_quantity(const std::string &word)
{
  std::string words;
  for (const QuantityRow &row : quantity_rows()) {
    if (word == row.word)
      return row.quantity;
    words += (words.empty() ? "" : ", ") + std::string(row.word);
  }
  throw InputError("a map over '" + word + "' is not known; quantities of a map are " + words);
}

bite::MapAxis axis_around(const bite::RollBite &bite, const MapQuantity quantity, const Eigen::Index n)
{
  const double value = present(bite, quantity);
  if (!(value > 0) || !std::isfinite(value))
    throw InputError("the bite has no single " + word_of(quantity) +
                     " around which a map could lie; give its range");
  const double high = quantity == MapQuantity::reduction ? std::min(1.5 * value, 0.9) : 1.5 * value;
  return {quantity, Eigen::VectorXd::LinSpaced(n, 0.5 * value, high)};
}

GrowthMap growth_map(const ChatterStandModel &stand, const bite::RollBite &bite, const Linearisation scheme,
                     const bite::MapAxis &rows, const bite::MapAxis &columns, const int threads)
{
  const Eigen::Index n = rows.value.size(), m = columns.value.size();
  if (n == 0 || m == 0)
    throw InputError("a map needs at least one value on each axis");
  if (rows.quantity == columns.quantity)
    throw InputError("a map has two different axes, not " + word_of(rows.quantity) + " twice");
  changed(changed(bite, rows.quantity, rows.value[0]), columns.quantity, columns.value[0]);
  GrowthMap map{rows, columns, Eigen::MatrixXd::Constant(n, m, not_given), {}, {}, {}};
  map.frequency = map.growth;
  map.reason    = Eigen::MatrixXi::Constant(n, m, -1);
  std::vector<std::string> why(std::size_t(n * m));  // empty where there is a bite
  share_tasks(n, threads, [&](const Eigen::Index i) {
    const bite::RollBite row = changed(bite, rows.quantity, rows.value[i]);
    for (Eigen::Index j = 0; j < m; ++j)
      try {
        const bite::RollBite cell       = changed(row, columns.quantity, columns.value[j]);
        const WorkingPoint point        = working_point(cell, cell.roll_speed, scheme);
        const std::complex<double> root = eigenvalues(chatter_matrix(stand, point.by))[0];
        map.growth(i, j)                = root.real();
        map.frequency(i, j)             = std::abs(root.imag()) / (2 * M_PI);
      } catch (const InputError &error) {
        why[std::size_t(i * m + j)] = error.problems.front().message;
      } catch (const SolverError &error) {
        why[std::size_t(i * m + j)] = error.report.what + ": " + error.report.where;
      }
  });
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const std::string &text = why[std::size_t(i * m + j)];
      if (text.empty())
        continue;
      const auto known = std::find(map.reasons.begin(), map.reasons.end(), text);
      map.reason(i, j) = int(known - map.reasons.begin());
      if (known == map.reasons.end())
        map.reasons.push_back(text);
    }
  return map;
}
}  // namespace mill::dynamics
