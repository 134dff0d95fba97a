#include "twin/calibration/plan.h"
#include "core/numerics/require.h"
#include "dynamics/response/response_slopes.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double bin = 0.02;  // Hz

/// Response at one frequency and its slopes to the unknowns.
struct AtFrequency {
  Eigen::VectorXcd H;      // (m)
  Eigen::MatrixXcd slope;  // (m, p)
};

/// The stand of the case once, then frequency after frequency.
class CaseResponse {
public:
  CaseResponse(const FittedStand &stand, const std::vector<Unknown> &unknowns,
               const std::vector<Eigen::Index> &places)
      : slopes(dynamics::sloped_stand(stand.chain, stand.damping)),
        seen(Eigen::Index(places.size()), slopes.shape.cols())
  {
    for (std::size_t j = 0; j < places.size(); ++j)
      seen.row(Eigen::Index(j)) = slopes.shape.row(places[j]);
    // only what is asked for: slopes to masses would double the time
    dynamics::SlopedStand kept = slopes;
    kept.names.clear(), kept.stiffness.clear(), kept.mass.clear();
    for (const Unknown &unknown : unknowns) {
      const auto at = std::find(slopes.names.begin(), slopes.names.end(), unknown.name);
      require(at != slopes.names.end() || unknown.name == "zeta", "a plan knows springs and the common damping");
      column.push_back(at == slopes.names.end() ? -1 : Eigen::Index(kept.names.size()));
      if (at == slopes.names.end())
        continue;
      kept.names.push_back(unknown.name);
      kept.stiffness.push_back(slopes.stiffness[std::size_t(at - slopes.names.begin())]);
      kept.mass.emplace_back();
    }
    slopes = std::move(kept);
  }
  AtFrequency operator()(const double f) const
  {
    const auto h = dynamics::response_slopes(slopes, seen, 2 * M_PI * f);
    AtFrequency at{h.value, Eigen::MatrixXcd(seen.rows(), Eigen::Index(column.size()))};
    for (std::size_t p = 0; p < column.size(); ++p)
      if (column[p] < 0)
        at.slope.col(Eigen::Index(p)) = h.dampings.rowwise().sum();
      else
        at.slope.col(Eigen::Index(p)) = h.parameters.col(column[p]);
    return at;
  }

private:
  dynamics::SlopedStand slopes;
  Eigen::MatrixXd seen;
  std::vector<Eigen::Index> column;
};

/// What one bin tells of the unknowns and, last, of the density of the force: tr(S^-1 S_a S^-1 S_b).  (45.4)
Eigen::MatrixXd without_force(const AtFrequency &at, const double SF, const double N)
{
  const Eigen::Index m = at.H.size(), p = at.slope.cols();
  const Eigen::MatrixXcd S       = SF * at.H * at.H.adjoint() + N * Eigen::MatrixXcd::Identity(m, m);
  const Eigen::MatrixXcd inverse = S.inverse();
  std::vector<Eigen::MatrixXcd> changed;
  for (Eigen::Index a = 0; a < p; ++a) {
    const Eigen::MatrixXcd half = SF * at.slope.col(a) * at.H.adjoint();
    changed.push_back(inverse * (half + half.adjoint()));
  }
  changed.push_back(inverse * (SF * at.H * at.H.adjoint()));
  Eigen::MatrixXd A(p + 1, p + 1);
  for (Eigen::Index a = 0; a <= p; ++a)
    for (Eigen::Index b = 0; b <= p; ++b)
      A(a, b) = (changed[std::size_t(a)] * changed[std::size_t(b)]).trace().real();
  return A;
}
}  // namespace

int Told::effective() const
{
  return int((singular.array() > 1).count());
}

Told told(const Eigen::MatrixXd &information, const std::vector<Unknown> &unknowns)
{
  const Eigen::Index p = information.rows();
  Eigen::VectorXd sd(p);
  Told t;
  for (Eigen::Index i = 0; i < p; ++i) {
    sd[i] = unknowns[std::size_t(i)].prior_sd;
    t.names.push_back(unknowns[std::size_t(i)].name);
  }
  const Eigen::MatrixXd scaled = sd.asDiagonal() * information * sd.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  t.singular                 = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().reverse();
  t.direction                = solver.eigenvectors().rowwise().reverse();
  const Eigen::VectorXd kept = (t.singular.cwiseAbs2().array() + 1).inverse().matrix();
  t.covariance = sd.asDiagonal() * t.direction * kept.asDiagonal() * t.direction.transpose() * sd.asDiagonal();
  t.shrink     = t.covariance.diagonal().cwiseSqrt().cwiseQuotient(sd);
  return t;
}

