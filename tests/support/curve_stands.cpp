#include "tests/support/curve_stands.h"
#include <Eigen/Eigenvalues>
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

SpringLaw power_law(const double c, const double power, const double low, const double high, const int n)
{
  std::vector<double> load, compression;
  for (int i = 0; i < n; ++i) {
    load.push_back(low * std::pow(high / low, i / double(n - 1)));
    compression.push_back(std::pow(load.back() / c, 1 / power));
  }
  return SpringLaw(load, compression);
}

namespace {
struct Modes {
  Eigen::VectorXd frequency;
  Eigen::MatrixXd shape;
};

Modes modes_of(const StandModel &stand)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness_of(stand), stand.M);
  return {solver.eigenvalues().cwiseMax(0).cwiseSqrt() / (2 * M_PI), solver.eigenvectors()};
}

// Line contact of steel rolls: approach = F (a - b ln F), the form of theory.md (3.6).
SpringLaw line_contact()
{
  std::vector<double> load, approach;
  for (int i = 0; i < 15; ++i) {
    load.push_back(5e4 * std::pow(60.0, i / 14.0));
    approach.push_back(load.back() * (5.3e-11 - 1.9e-12 * std::log(load.back())));
  }
  return SpringLaw(load, approach);
}
}  // namespace

CurveStand two_masses(const double upper, const double lower, const SpringLaw &contact, const double load)
{
  const double k = contact.at(contact.compression(load)).stiffness;
  StandModel stand;
  stand.M            = Eigen::Vector2d(upper, lower).asDiagonal();
  stand.K_parts      = Eigen::MatrixXd::Zero(2, 2);
  stand.connections  = {{"K3", Eigen::RowVector2d(1, -1), Eigen::VectorXd::Constant(1, k)}};
  stand.b            = Eigen::Vector2d(-1, 1);  // presses them together, as a bite presses the contacts of a stand
  Modes modes        = modes_of(stand);
  modes.frequency[0] = 0;
  return curve_stand(stand, modes.frequency, modes.shape, {{"K3", "K3", contact, load}}, 0, 1e9, 0);
}

ChainOnCurves chain_on_curves(const double load, const double damping, const double gap_damper)
{
  const double masses[]   = {9300, 59700, 5900, 7100, 42200, 4660};  // kg
  const SpringLaw bearing = power_law(3.1e15, 1.11, 5e4, 3e6, 12);
  std::vector<ConnectionCurve> curves;
  const auto follow = [&](const char *name, const SpringLaw &law) { curves.push_back({name, name, law, load}); };
  follow("K2", bearing.in_series_with(5e-11));
  follow("K3", line_contact());
  follow("K5", line_contact());
  follow("K6", bearing.in_series_with(2e-11));
  const auto slope = [&](const std::size_t i) {
    return curves[i].law.at(curves[i].law.compression(load)).stiffness;
  };
  ChainOnCurves made;
  StandModel &s  = made.model;
  s.M            = Eigen::Map<const Eigen::VectorXd>(masses, 6).asDiagonal();
  s.K_parts      = Eigen::MatrixXd::Zero(6, 6);
  s.b            = Eigen::VectorXd::Unit(6, 2) - Eigen::VectorXd::Unit(6, 3);
  const auto add = [&](const char *name, const int from, const int to, const double k) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(6);
    if (from >= 0)
      row[from] = 1;
    if (to >= 0)
      row[to] = -1;
    s.connections.push_back({name, row, Eigen::VectorXd::Constant(1, k)});
  };
  add("K1", 0, -1, 6.3e9);
  add("K2", 1, 0, slope(0));
  add("K3", 1, 2, slope(1));
  add("K5", 3, 4, slope(2));
  add("K6", 5, 4, slope(3));
  add("K7", 5, -1, 6.9e9);
  const char *labels[] = {"upper frame",     "upper backup roll", "upper work roll",
                          "lower work roll", "lower backup roll", "lower frame"};
  for (int i = 0; i < 6; ++i)
    s.points.push_back({labels[i], Eigen::VectorXd::Unit(6, i)});
  s.load_cell       = -6.9e9 * Eigen::VectorXd::Unit(6, 5);
  const Modes modes = modes_of(s);
  made.modal        = modal_model(s, modes.frequency, modes.shape, damping, 1e9, gap_damper);
  made.stand        = curve_stand(s, modes.frequency, modes.shape, curves, damping, 1e9, gap_damper);
  return made;
}
