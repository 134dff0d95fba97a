#include "core/model/case.h"
#include "fem/housing/housing_component.h"
#include "reduce/chain/housing_frame.h"
#include "tests/manual/stand/housing_models.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::verify {
namespace {
// ---- housing-identities ---------------------------------------------------------------------------------------

std::vector<Check> identities()
{
  const HousingMeshSize coarse{2, 1.5, 0};
  const MillHousing h = demo_housing();
  const auto body     = meshed(h, coarse);
  const auto s        = fem::housing_statics(h, body);
  double energy       = 0;
  for (const double part : s.energy)
    energy += part;

  const auto same = solved(mirrored(h), coarse);
  fem::HousingComponentOptions static_only;
  static_only.n_modes          = 0;
  const Component c            = fem::housing_component(h, body, static_only);
  const Eigen::Matrix2d K      = c.K;
  const Eigen::Vector2d pads   = K.inverse() * Eigen::Vector2d(1, -1), u(s.u_screw, s.u_seat);
  const double kinetic         = u.dot(c.M * u);
  const double kinetic_by_part = upper_mass(s) * s.u_screw * s.u_screw + lower_mass(s) * s.u_seat * s.u_seat;
  const double tight           = 1e-10;
  return {
      relative("strain energy of the parts over the work of the force", "-", energy / (s.u_screw - s.u_seat), 1,
               tight),
      at_most("force left over at a node, of the force on a pad", "-", s.force_error, tight),
      relative("mirrored housing: seat over screw", "-", same.u_seat / same.u_screw, -1, tight),
      relative("mirrored housing: lower over upper mass", "-", lower_mass(same) / upper_mass(same), 1, tight),
      at_most("mirrored housing: energy exchanged at the feet, of the flexibility", "-",
              std::abs(same.exchanged) / same.u_screw, tight),
      relative("component: screw under the bite force", "-", pads[0] / s.u_screw, 1, tight),
      relative("component: seat under the bite force", "-", pads[1] / s.u_seat, 1, tight),
      relative("component: kinetic energy of the static shape over that of the parts", "-",
               kinetic / kinetic_by_part, 1, tight),
  };
}

// ---- housing-long-posts ---------------------------------------------------------------------------------------

// Two stocky beams a long way apart.
MillHousing long_posts(const double window_height)
{
  MillHousing h;
  h.thickness = h.post_width = 0.2;
  h.window_width             = 0.3;
  h.window_height            = window_height;
  h.upper_beam_height = h.lower_beam_height = 0.8;
  h.fillet_radius                           = 0.05;
  h.foot_height                             = 0.5 * window_height;
  h.screw_pad = h.seat_pad = 0.2;
  return h;
}

std::vector<Check> posts()
{
  const HousingMeshSize size{2, 8, 0};
  const double heights[] = {20, 40, 80};
  std::vector<fem::HousingStatics> s;
  for (const double height : heights)
    s.push_back(solved(long_posts(height), size));
  const MillHousing h    = long_posts(20);
  const double per_metre = 1 / (4 * h.steel.youngs_modulus * h.post_width * h.thickness);  // four posts
  const auto share       = [&](const std::size_t i) {
    return s[i].vertical_mass[fem::upper_post] / s[i].mass[fem::upper_post];
  };
  return {
      relative("stretch per metre of post, 20 to 40 m", "m/N/m", (s[1].u_screw - s[0].u_screw) / 10, per_metre,
               5e-4),
      relative("stretch per metre of post, 40 to 80 m", "m/N/m", (s[2].u_screw - s[1].u_screw) / 20, per_metre,
               1e-4),
      relative("mass that rises over mass of the post, 20 and 40 m extrapolated", "-", 2 * share(1) - share(0),
               1. / 3, 1e-3),
      relative("mass that rises over mass of the post, 40 and 80 m extrapolated", "-", 2 * share(2) - share(1),
               1. / 3, 1e-4),
      reported("the same with the posts' bow, 80 m", "-",
               s[2].reduced_mass[fem::upper_post] / s[2].mass[fem::upper_post], 1. / 3),
  };
}

// ---- housing-beam-on-posts ------------------------------------------------------------------------------------

// A long beam on posts too thin to hold its ends.
std::vector<Check> beam_on_posts()
{
  MillHousing h;
  h.thickness         = 0.2;
  h.post_width        = 0.1;
  h.window_width      = 12;
  h.window_height     = 4;
  h.foot_height       = 2;
  h.upper_beam_height = h.lower_beam_height = 0.4;
  h.fillet_radius                           = 0.01;
  h.screw_pad = h.seat_pad = 0.1;
  const auto s             = solved(h, {2, 2, 0});
  const auto f             = reduce::housing_frame(h);
  const double share       = s.reduced_mass[fem::upper_beam] / s.mass[fem::upper_beam];
  return {
      relative("reduced mass over mass of the beam", "-", share, 17. / 35, 5e-3),
      relative("reduced mass over that of the frame of beams", "-", share,
               f.reduced_mass[reduce::upper_beam] / f.mass[reduce::upper_beam], 2e-3),
      relative("flexibility of the upper half", "m/N", s.u_screw, f.u_screw, 5e-3),
      reported("moment at the end over that of a beam built in", "-", f.fixity, 0),
  };
}

// ---- housing-slender-frame ------------------------------------------------------------------------------------

MillHousing slender(const double share)
{
  MillHousing h;
  h.window_width      = 4;
  h.window_height     = 6;
  h.foot_height       = 2;
  h.thickness         = 0.2 * share;
  h.post_width        = 0.2 * share;
  h.upper_beam_height = 0.3 * share;
  h.lower_beam_height = 0.25 * share;
  h.fillet_radius     = 0.02 * share;
  h.screw_pad = h.seat_pad = 0.2 * share;
  return h;
}

std::vector<Check> slender_frame()
{
  std::vector<Check> checks;
  std::vector<double> away;
  for (const auto &[share, name] :
       {std::pair{1.0, "span 14 beam heights"}, std::pair{0.5, "span 28 beam heights"}}) {
    const MillHousing h = slender(share);
    const auto s        = solved(h, {2, 2, 0});
    const auto f = reduce::housing_frame(h), rigid = reduce::housing_frame(h, {1}),
               axes          = reduce::housing_frame(h, {0});
    const std::string where  = std::string(", ") + name;
    const auto upper_of_beam = [&](const reduce::HousingFrame &frame) {
      return frame.reduced_mass[reduce::upper_post] + frame.reduced_mass[reduce::upper_beam];
    };
    away.push_back(std::abs(s.u_screw - s.u_seat) / (f.u_screw - f.u_seat) - 1);
    checks.push_back(relative("screw" + where, "m/N", s.u_screw, f.u_screw, 1e-2));
    checks.push_back(relative("seat" + where, "m/N", s.u_seat, f.u_seat, 1e-2));
    checks.push_back(relative("M1 part" + where, "kg", upper_mass(s), upper_of_beam(f), 2e-2));
    checks.push_back(at_most("opening with rigid corners over finite elements" + where, "-",
                             (rigid.u_screw - rigid.u_seat) / (s.u_screw - s.u_seat), 1));
    checks.push_back(at_most("finite elements over opening with beams as long as their axes" + where, "-",
                             (s.u_screw - s.u_seat) / (axes.u_screw - axes.u_seat), 1));
  }
  checks.push_back(
      at_most("difference at 28 beam heights over that at 14", "-", std::abs(away[1] / away[0]), 0.6));
  return checks;
}

// ---- housing-mesh-order ---------------------------------------------------------------------------------------

std::vector<Check> mesh_order()
{
  const MillHousing h = demo_housing();
  const auto coarse   = solved(h, {2, 1.5, 0});
  auto middle         = solved(h, {4, 1.5, 0});
  const auto fine     = solved(h, {6, 1.5, 0});
  fem::estimate_error(middle, coarse, 2);
  // With e = c h^p the three solutions fix p: (2^p - 1) / (1 - (2/3)^p) is the ratio of the differences.
  const double ratio = (middle.u_screw - coarse.u_screw) / (fine.u_screw - middle.u_screw);
  double low = 0.5, high = 8;
  for (int i = 0; i < 60; ++i) {
    const double p                                                          = 0.5 * (low + high);
    ((std::pow(2, p) - 1) / (1 - std::pow(2. / 3, p)) < ratio ? low : high) = p;
  }
  const double limit = fine.u_screw + (fine.u_screw - middle.u_screw) / (std::pow(1.5, low) - 1);
  return {
      {"order of the screw's displacement", "-", low, 1.7, 0, Judged::at_least},
      at_most("difference to the extrapolated displacement over the estimate", "-",
              std::abs(middle.u_screw / limit - 1) / middle.error[0], 1),
      at_most("estimated error of the screw's displacement", "-", middle.error[0], 0.005),
      at_most("estimated error of the seat's displacement", "-", middle.error[1], 0.005),
      at_most("estimated error of the M1 part", "-", middle.error[2], 0.01),
      at_most("estimated error of the M6 part", "-", middle.error[3], 0.01),
  };
}

// ---- housing-demo ---------------------------------------------------------------------------------------------

std::vector<Check> demo()
{
  const MillHousing h = demo_housing();
  auto s              = solved(h, {4, 1, 0});
  fem::estimate_error(s, solved(h, {2, 1, 0}), 2);
  const auto axes = reduce::housing_frame(h, {0}), rigid = reduce::housing_frame(h, {1});
  const auto rule = reduce::masses_by_rule(h);
  return {
      at_most("opening of the window over a frame as long as its axes", "-",
              (s.u_screw - s.u_seat) / (axes.u_screw - axes.u_seat), 1),
      {"opening of the window over a frame with rigid corners", "-",
       (s.u_screw - s.u_seat) / (rigid.u_screw - rigid.u_seat), 1, 0, Judged::at_least},
      at_most("estimated error of the largest of the four", "-", *std::max_element(s.error.begin(), s.error.end()),
              0.01),
      reported("upper posts K_LZ, compared with the fitted value", "N/m", 1 / s.flexibility[fem::upper_post],
               6.0e10),
      reported("upper beam K_L, compared with the fitted value", "N/m", 1 / s.flexibility[fem::upper_beam], 7.3e9),
      reported("lower posts K_LZd, compared with the fitted value", "N/m", 1 / s.flexibility[fem::lower_post],
               6.0e10),
      reported("lower beam K_Ld, compared with the fitted value", "N/m", 1 / s.flexibility[fem::lower_beam],
               8.05e9),
      reported("upper housing, K1 without screw-down, compared with the fitted value", "N/m", 1 / s.u_screw,
               1 / (1 / 6.0e10 + 1 / 7.3e9)),
      reported("lower housing, K7 without packing, compared with the fitted value", "N/m", -1 / s.u_seat,
               1 / (1 / 6.0e10 + 1 / 8.05e9)),
      reported("upper posts M_LZ, compared with the fitted value", "kg", s.reduced_mass[fem::upper_post], 5200),
      reported("upper beam M_L, compared with the fitted value", "kg", s.reduced_mass[fem::upper_beam], 2700),
      reported("lower posts M_LZd, compared with the fitted value", "kg", s.reduced_mass[fem::lower_post], 2150),
      reported("lower beam M_Ld, compared with the fitted value", "kg", s.reduced_mass[fem::lower_beam], 1850),
      reported("upper posts, what rises only, compared with a third of a post", "kg",
               s.vertical_mass[fem::upper_post], rule[reduce::upper_post]),
      reported("upper beam, compared with 17/35", "kg", s.reduced_mass[fem::upper_beam], rule[reduce::upper_beam]),
      reported("mass of both housings, without feet and bores", "kg",
               s.mass[0] + s.mass[1] + s.mass[2] + s.mass[3], 4 * (5.6 * 0.65 + 2 * 1.2 * 1.46) * 0.7 * 7700),
  };
}

}  // namespace

