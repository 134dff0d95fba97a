#pragma once
#include "dynamics/cluster/equilibrium.h"
#include "dynamics/cluster/modes.h"
#include <cmath>

/// The compact cluster mill of tests/reference/cluster.json: work roll W, intermediate I, external E, control
/// rolls L and R on two rollers each.  SI.
struct ZMill {
  double beta  = 0;                     ///< rad, of the control rolls above the horizontal
  double theta = 36 * M_PI / 180;       ///< rad, half angle of their rollers
  double force = 1148e3;                ///< N
  double kap_b = 0;                     ///< m/N^0.9; 0: from k_b
  double kap_r = 0;                     ///< m/N^0.9; 0: from k_r
  double k_b   = 1.0797e10;             ///< N/m at 1148 kN
  double k_r   = 1.9293e8;              ///< N/m at 4.5 kN
  double guide = 5e8;                   ///< N/m, of I along x
  double k_WI = 0, k_IE = 0, k_WC = 0;  ///< N/m, straight laws; 0: power law
  bool isotropic    = false;
  double horizontal = 0;  ///< N, on W
};

inline mill::cluster::Stack stack_of(const ZMill &z)
{
  using namespace mill::cluster;
  constexpr double length = 0.505, density = 7801, preload = 4500, load = 1148e3;
  const double radius[] = {0.0348, 0.069975, 0.225155, 0.0255, 0.0255};
  const char *names[]   = {"W", "I", "E", "L", "R"};
  Stack stack;
  for (int i = 0; i < 5; ++i) {
    Roll roll;
    roll.name    = names[i];
    roll.radius  = radius[i];
    roll.length  = length;
    roll.mass    = density * M_PI * radius[i] * radius[i] * length;
    roll.inertia = 0.5 * roll.mass * radius[i] * radius[i];
    stack.rolls.push_back(roll);
  }
  auto &r         = stack.rolls;
  r[0].centre.y() = radius[0];
  r[1].centre.y() = r[0].centre.y() + radius[0] + radius[1];
  r[2].centre.y() = r[1].centre.y() + radius[1] + radius[2];
  for (std::size_t i = 3; i < 5; ++i)
    r[i].centre = r[0].centre + (radius[0] + radius[i]) *
                                    Eigen::Vector2d((i == 3 ? -1 : 1) * std::cos(z.beta), std::sin(z.beta));
  const auto touch = [&](const int a, const int b, const double straight) {
    Contact c;
    c.name        = r[std::size_t(a)].name + "-" + r[std::size_t(b)].name;
    c.a           = a;
    c.b           = b;
    c.free_length = radius[a] + radius[b];
    c.law         = straight > 0 ? straight_law(straight) : palmgren_law(length, 3.84e-5);
    stack.contacts.push_back(c);
  };
  touch(0, 1, z.k_WI);
  touch(1, 2, z.k_IE);
  touch(0, 3, z.k_WC);
  touch(0, 4, z.k_WC);
  Support bearing;
  bearing.name   = "E";
  bearing.roll   = 2;
  bearing.type   = z.isotropic ? Support::Type::isotropic : Support::Type::radial;
  bearing.law    = z.kap_b > 0 ? BearingLaw{z.kap_b, 0.9} : bearing_through(z.k_b, load, 0.9);
  bearing.across = std::pow(load, 0.1) / (0.9 * bearing.law.kappa);
  stack.supports.push_back(bearing);
  Support guide;
  guide.name = "I";
  guide.roll = 1;
  guide.type = Support::Type::guide;
  guide.law  = {1 / z.guide, 1};
  if (z.guide > 0)
    stack.supports.push_back(guide);
  for (int i = 3; i < 5; ++i) {
    Support rollers;
    rollers.name       = names[i];
    rollers.roll       = i;
    rollers.type       = Support::Type::rollers;
    rollers.law        = z.kap_r > 0 ? BearingLaw{z.kap_r, 0.9} : bearing_through(z.k_r, preload, 0.9);
    rollers.preload    = preload;
    rollers.half_angle = z.theta;
    rollers.direction  = i == 3 ? M_PI - z.beta : z.beta;
    rollers.guard      = 1e4;
    rollers.against    = 0;
    stack.supports.push_back(rollers);
  }
  stack.loads.push_back({0, {0, z.force}});
  if (z.horizontal != 0)
    stack.side_loads.push_back({0, {z.horizontal, 0}});
  return stack;
}

/// Variants of the reference with their fitted supports: N the physical one, C with one constant stiffness of the
/// control contacts and an isotropic bearing.
inline ZMill variant_N(const double force = 1148e3)
{
  ZMill z;
  z.kap_b = 4.1538711672011145e-10;
  z.kap_r = 1.3356128500997114e-08;
  z.force = force;
  return z;
}
inline ZMill variant_C(const double force = 1148e3)
{
  ZMill z;
  z.kap_b     = 4.153871167841248e-10;
  z.kap_r     = 1.3356148071770688e-08;
  z.k_WC      = 16984530939.511961;
  z.isotropic = true;
  z.force     = force;
  return z;
}

inline Eigen::VectorXd frequencies_of(const std::vector<mill::cluster::Mode> &modes)
{
  Eigen::VectorXd f(Eigen::Index(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i)
    f[Eigen::Index(i)] = modes[i].frequency;
  return f;
}
