#include "dynamics/nonlinear/curve_model.h"
#include "core/base/require.h"
#include "core/records/chain_number.h"
#include <algorithm>
#include <cmath>

namespace mill::dynamics {
namespace {
std::vector<double> list_of(const Eigen::VectorXd &v)
{
  return {v.data(), v.data() + v.size()};
}

// +1 where the strain of a row is compression, -1 where it is extension, under a force that parts the work rolls.
double sense_of(const Eigen::VectorXd &row, const std::string &name, const Eigen::VectorXd &pushed_apart)
{
  const double strain = row.dot(pushed_apart);
  return (strain < 0) != (name == word_of(ChainNumber::K4)) ? -1 : 1;
}
}  // namespace

CurveStand curve_stand(const StandModel &stand, const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                       const std::vector<ConnectionCurve> &curves, const double damping, const double highest,
                       const double gap_damper)
{
  require(frequency.size() == shape.cols(), "every shape needs a frequency");
  const Eigen::Index n       = std::upper_bound(frequency.begin(), frequency.end(), highest) - frequency.begin();
  const Eigen::MatrixXd kept = shape.leftCols(n);
  const Eigen::VectorXd push = kept.transpose() * stand.b, rate = 2 * M_PI * frequency.head(n);
  CurveStand made;
  made.rate       = list_of(rate);
  made.push       = list_of(push);
  made.damping    = damping;
  made.gap_damper = gap_damper;
  for (const ConnectionCurve &curve : curves) {
    const auto match = std::find_if(stand.connections.begin(), stand.connections.end(),
                                    [&](const Connection &c) { return c.name == curve.connection; });
    require(match != stand.connections.end() && curve.law.usable(), "a curve needs a spring of the stand");
    const Connection &line     = *match;
    const double whole         = line.stiffness.sum();
    const Eigen::MatrixXd rows = line.rows * kept;
    // One sense for the whole line: its mean strain under a constant bite force.
    const Eigen::VectorXd mean = rows.transpose() * (line.stiffness / whole);
    const Eigen::VectorXd apart =
        rate.unaryExpr([](const double w) { return w > 0 ? 1 / (w * w) : 0; }).cwiseProduct(push);
    const double sense = sense_of(mean, curve.name, apart), rest = curve.law.compression(curve.load);
    for (Eigen::Index r = 0; r < rows.rows(); ++r) {
      CurveSpring spring;
      spring.name      = curve.name;
      spring.law       = made.laws.size();
      spring.share     = line.stiffness[r] / whole;
      spring.row       = list_of(sense * rows.row(r).transpose());
      spring.rest      = rest;
      spring.force     = curve.load;
      spring.stiffness = whole;
      made.springs.push_back(std::move(spring));
    }
    made.laws.push_back(curve.law);
  }
  return made;
}
}  // namespace mill::dynamics
