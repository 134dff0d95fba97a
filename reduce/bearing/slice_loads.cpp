#include "core/base/errors.h"
#include "reduce/bearing/roller_law.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>

// Loads of the slices of one roller at given approaches.  theory.md 5.5
namespace mill::bearing {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SliceLoads power_loads(const RollerLaw &law, const VectorXd &approach, const MatrixXd &directions)
{
  SliceLoads out;
  out.load  = VectorXd::Zero(approach.size());
  out.slope = MatrixXd::Zero(approach.size(), directions.cols());
  for (Index k = 0; k < approach.size(); ++k) {
    const double d = approach[k] - law.drop[k];
    if (d > 0) {
      out.load[k]      = law.lamina_constant * std::pow(d, lamina_exponent);
      out.slope.row(k) = lamina_exponent * out.load[k] / d * directions.row(k);
    }
  }
  return out;
}

/// Mean of a slice and its neighbours, 1/4, 1/2, 1/4; the end slices count themselves in place of the missing one.
VectorXd shared(const VectorXd &v)
{
  const Index n = v.size();
  VectorXd out  = v / 2;
  for (Index k = 0; k < n; ++k)
    out[k] += (v[std::max<Index>(k - 1, 0)] + v[std::min(k + 1, n - 1)]) / 4;
  return out;
}

MatrixXd sharing(const Index n)
{
  MatrixXd F(n, n);
  for (Index k = 0; k < n; ++k)
    F.col(k) = shared(VectorXd::Unit(n, k));
  return F;
}

/// kappa p ln(p_ref/p) in two parts: the slice's own, up to p_c and straight beyond it, and the rest.
struct LocalTerm {
  const RollerLaw &law;

  double whole_slope(double p) const
  {
    return law.kappa * (std::log(law.reference_line_load / p) - 1);
  }
  double whole(double p) const
  {
    return p > 0 ? law.kappa * p * std::log(law.reference_line_load / p) : 0;
  }
  double own_slope(double p) const
  {
    return whole_slope(std::min(p, law.separate_line_load));
  }
  double own(double p) const
  {
    const double bend = law.separate_line_load;
    return p <= bend ? whole(p) : whole(bend) + whole_slope(bend) * (p - bend);
  }
  double rest_slope(double p) const
  {
    const double bend = law.separate_line_load;
    return p <= bend ? 0 : whole_slope(std::min(p, law.shared_line_load)) - whole_slope(bend);
  }
  double rest(double p) const
  {
    const double bend = law.separate_line_load, end = law.shared_line_load;
    if (p <= bend)
      return 0;
    const auto curved = [&](double x) { return whole(x) - own(x); };
    return p <= end ? curved(p) : curved(end) + rest_slope(end) * (p - end);
  }
};

/// Newton on  d = influence q + local(q), q >= 0, with the set of loaded slices.
class LineContact {
public:
  LineContact(const RollerLaw &roller, const VectorXd &approach)
      : law(roller), local{roller}, h(roller.slice_length), d(approach - roller.drop), q(VectorXd::Zero(d.size())),
        returned(std::size_t(d.size()), 0),
        tolerance(1e-13 * std::max(0.0, d.maxCoeff()) + 4e-16 * d.cwiseAbs().maxCoeff())
  {
  }

  SliceLoads solve(const VectorXd &start, const MatrixXd &directions)
  {
    SliceLoads out;
    out.slope = MatrixXd::Zero(d.size(), directions.cols());
    if (d.maxCoeff() > 0) {
      start.size() ? begin_at(start) : begin_cold();
      iterate(out.iterations);
      if (!active.empty() && directions.cols() > 0) {  // a solver of Eigen reads the first of no columns
        const MatrixXd slope = factor().solve(MatrixXd(directions(active, Eigen::all)));
        for (std::size_t i = 0; i < active.size(); ++i)
          out.slope.row(active[i]) = slope.row(Index(i));
      }
    }
    out.load = q;
    return out;
  }

private:
  const RollerLaw &law;
  const LocalTerm local;
  const double h;             // m
  const VectorXd d;           // m, the profile taken off
  VectorXd q;                 // N
  std::vector<Index> active;  // slices with q > 0
  std::vector<int> returned;  // how often a slice has come back into contact
  const double tolerance;     // m

  void collect()
  {
    active.clear();
    for (Index k = 0; k < q.size(); ++k)
      if (q[k] > 0)
        active.push_back(k);
  }

  void begin_at(const VectorXd &start)
  {
    q = start.cwiseMax(0);
    collect();
    if (active.empty())
      begin_cold();
  }

  // The linear problem with the half width of one line load for all; slices in tension leave.
  void begin_cold()
  {
    const double flexibility = law.influence.rowwise().sum().mean() * h;
    double p                 = 1e-3 * law.reference_line_load;
    for (int i = 0; i < 6; ++i)
      p = d.maxCoeff() / (flexibility + law.kappa * std::max(0.0, std::log(law.reference_line_load / p)));
    const double spring = law.kappa / h * std::max(1.0, std::log(law.reference_line_load / p));
    q                   = d.cwiseMax(0);
    collect();
    for (int i = 0; i < 10 && !active.empty(); ++i) {
      MatrixXd A = law.influence(active, active);
      A.diagonal().array() += spring;
      const VectorXd load = A.llt().solve(VectorXd(d(active)));
      q.setZero();
      for (std::size_t a = 0; a < active.size(); ++a)
        q[active[a]] = std::max(0.0, load[Index(a)]);
      collect();
      if (load.minCoeff() > 0)
        break;
    }
  }

