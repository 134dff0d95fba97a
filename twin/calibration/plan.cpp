#include "twin/calibration/plan.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
using Complex        = std::complex<double>;
constexpr double bin = 0.02;  // Hz

/// Response at one frequency and its slopes to the unknowns.
struct AtFrequency {
  Eigen::VectorXcd H;      // (m)
  Eigen::MatrixXcd slope;  // (m, p)
};

/// The stand of the case once, then frequency after frequency, at all of its places.
class CaseResponse {
public:
  CaseResponse(const FittedStand &stand, const std::vector<Unknown> &of)
      : unknowns(of), modes(stand_at(stand, of, Eigen::VectorXd::Zero(Eigen::Index(of.size()))))
  {
  }
  AtFrequency operator()(const double f) const  // (43.2), (44.3)
  {
    const double w           = 2 * M_PI * f;
    const Eigen::VectorXcd d = Eigen::VectorXcd::NullaryExpr(modes.frequency.size(), [&](const Eigen::Index i) {
      return Complex((modes.frequency[i] - w) * (modes.frequency[i] + w),
                     2 * modes.damping[i] * modes.frequency[i] * w);
    });
    const Eigen::VectorXcd x = modes.force.cast<Complex>().cwiseQuotient(d);
    AtFrequency here{-w * w * (modes.shape * x),
                     Eigen::MatrixXcd(modes.shape.rows(), Eigen::Index(unknowns.size()))};
    for (std::size_t p = 0; p < unknowns.size(); ++p) {
      auto slope = here.slope.col(Eigen::Index(p));
      if (moves(unknowns[p]) == Moves::gain)
        slope = here.H;
      else if (moves(unknowns[p]) == Moves::delay)
        slope = Complex(0, -w) * here.H;
      else
        slope = w * w * (modes.shape * modes.change(p, x, w).cwiseQuotient(d));
    }
    return here;
  }

private:
  const std::vector<Unknown> &unknowns;
  StandAt modes;
};

AtFrequency at_places(const AtFrequency &all, const std::vector<Eigen::Index> &places)
{
  AtFrequency some{Eigen::VectorXcd(Eigen::Index(places.size())),
                   Eigen::MatrixXcd(Eigen::Index(places.size()), all.slope.cols())};
  for (std::size_t j = 0; j < places.size(); ++j) {
    some.H[Eigen::Index(j)]         = all.H[places[j]];
    some.slope.row(Eigen::Index(j)) = all.slope.row(places[j]);
  }
  return some;
}

/// What one bin tells of the unknowns and, last, of the density of the force: tr(S^-1 S_a S^-1 S_b).  (45.4)
Eigen::MatrixXd without_force(const AtFrequency &places, const double SF, const double N)
{
  const Eigen::Index m = places.H.size(), p = places.slope.cols();
  const Eigen::MatrixXcd S       = SF * places.H * places.H.adjoint() + N * Eigen::MatrixXcd::Identity(m, m);
  const Eigen::MatrixXcd inverse = S.inverse();
  std::vector<Eigen::MatrixXcd> changed;
  for (Eigen::Index a = 0; a < p; ++a) {
    const Eigen::MatrixXcd half = SF * places.slope.col(a) * places.H.adjoint();
    changed.push_back(inverse * (half + half.adjoint()));
  }
  changed.push_back(inverse * (SF * places.H * places.H.adjoint()));
  Eigen::MatrixXd A(p + 1, p + 1);
  for (Eigen::Index a = 0; a <= p; ++a)
    for (Eigen::Index b = 0; b <= p; ++b)
      A(a, b) = (changed[std::size_t(a)] * changed[std::size_t(b)]).trace().real();
  return A;
}
}  // namespace

int Identification::effective() const
{
  return int((singular.array() > 1).count());
}