std::vector<Case> housing_cases()
{
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const char *problem, const char *source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("housing-identities", "unit",
      "Housing of a 1400 mm stand (assumed dimensions) by quadratic hexahedra, some 3000 unknowns of a quarter, "
      "under a unit bite force: the energy of the parts is the work, a mirrored housing answers alike, "
      "and the component carries the same load.",
      "balance of energy; symmetry; statics of the component",
      "exact relations of the discrete problem; rounding is some 1e-13", identities);
  add("housing-long-posts", "verification",
      "Two stocky beams 20, 40 and 80 m apart: what the posts add per metre, and what of their mass rises with "
      "the screw.",
      "bar in tension: 1/(E A), one third of its mass",
      "the joints turn a little less with longer posts: the stretch per metre errs as 1/H^2; one third is the "
      "limit of long posts, and extrapolation over 1/H leaves terms in 1/H^2",
      posts);
  add("housing-beam-on-posts", "verification",
      "A beam of 30 times its height on posts that hold its ends to 4 %: reduced mass under a load in the middle.",
      "17/35 of a beam on two supports; frame of Timoshenko beams, theory.md 23.4",
      "what the posts still hold takes 0.3 % away and what they stretch adds some; against the frame, corners "
      "of one post's width on a span of 12 m",
      beam_on_posts);
  add("housing-slender-frame", "verification",
      "Closed window frames of slender posts and beams against a frame of Timoshenko beams; half of each corner "
      "rigid, and between the frames without and with rigid corners.",
      "theory.md 23.4",
      "the corners are some per cent of the spans and beam theory does not say how far they bend; the "
      "difference must fall with the slenderness",
      slender_frame);
  add("housing-mesh-order", "verification",
      "The assumed housing on meshes of 2, 4 and 6 elements through posts and beams: observed order, and "
      "whether the error estimated from two of them covers the difference to the extrapolated value.",
      "three meshes against each other",
      "flat sides of the fillets and the jump of pressure at the pads' edges are of second order; 1.7 "
      "leaves room for meshes that are not nested; the factor of safety of the estimate is there to cover that",
      mesh_order);
  add("housing-demo", "verification",
      "Stiffness and reduced mass of the assumed housing compared with the values of the demo stand, which were "
      "fitted "
      "to published totals and are not evidence; frames of beams around it.",
      "frames of beams with and without rigid corners; demo stand",
      "beam theory does not say how far the corners bend: rigid corners and fully bending corners are its limits; "
      "1 % is "
      "what the mesh is to be good for",
      demo);
  add("housing-component", "verification",
      "Craig-Bampton component of the assumed housing on screw and seat: frequencies of the housing on its feet "
      "against the whole finite-element model and against a mesh twice as fine.",
      "the same matrices without reduction, by shift-invert Lanczos; finer mesh",
      "0.1 % is what a component is to keep; 1 % is the mesh of two elements through the posts",
      housing_component_checks);
  add("screwdown-springs", "unit",
      "Oil column, screw, thread and nut, piston and load cell of two sides from their dimensions.",
      "bars and columns by hand; energy of thread and nut by quadrature of the forces that the thread's load "
      "makes",
      "closed forms; rounding", screwdown_checks);
  return cases;
}
}  // namespace mill::verify
