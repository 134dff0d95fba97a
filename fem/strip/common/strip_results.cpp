#include "fem/strip/common/strip_results.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include <cmath>

namespace mill::fem {
void StripCourse::spend(const int n_unknowns, const double limit)
{
  work += n_unknowns;
  if (work > limit)
    throw SolverError({"roll bite by finite elements: no convergence within the work allowed",
                       bite::sentence(work, " unknowns times factorisations"),
                       "a pass at the end of what can be rolled, or a mesh too coarse for it",
                       "a pass nearby; fewer elements, bite.elements_along",
                       levels.empty() ? "" : "the last level that converged: " + levels.back().stage});
}

double entry_strain(const Strip &strip)
{
  return std::isnan(strip.initial_thickness) ? 0 : std::log(strip.initial_thickness / strip.entry_thickness);
}

void size_fields(StripFlow &flow, const int columns, const int rows)
{
  for (Eigen::MatrixXd *field : {&flow.x, &flow.y, &flow.vx, &flow.vy, &flow.pressure, &flow.strain, &flow.rate,
                                 &flow.sxx, &flow.syy, &flow.sxy})
    field->setZero(columns, rows);
}

void find_peak(StripFlow &flow, const int edge)
{
  bite::BiteState &s = flow.state;
  int trough         = edge;
  while (trough >= 2 && s.pressure[trough - 2] < s.pressure[trough])
    trough -= 2;
  if (trough >= 2)
    flow.second_peak = s.pressure.head(trough).maxCoeff();
  s.peak_pressure = std::isnan(flow.second_peak) ? s.pressure.maxCoeff() : flow.second_peak;
}

double radius_of_arc(const bite::BiteState &s)
{
  const Eigen::Index last = s.thickness.size() - 1;
  Eigen::Index thinnest   = 0;
  const double least = s.thickness.minCoeff(&thinnest), reach = s.position[last] - s.position[thinnest];
  return reach * reach / (s.thickness[last] - least);
}

void add_slip_notes(StripFlow &flow, const bool drawn)
{
  using bite::sentence;
  bite::BiteState &s  = flow.state;
  const double on_arc = s.arc_length - s.exit_position;
  if (flow.slip_changes == 0 && !drawn)
    s.notes.push_back({WarningId::bite_slip, "", "the slip between strip and roll does not change its sign",
                       "no neutral point in the arc"});
  if (flow.slip_changes > 1)
    s.notes.push_back({WarningId::bite_slip, "",
                       sentence("the slip changes its sign ", flow.slip_changes, " times along the arc"),
                       "the neutral position is the middle of the zone"});
  if (s.sticking_length > 0.1 * on_arc)
    s.remarks.push_back(sentence("the friction stress is at its limit, or slip zero, over ",
                                 s.sticking_length * 1e3, " mm of an arc of ", on_arc * 1e3, " mm"));
}
}  // namespace mill::fem