Identification identification(const Eigen::MatrixXd &information, const std::vector<Unknown> &unknowns)
{
  const Eigen::Index p = information.rows();
  Eigen::VectorXd sd(p);
  Identification t;
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

namespace {
using Places = std::vector<Eigen::Index>;

/// Information of one record for each set of sensors.
std::vector<Eigen::MatrixXd> information_of(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                                            const PlannedRecord &record, const std::vector<Places> &sets)
{
  const CaseResponse response(stand, unknowns);
  const auto p = Eigen::Index(unknowns.size()) + (record.force_recorded ? 0 : 1);
  std::vector<Eigen::MatrixXd> A(sets.size(), Eigen::MatrixXd::Zero(p, p));
  const double SF = record.force_density * record.force_density, N = record.noise * record.noise,
               to = std::min(record.high, record.force_highest);
  for (double f = record.low + bin / 2; f < to; f += bin) {
    const AtFrequency all = response(f);
    for (std::size_t s = 0; s < sets.size(); ++s) {
      const AtFrequency chosen = at_places(all, sets[s]);
      if (record.force_recorded)
        A[s] += 2 * (SF / N) * (chosen.slope.adjoint() * chosen.slope).real();
      else
        A[s] += without_force(chosen, SF, N);
    }
  }
  for (Eigen::MatrixXd &a : A)
    a *= record.duration * bin;
  return A;
}

std::vector<Unknown> with_force(std::vector<Unknown> unknowns, const PlannedRecord &record)
{
  if (!record.force_recorded)
    unknowns.push_back({force_density_name, 3.0, 0});  // e^3: it is not known within a factor of 20
  return unknowns;
}
}  // namespace

Identification planned(const FittedStand &stand, const std::vector<Unknown> &unknowns, const PlannedRecord &record)
{
  return identification(information_of(stand, unknowns, record, {record.places}).front(),
                        with_force(unknowns, record));
}

std::vector<NextSensor> next_sensors(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                                     const PlannedRecord &record)
{
  std::vector<Places> sets{record.places};
  for (Eigen::Index place = 0; place < number_of_places(stand); ++place)
    if (std::find(record.places.begin(), record.places.end(), place) == record.places.end()) {
      sets.push_back(record.places);
      sets.back().push_back(place);
    }
  const auto A             = information_of(stand, unknowns, record, sets);
  const auto all           = with_force(unknowns, record);
  const Identification now = identification(A.front(), all);
  std::vector<NextSensor> sensors;
  for (std::size_t s = 1; s < sets.size(); ++s) {
    NextSensor next{sets[s].back(), identification(A[s], all), 0};
    // determinants in units of the priors: (1 + s^2) of every direction
    next.gain = 0.5 * ((next.identification.singular.cwiseAbs2().array() + 1).log().sum() -
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
  std::vector<Unknown> unknowns{{ratios_name}};
  for (const std::string &name : springs)
    unknowns.push_back({name});
  const CaseResponse response(stand, unknowns);
  const double SF = force_rms * force_rms / bandwidth;
  const auto m = Eigen::Index(places.size()), p = Eigen::Index(unknowns.size());
  Eigen::VectorXd square = Eigen::VectorXd::Zero(m);
  Eigen::MatrixXd slope  = Eigen::MatrixXd::Zero(m, p);
  const auto bins        = Eigen::Index(std::ceil(bandwidth / bin - 1e-9));
  const double width     = bandwidth / double(bins);
  for (Eigen::Index b = 0; b < bins; ++b) {
    const AtFrequency seen = at_places(response((double(b) + 0.5) * width), places);
    square += SF * width * seen.H.cwiseAbs2();
    for (Eigen::Index q = 0; q < p; ++q)
      slope.col(q) += SF * width * (seen.H.conjugate().cwiseProduct(seen.slope.col(q))).real();
  }
  WhiteForceLevels levels{square.cwiseSqrt(), {ratios_name, "bandwidth"}, Eigen::MatrixXd(m, p + 1)};
  levels.names.insert(levels.names.end(), springs.begin(), springs.end());
  const Eigen::VectorXd edge = SF * bandwidth * at_places(response(bandwidth), places).H.cwiseAbs2();
  levels.slope.col(0)        = slope.col(0).cwiseQuotient(square);
  levels.slope.col(1)        = 0.5 * (edge.cwiseQuotient(square).array() - 1).matrix();
  for (Eigen::Index q = 1; q < p; ++q)
    levels.slope.col(q + 1) = slope.col(q).cwiseQuotient(square);
  return levels;
}
}  // namespace mill::twin