Told planned(const FittedStand &stand, const std::vector<Unknown> &unknowns, const PlannedRecord &record)
{
  const CaseResponse response(stand, unknowns, record.places);
  const auto p      = Eigen::Index(unknowns.size()) + (record.force_recorded ? 0 : 1);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(p, p);
  const double SF = record.force_density * record.force_density, N = record.noise * record.noise,
               to = std::min(record.high, record.force_highest);
  for (double f = record.low + bin / 2; f < to; f += bin) {
    const AtFrequency at = response(f);
    if (record.force_recorded)
      A += 2 * (SF / N) * (at.slope.adjoint() * at.slope).real();
    else
      A += without_force(at, SF, N);
  }
  A *= record.duration * bin;
  std::vector<Unknown> all = unknowns;
  if (!record.force_recorded)
    all.push_back({force_density_name, 3.0, 0});  // e^3: nobody knows it within a factor of 20
  return told(A, all);
}

std::vector<NextSensor> next_sensors(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                                     const PlannedRecord &record)
{
  const Told now = planned(stand, unknowns, record);
  std::vector<NextSensor> sensors;
  for (Eigen::Index place = 0; place < stand.chain.M.size(); ++place) {
    if (std::find(record.places.begin(), record.places.end(), place) != record.places.end())
      continue;
    PlannedRecord more = record;
    more.places.push_back(place);
    NextSensor next{place, planned(stand, unknowns, more), 0};
    // determinants in units of the priors: (1 + s^2) of every direction
    next.gain = 0.5 * ((next.told.singular.cwiseAbs2().array() + 1).log().sum() -
                       (now.singular.cwiseAbs2().array() + 1).log().sum());
    sensors.push_back(std::move(next));
  }
  std::sort(sensors.begin(), sensors.end(),
            [](const NextSensor &a, const NextSensor &b) { return a.gain > b.gain; });
  return sensors;
}

WhiteForceLevels white_force_levels(const FittedStand &stand, const std::vector<Eigen::Index> &places,
                                    const double force_rms, const double bandwidth,
                                    const std::vector<std::string> &springs)
{
  std::vector<Unknown> unknowns{{"zeta"}};
  for (const std::string &name : springs)
    unknowns.push_back({name});
  const CaseResponse response(stand, unknowns, places);
  const double SF = force_rms * force_rms / bandwidth;
  const auto m = Eigen::Index(places.size()), p = Eigen::Index(unknowns.size());
  Eigen::VectorXd square = Eigen::VectorXd::Zero(m);
  Eigen::MatrixXd slope  = Eigen::MatrixXd::Zero(m, p);
  const auto bins        = Eigen::Index(std::ceil(bandwidth / bin - 1e-9));
  const double width     = bandwidth / double(bins);
  for (Eigen::Index b = 0; b < bins; ++b) {
    const AtFrequency at = response((double(b) + 0.5) * width);
    square += SF * width * at.H.cwiseAbs2();
    for (Eigen::Index q = 0; q < p; ++q)
      slope.col(q) += SF * width * (at.H.conjugate().cwiseProduct(at.slope.col(q))).real();
  }
  WhiteForceLevels levels{
      square.cwiseSqrt(), {"zeta", "bandwidth"},
       Eigen::MatrixXd(m, p + 1)
  };
  levels.names.insert(levels.names.end(), springs.begin(), springs.end());
  const Eigen::VectorXd edge = SF * bandwidth * response(bandwidth).H.cwiseAbs2();
  levels.slope.col(0)        = slope.col(0).cwiseQuotient(square);
  levels.slope.col(1)        = 0.5 * (edge.cwiseQuotient(square).array() - 1).matrix();
  for (Eigen::Index q = 1; q < p; ++q)
    levels.slope.col(q + 1) = slope.col(q).cwiseQuotient(square);
  return levels;
}
}  // namespace mill::twin
