#include "core/base/errors.h"
#include "core/model/case.h"
#include "fem/contact/half_space.h"
#include "fem/contact/hertz.h"
#include "fem/contact/partial_slip.h"
#include "tests/manual/check/units.h"
#include "tests/manual/check/verification.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

// Coulomb contact with stick and slip: the dense solver on half spaces, where the answer is known.
namespace mill::verify {
namespace {
using namespace contact;

Check at_least(const std::string &quantity, const std::string &unit, const double result, const double limit)
{
  return {quantity, unit, result, limit, 0, Judged::at_least};
}

// Tangential compliance of the state against the central difference of the curve itself, both steps from the same
// normal load.
double tangent_over_difference(const FrictionProblem &p, const Loading &normal, const Loading &end, const int mode)
{
  const auto after = [&](const double step) {
    FrictionSolver solver(p);
    solver.advance(normal);
    Loading d = end;
    d.value[mode] *= 1 + step;
    return solver.advance(d);
  };
  const FrictionState here = after(0);
  for (double step = 1e-4;; step /= 10) {
    const FrictionState low = after(-step), high = after(step);
    if (low.status != high.status && step > 1e-7)
      continue;  // across a change of status the curve has a kink
    const double slope = (high.motion[mode] - low.motion[mode]) / (2 * step * end.value[mode]);
    return here.stiffness.inverse()(mode, mode) / slope;
  }
}

// --- Cattaneo: cylinder on a flat, plane strain
// -------------------------------------------------------------------

StripContact cylinder_on_flat(const int n, const double reach, const double radius, const double mu)
{
  return strip_contact(
      half_spaces(steel, steel), [radius](const double x) { return x * x / (2 * radius); }, reach, n, 100 * mm,
      mu);
}

std::vector<Check> cattaneo()
{
  constexpr double mu = 0.3, P = 1000 * N_per_mm;
  constexpr int n    = 401;
  const auto contact = cylinder_on_flat(n, 0.80 * mm, 50 * mm, mu);
  FrictionSolver solver(contact.problem);
  std::vector<Check> checks;
  const Loading normal{Eigen::Vector2d(P, 0), {}};
  double residual = solver.advance(normal).residual, work = std::numeric_limits<double>::infinity();
  struct Row {
    double ratio;
    const char *name;
    double stick, middle, edge;
  };
  for (const Row &r : {Row{0.25, "Q/(mu P) 0.25: ", 0.866025, 34.448, 128.560},
                       Row{0.5, "Q/(mu P) 0.5: ", 0.707107, 75.309, 181.811}}) {
    const Loading loading{Eigen::Vector2d(P, r.ratio * mu * P), {}};
    const FrictionState &s      = solver.advance(loading);
    const Eigen::VectorXd along = s.nodal.tail(n);
    const StickEdge slip        = stick_edge(s, contact.x.cwiseAbs(), along, mu, contact.width);
    const std::string name      = r.name;
    checks.push_back(relative(name + "c/b", "-", slip.stick / (0.742790 * mm), r.stick, 0.02));
    checks.push_back(
        relative(name + "traction in the middle", "MPa", along[n / 2] / contact.width / MPa, r.middle, 0.02));
    checks.push_back(relative(name + "traction at the edge of stick", "MPa", slip.traction / MPa, r.edge, 0.02));
    residual = std::max(residual, s.residual);
    work     = std::min(work, s.dissipated);
  }
  const Loading end{Eigen::Vector2d(P, 0.5 * mu * P), {}};
  checks.push_back(relative("tangent / central difference", "-",
                            tangent_over_difference(contact.problem, normal, end, 1), 1, 1e-6));
  checks.push_back(at_most("complementarity residual", "-", residual, 1e-12));
  checks.push_back(at_least("smallest dissipation of a step", "J/m", work, 0));
  // Without friction there is nothing to carry Q.
  FrictionProblem smooth = contact.problem;
  smooth.mu.setZero();
  bool slides = false;
  try {
    FrictionSolver without(smooth);
    without.advance(end);
  } catch (const SolverError &) {
    slides = true;
  }
  checks.push_back(relative("slides when friction is switched off", "-", slides, 1, 0));
  return checks;
}

// --- Mindlin: sphere on a flat
// --------------------------------------------------------------------------------------

// A quarter x, z > 0 of squares inside `reach`.
RectangleContact sphere_on_flat(const int per_side, const double reach, const double radius, const double mu)
{
  const auto gap = [=](const double x, const double z) {
    const double r = std::hypot(x, z);
    return r <= reach ? r * r / (2 * radius) : std::numeric_limits<double>::infinity();
  };
  return rectangle_contact(half_spaces(steel, steel), gap, {reach, reach, per_side, per_side, true, true, false},
                           mu);
}

std::vector<Check> mindlin()
{
  constexpr double mu = 0.3, P = 1000;
  const auto contact = sphere_on_flat(26, 0.430 * mm, 10 * mm, mu);
  FrictionSolver solver(contact.problem);
  std::vector<Check> checks;
  const Loading normal{Eigen::Vector2d(P / 4, 0), {}};  // a quarter carries a quarter
  const FrictionState pressed = solver.advance(normal);
  double residual = pressed.residual, work = std::numeric_limits<double>::infinity();
  checks.push_back(relative("normal approach", "um", pressed.motion[0] / um, 16.1662, 0.005));
  checks.push_back(
      relative("initial tangential stiffness", "N/mm", 4 * pressed.stiffness(1, 1) / N_per_mm, 76412, 0.01));
  struct Row {
    double ratio;
    const char *name;
    double stick, approach;
  };
  for (const Row &r :
       {Row{0.25, "Q/(mu P) 0.25: ", 0.908560, 1.02776}, Row{0.5, "Q/(mu P) 0.5: ", 0.793701, 2.17921}}) {
    const FrictionState &s = solver.advance({Eigen::Vector2d(P / 4, r.ratio * mu * P / 4), {}});
    const StickEdge slip =
        stick_edge(s, contact.place.rowwise().norm(), along_motion(contact, s), mu, contact.area);
    const std::string name = r.name;
    checks.push_back(relative(name + "c/a", "-", slip.stick / (0.402073 * mm), r.stick, 0.02));
    checks.push_back(relative(name + "tangential approach", "um", s.motion[1] / um, r.approach, 0.01));
    residual = std::max(residual, s.residual);
    work     = std::min(work, s.dissipated);
  }
  const Loading end{Eigen::Vector2d(P / 4, 0.5 * mu * P / 4), {}};
  checks.push_back(relative("tangent / central difference", "-",
                            tangent_over_difference(contact.problem, normal, end, 1), 1, 1e-6));
  checks.push_back(at_most("complementarity residual", "-", residual, 1e-12));
  checks.push_back(at_least("smallest dissipation of a step", "J", work, 0));
  return checks;
}

// --- Sliding wedge
// --------------------------------------------------------------------------------------------------

// Elastic block on a rigid incline, pushed up it.  The block moves as a whole (along x, down, no rotation), its
// face is a half plane; steel on rigid, so that normal and tangential are coupled.
std::vector<Check> wedge()
{
  constexpr int n         = 40;
  constexpr double length = 20 * mm, weight = 1500 * N_per_mm, slope = 0.1;  // tan of the incline
  const double c = 1 / std::hypot(1, slope), s = slope * c;
  const auto bodies = half_spaces(steel, rigid_material());
  const double half = length / (2 * n);
  FrictionProblem p{Eigen::MatrixXd(2 * n, 2 * n),
                    Eigen::MatrixXd::Zero(2 * n, 2),
                    {},
                    Eigen::VectorXd::Zero(n),
                    Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Eigen::Matrix2d k = strip_influence(bodies, half, 2 * half * (i - j), 500 * mm) / (2 * half);
      p.C(i, j)               = k(1, 1);
      p.C(i, n + j)           = k(1, 0);
      p.C(n + i, j)           = k(0, 1);
      p.C(n + i, n + j)       = k(0, 0);
    }
  p.G.col(0).head(n).setConstant(s);  // push along x: closes and slides
  p.G.col(0).tail(n).setConstant(c);
  p.G.col(1).head(n).setConstant(c);  // weight: closes and slides back
  p.G.col(1).tail(n).setConstant(-s);

  std::vector<Check> checks;
  double residual = 0, least_work = std::numeric_limits<double>::infinity();
  struct Row {
    double mu;
    const char *name;
    double limit;
  };
  for (const Row &r : {Row{0, "mu 0", 0.1}, Row{0.1, "mu 0.1", 0.202020}, Row{0.2, "mu 0.2", 0.306122},
                       Row{0.3, "mu 0.3", 0.412371}}) {
    p.mu.setConstant(r.mu);
    FrictionSolver solver(p);
    double push = 0;
    for (int step = 1; step <= 12; ++step) {
      const FrictionState &state = solver.advance({Eigen::Vector2d(step * 0.02 * mm, weight), {1, 0}});
      residual                   = std::max(residual, state.residual);
      least_work                 = std::min(least_work, state.dissipated);
      push                       = state.resultant[0];
    }
    checks.push_back(relative(std::string("F/G at sliding, ") + r.name, "-", push / weight, r.limit, 1e-4));
  }
  checks.push_back(at_most("complementarity residual", "-", residual, 1e-12));
  checks.push_back(at_least("smallest dissipation of a step", "J/m", least_work, 0));
  return checks;
}
}  // namespace

std::vector<Case> friction_cases()
{
  return {
      {"cattaneo-line", "verification",
       "Cylinder R 50 mm on a flat, steel on steel, plane strain, pressed with 1000 N/mm and then pushed sideways "
       "with Q = 0.25 and 0.5 mu P, mu 0.3, in two steps. 401 strips with pressure and shear (802 unknowns) on "
       "the "
       "half plane; semismooth Newton on the status of the strips. c by the zero of the least-squares line "
       "through "
       "(mu p - t)^2 over x^2 where it sticks, the traction at c by the line through t^2 where it slips.",
       "C. Cattaneo (1938); K. L. Johnson, Contact Mechanics (1985), 7.2: c/b = (1 - Q/(mu P))^(1/2)",
       "2 %: at Q = 0.25 mu P the slip zone is 0.13 b, 25 strips wide; its edge is known to half a strip of 186 "
       "on "
       "b, tractions next to the kink to two strips. The tangent is exact for the discrete problem: 1e-6.",
       cattaneo},
      {"mindlin-sphere", "verification",
       "Sphere R 10 mm on a flat, steel on steel, pressed with 1000 N and then pushed sideways with Q = 0.25 and "
       "0.5 "
       "mu P, mu 0.3. Quarter of a grid of squares of 0.0165 mm on the half space, pressure and both shear "
       "components "
       "(about 1600 unknowns); shear along y and transverse slip are included. c/a by the zero of the "
       "least-squares "
       "line through (mu p - t_x)^2 over r^2 where it sticks.",
       "R. D. Mindlin, J. Appl. Mech. 16 (1949) 259; Johnson (1985), 7.2: c/a = (1 - Q/(mu P))^(1/3)",
       "2 % on c/a, 1 % on approach and stiffness: squares of a/24 on the rim, and Mindlin's traction is along "
       "the "
       "load everywhere, while slip across it is not quite zero (of the order nu / (4 - 2 nu) of the slip). The "
       "tangent is exact for the discrete problem: 1e-6.",
       mindlin},
      {"cgs4-wedge", "verification",
       "Elastic block on a rigid incline of tan 0.1, pushed up by an imposed motion under its weight until it "
       "slides. "
       "40 strips with coupled normal and shear compliance (80 unknowns); the weight is an imposed resultant, the "
       "push is the reaction to the motion.",
       "equilibrium of a sliding block, (tan a + mu)/(1 - mu tan a); NAFEMS CGS-4",
       "0.01 %: the limit is a matter of equilibrium and exact for any discretisation; the reference is rounded "
       "to "
       "six digits.",
       wedge},
  };
}
}  // namespace mill::verify