  bool reaches_neighbours() const
  {
    return q.maxCoeff() > law.separate_line_load * h;
  }

  VectorXd residual() const
  {
    VectorXd r = d;
    for (const Index k : active)
      r -= law.influence.col(k) * q[k];
    for (const Index k : active)
      r[k] -= local.own(q[k] / h);
    if (reaches_neighbours())
      r -= shared(shared(q / h).unaryExpr([this](double p) { return local.rest(p); }));
    return r;
  }

  Eigen::LLT<MatrixXd> factor() const
  {
    MatrixXd J = law.influence(active, active);
    for (std::size_t a = 0; a < active.size(); ++a)
      J(Index(a), Index(a)) += local.own_slope(q[active[a]] / h) / h;
    if (reaches_neighbours()) {
      const MatrixXd F     = sharing(q.size());
      const VectorXd slope = shared(q / h).unaryExpr([this](double p) { return local.rest_slope(p) / h; });
      J += MatrixXd(F * slope.asDiagonal() * F)(active, active);
    }
    return Eigen::LLT<MatrixXd>(J);
  }

  // Load of a slice that comes into contact, with the others held: r = A q + local(q).
  double entry_load(const Index k, const double r) const
  {
    double p = 1e-3 * law.reference_line_load;
    for (int i = 0; i < 4; ++i)
      p = r / (law.influence(k, k) * h + law.kappa * std::max(1.0, std::log(law.reference_line_load / p)));
    return p * h;
  }

  bool let_in(const VectorXd &r)
  {
    bool any = false;
    for (Index k = 0; k < q.size(); ++k)
      if (!(q[k] > 0) && r[k] > tolerance) {
        q[k] = entry_load(k, r[k]);
        ++returned[std::size_t(k)];
        any = true;
      }
    if (any)
      collect();
    return any;
  }

  // The local term is concave, so a step falls short rather than goes too far, but for slices that leave.
  void step(const VectorXd &r)
  {
    const VectorXd s   = factor().solve(VectorXd(r(active)));
    const double least = 1e-14 * law.reference_line_load * h;
    for (std::size_t a = 0; a < active.size(); ++a) {
      const Index k   = active[a];
      const double to = q[k] + s[Index(a)];
      // A slice that has come back twice is at the edge: it goes out slowly, so that sets do not alternate.
      if (to > 0)
        q[k] = to;
      else
        q[k] = returned[std::size_t(k)] < 2 || q[k] < least ? 0 : 0.1 * q[k];
    }
    collect();
  }

  void iterate(int &iterations)
  {
    double worst = 0;
    for (iterations = 0; iterations < 200; ++iterations) {
      const VectorXd r = residual();
      if (let_in(r))
        continue;
      worst = 0;
      for (const Index k : active)
        worst = std::max(worst, std::abs(r[k]));
      if (worst <= tolerance || (iterations > 30 && worst <= 1e3 * tolerance))
        return;
      step(r);
    }
    std::ostringstream stood;
    stood << active.size() << " of " << d.size() << " slices loaded with " << q.sum() / 1e3
          << " kN, approach wrong by " << worst * 1e6 << " um after 200 steps";
    throw SolverError({"roller: slice loads not found", stood.str(), "an approach or a law that is not a number",
                       "check the dimensions of the bearing", ""});
  }
};
}  // namespace

RollerLaw with_limits(RollerLaw law)
{
  const Index n = law.position.size();
  if (law.lamina_constant > 0)
    return law;
  if (law.influence.rows() != n || law.influence.cols() != n ||
      !(law.slice_length > 0 && law.reference_line_load > 0 && law.kappa > 0))
    throw InputError("roller: a line-contact law needs influence, kappa, slice length and reference line load");
  law.influence      = (law.influence + law.influence.transpose()).eval() / 2;
  const MatrixXd A   = law.influence * law.slice_length;  // as flexibility of a line load
  const double least = Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (!(least > 0))
    throw InputError("roller: the influence of the slices is not positive definite");
  // Slope kappa (ln(p_ref/p) - 1) of the local term: the slice's own part takes at most 0.7 of the least
  // flexibility, the shared part 0.8 of what that leaves, mode by mode.
  const double own_value = -0.7 * least;
  const MatrixXd F       = sharing(n);
  MatrixXd remaining     = A;
  remaining.diagonal().array() += own_value;
  const MatrixXd L = remaining.llt().matrixL();
  const MatrixXd G = L.triangularView<Eigen::Lower>().solve(F);  // least of  x' remaining x / x' F F x
  const double share =
      1 / Eigen::SelfAdjointEigenSolver<MatrixXd>(MatrixXd(G * G.transpose()), Eigen::EigenvaluesOnly)
              .eigenvalues()[n - 1];
  law.separate_line_load = law.reference_line_load * std::exp(-own_value / law.kappa - 1);
  law.shared_line_load   = law.reference_line_load * std::exp((-own_value + 0.8 * share) / law.kappa - 1);
  return law;
}

SliceLoads slice_loads(const RollerLaw &law, const VectorXd &approach, const MatrixXd &directions,
                       const VectorXd &start)
{
  const Index n = law.position.size();
  if (approach.size() != n || directions.rows() != n || law.drop.size() != n ||
      (start.size() && start.size() != n))
    throw InputError("roller: approach, directions and start need one row for each slice");
  if (law.lamina_constant > 0)
    return power_loads(law, approach, directions);
  if (law.separate_line_load > 0)
    return LineContact(law, approach).solve(start, directions);
  return LineContact(with_limits(law), approach).solve(start, directions);
}
}  // namespace mill::bearing
