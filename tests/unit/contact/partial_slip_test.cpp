#include "core/base/errors.h"
#include "fem/contact/hertz.h"
#include "fem/contact/partial_slip.h"
#include "tests/support/near.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace mill;
using namespace mill::contact;

namespace {
const Material steel{210e9, 0.3, 7850}, bronze{110e9, 0.34, 8800};
constexpr double mu = 0.3, P = 1000;

struct Driven {
  FrictionState pressed, pushed;
};
Driven loading(const RectangleContact &contact, const double Q, const int steps = 1)
{
  FrictionSolver solver(contact.problem);
  Driven out;
  out.pressed = solver.advance({Eigen::Vector2d(P, 0) * contact.share, {}});
  for (int i = 1; i <= steps; ++i)
    out.pushed = solver.advance({Eigen::Vector2d(P, Q * i / steps) * contact.share, {}});
  return out;
}
std::function<double(double, double)> ellipse(const double R_x, const double R_z)
{
  return [=](const double x, const double z) { return x * x / (2 * R_x) + z * z / (2 * R_z); };
}
}  // namespace

TEST(EllipticSlip, OfACircleIsMindlins)
{
  const auto bodies = half_spaces(steel, bronze);
  const auto circle = hertz_point(P, 0.01, 0.01, contact_modulus(bodies));
  const auto sphere = mindlin_sphere(circle, bodies, mu, 0.5);
  for (const bool along_y : {false, true}) {
    const auto e         = mindlin_ellipse(circle, bodies, mu, 0.5, along_y);
    const Tolerance same = within(1e-12, "two forms of one formula");
    EXPECT_TRUE(near(e.stick_x, sphere.stick, same));
    EXPECT_TRUE(near(e.tangential, sphere.tangential, same));
    EXPECT_TRUE(near(e.stiffness, sphere.stiffness, same));
  }
  EXPECT_THROW(mindlin_ellipse(circle, bodies, mu, 1.1, false), InputError);
}

// Full stick has no direction of slip to approximate: (33.8) is exact for equal materials.
TEST(EllipticSlip, StiffnessBeforeSlipIsThatOfTheHalfSpace)
{
  const auto bodies  = half_spaces(steel, steel);
  const auto contact = hertz_point(P, 0.01, 0.04, contact_modulus(bodies));
  for (const bool along : {false, true}) {
    const RectangleGrid grid{1.05 * contact.semi_x, 1.05 * contact.semi_y, 14, 14, true, true, along};
    const auto rectangles = rectangle_contact(bodies, ellipse(0.01, 0.04), grid, mu);
    const auto s          = loading(rectangles, 150);
    const double stiff    = 4 * s.pressed.stiffness(1, 1);
    const auto closed     = mindlin_ellipse(contact, bodies, mu, 0.5, along);
    EXPECT_TRUE(near(stiff, closed.stiffness, within(0.015, "13 rectangles on each semi-axis, singular rim")));
    EXPECT_TRUE(near(s.pushed.motion[1], closed.tangential,
                     within(0.03, "slip turns aside from the load, by Poisson's ratio")));
  }
}

TEST(RectangleContact, MirrorsAreTheWholeContact)
{
  const double a = hertz_point(P, 0.01, 0.02, contact_modulus(half_spaces(steel, steel))).semi_y;
  for (const bool along : {false, true})
    for (const Material &other : {steel, bronze}) {
      const auto bodies  = half_spaces(steel, other);
      const bool coupled = bodies.coupling != 0;
      RectangleGrid whole{1.3 * a, 1.3 * a, 10, 10, false, false, along};
      RectangleGrid part   = whole;
      part.mirror_x        = !coupled || along;
      part.mirror_z        = !coupled || !along;
      part.n_x             = part.mirror_x ? 5 : 10;
      part.n_z             = part.mirror_z ? 5 : 10;
      const auto all       = loading(rectangle_contact(bodies, ellipse(0.01, 0.02), whole, mu), 120, 2);
      const auto kept      = loading(rectangle_contact(bodies, ellipse(0.01, 0.02), part, mu), 120, 2);
      const Tolerance same = within(1e-8, "the same equations in fewer unknowns, directions of slip iterated");
      EXPECT_TRUE(near(kept.pushed.motion[0], all.pushed.motion[0], same)) << along << coupled;
      EXPECT_TRUE(near(kept.pushed.motion[1], all.pushed.motion[1], same)) << along << coupled;
      EXPECT_LE(kept.pushed.residual, 1e-9);
    }
}

TEST(StickEdge, IsReadFromTheTractionsOfCattaneo)
{
  // Nodes of the exact solution: b = 1, c = 0.6, pressure and shear as Cattaneo has them.
  constexpr int n = 101;
  const double c = 0.6, area = 2.2 / n;
  FrictionState s;
  s.nodal = Eigen::VectorXd::Zero(2 * n);
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i) {
    x[i]              = (i - 50) * area;
    const double p    = std::sqrt(std::max(0., 1 - x[i] * x[i])),
                 held = std::abs(x[i]) < c ? c * std::sqrt(1 - x[i] * x[i] / (c * c)) : 0;
    s.nodal[i]        = p * area;
    s.nodal[n + i]    = mu * (p - held) * area;
    s.status.push_back(p == 0 ? Status::open : std::abs(x[i]) < c ? Status::stick : Status::slip);
  }
  const auto edge = stick_edge(s, x.cwiseAbs(), s.nodal.tail(n), mu, area);
  EXPECT_TRUE(near(edge.stick, c, within(1e-10, "squares on a straight line")));
  EXPECT_TRUE(near(edge.traction, mu * 0.8, within(1e-10, "squares on a straight line")));
  std::replace(s.status.begin(), s.status.end(), Status::stick, Status::slip);
  EXPECT_EQ(stick_edge(s, x.cwiseAbs(), s.nodal.tail(n), mu, area).stick, 0);
}
