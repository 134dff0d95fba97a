#include "app/export/static_rest.h"
#include "core/records/stand_model.h"
#include "reduce/stand/stand_comparison.h"
#include "reduce/stand/stand_modes.h"
#include <cmath>
#include <complex>
#include <stdexcept>

namespace mill {
namespace {
using Complex = std::complex<double>;

constexpr double exact = 1e-8;  // -, of the static compliance of the gap: rounding of a stiff stand

// m/N, of the gap at a frequency in Hz.
Complex gap_receptance(const Eigen::VectorXd &frequency, const Eigen::VectorXd &force, const double damping,
                       const double hertz)
{
  Complex sum = 0;
  for (Eigen::Index k = 0; k < frequency.size(); ++k) {
    const double f = frequency[k];
    sum += force[k] * force[k] / (4 * M_PI * M_PI * Complex(f * f - hertz * hertz, 2 * damping * f * hertz));
  }
  return sum;
}

// The rest u = K^-1 b - sum of the kept modes: orthogonal to them, so that it is a mode of its own.  (35.11)
void append_rest(dynamics::ModalModel &modes, const StandModel &stand, const Eigen::MatrixXd &kept)
{
  const Eigen::VectorXd rad   = 2 * M_PI * modes.frequency;
  const Eigen::VectorXd whole = reduce::static_displacement(stand);
  const Eigen::VectorXd rest  = whole - kept * modes.force.cwiseQuotient(rad.cwiseAbs2());
  const double mass           = rest.dot(stand.M * rest);
  if (!(stand.b.dot(rest) > exact * stand.b.dot(whole)))
    return;  // no mode is left out that the force moves
  const Eigen::VectorXd shape = rest / std::sqrt(mass);
  const double stiffness      = shape.dot(stiffness_of(stand) * shape);
  const Eigen::Index n        = modes.frequency.size();
  modes.frequency.conservativeResize(n + 1);
  modes.force.conservativeResize(n + 1);
  modes.load_cell.conservativeResize(n + 1);
  modes.point.conservativeResize(Eigen::NoChange, n + 1);
  modes.frequency[n] = std::sqrt(stiffness) / (2 * M_PI);
  modes.force[n]     = shape.dot(stand.b);
  modes.load_cell[n] = shape.dot(stand.load_cell);
  for (std::size_t p = 0; p < stand.points.size(); ++p)
    modes.point(Eigen::Index(p), n) = stand.points[p].row.dot(shape);
}
}  // namespace

void add_static_rest(DrivenStand &stand)
{
  if (!stand.modes || !stand.detailed || stand.curves)
    return;
  const StandModel &whole     = stand.detailed->model;
  dynamics::ModalModel &modes = *stand.modes;
  StaticRest rest;
  rest.kept               = modes.frequency.size();
  rest.limit              = stand.dynamics.frequency_limit;
  rest.fastest            = modes.frequency[rest.kept - 1];
  const double compliance = whole.b.dot(reduce::static_displacement(whole));
  const auto of_gap       = [&] { return gap_receptance(modes.frequency, modes.force, 0, 0).real(); };
  rest.missing            = 1 - of_gap() / compliance;
  append_rest(modes, whole, stand.detailed->modes.shape.leftCols(rest.kept));
  if (std::abs(of_gap() / compliance - 1) > exact)
    throw std::logic_error("the static rest of the modes does not complete the compliance of the gap");
  const auto all              = reduce::stand_modes(whole);
  rest.all                    = all.frequency.size();
  const Eigen::VectorXd force = all.shape.transpose() * whole.b;
  constexpr int points        = 200;
  double largest              = 0;
  for (int i = 0; i <= points; ++i) {  // (35.12)
    const double hertz           = rest.limit * i / points;
    const Complex exact_response = gap_receptance(all.frequency, force, modes.damping, hertz);
    rest.error                   = std::fmax(
                          rest.error, std::abs(gap_receptance(modes.frequency, modes.force, modes.damping, hertz) - exact_response));
    largest = std::fmax(largest, std::abs(exact_response));
  }
  rest.error /= largest;
  stand.rest = rest;
}
}  // namespace mill
