#include "core/laws/flow_stress_law.h"
#include "fem/strip/elastic_plastic/strip_elastic.h"
#include "reduce/bite/arc/half_plane.h"
#include "tests/manual/bite/bite_passes.h"
#include "tests/manual/bite/free_arc_slab.h"
#include "tests/manual/check/verification.h"
#include <algorithm>
#include <cmath>
#include <map>

// The rolled strip by finite elements, elastic-plastic: thin hard strip, light passes, what stays in the strip.
namespace mill::verify {
namespace {
// A slab with elastic ends on a given arc, by small steps: the comparison of this family, written for it alone.
struct SlabOnArc {
  double force    = 0;  ///< N/m
  double exit     = 0;  ///< m, end of the contact, positive along the strip
  double peak     = 0;  ///< Pa
  double exit_gap = 0;  ///< m, thickness there
};

// @param thickness  of the gap over the abscissa along the strip, from where it is met to where it is left
// @param coupled    friction acts in the elastic ends too and changes the stress along the strip there
SlabOnArc slab_on_arc(const bite::RollBite &b, const std::function<double(double)> &thickness, const double from,
                      const double to, const bool coupled)
{
  const Strip &s    = b.strip;
  const int n       = 40000;
  const double step = (to - from) / (n - 1), mu = s.friction.coefficient, nu = s.poisson_ratio;
  const double stiff = s.youngs_modulus / (1 - nu * nu), across = nu / (1 - nu), h1 = s.entry_thickness;
  std::vector<double> h(n), slope(n);
  for (int i = 0; i < n; ++i)
    h[i] = thickness(from + i * step);
  for (int i = 1; i + 1 < n; ++i)
    slope[i] = (h[i + 1] - h[i - 1]) / (2 * step);
  slope[0]     = slope[1];
  slope[n - 1] = slope[n - 2];
  const auto k = [&](const double thick) {
    return bite::flow_stress(s.flow_stress, std::log(h1 / std::min(thick, h1)));
  };
  const double none = 1e300;
  // Upstream from the end of the contact; the strip yields where the roll has loaded it enough, or never.
  const auto from_exit = [&](const int end, std::vector<double> &p_at) {
    p_at.assign(n, none);
    double p = 0, along = s.exit_tension;
    bool yields = false;
    for (int i = end; i > 0; --i) {
      double d = ((along + p) * slope[i] - 2 * mu * p) / h[i] * step;
      if (!yields) {
        d = coupled ? d : 0;
        p -= stiff * (h[i - 1] - h[i]) / h[i] + across * d;
        along += d;
        yields = along + p >= k(s.exit_thickness);
        if (p < 0 && i < end - 50)
          return false;
      } else {
        along += d;
        p = k(h[i - 1]) - along;
      }
      p_at[i - 1] = p;
      if (h[i - 1] >= h1)
        break;
    }
    return yields;
  };
  int low = int(std::min_element(h.begin(), h.end()) - h.begin()), high = n - 2;
  std::vector<double> exit_side, entry_side(n, none);
  while (high - low > 1) {
    const int middle                            = (low + high) / 2;
    (from_exit(middle, exit_side) ? high : low) = middle;
  }
  from_exit(high, exit_side);
  int first = 0;
  while (first + 1 < n && h[first] > h1)
    ++first;
  double p = 0, along = s.entry_tension;
  bool yields = false;
  for (int i = first; i + 1 < n && p < 100 * k(h1) + 1e9; ++i) {
    double d = -((along + p) * slope[i] + 2 * mu * p) / h[i] * step;
    if (!yields) {
      d = coupled ? d : 0;
      p -= stiff * (h[i + 1] - h[i]) / h[i] + across * d;
      along += d;
      yields = along + p >= k(h1);
    } else {
      along += d;
      p = k(h[i + 1]) - along;
    }
    entry_side[i + 1] = p;
  }
  SlabOnArc out;
  for (int i = first + 1; i < high; ++i) {
    const double q = std::min(exit_side[i], entry_side[i]);
    if (q < none) {
      out.force += q * step;
      out.peak = std::max(out.peak, q);
    }
  }
  out.exit     = from + high * step;
  out.exit_gap = h[high];
  return out;
}

SlabOnArc slab_on_circle(const bite::RollBite &b, const bool coupled)
{
  const double R = b.roll_radius, L = std::sqrt(R * (b.strip.entry_thickness - b.strip.exit_thickness));
  return slab_on_arc(
      b, [&](const double x) { return b.strip.exit_thickness + 2 * (R - std::sqrt(R * R - x * x)); }, -1.1 * L,
      0.7 * L, coupled);
}

// The arc a finite-element state has found, continued by its last three points at both ends.
SlabOnArc slab_on_its_arc(const bite::RollBite &b, const fem::StripElastic &state, const bool coupled)
{
  const Eigen::VectorXd x = -state.flow.state.position.reverse(), h = 2 * state.flow.roll_surface.reverse();
  const int last = int(x.size()) - 1;
  const auto gap = [&](const double position) {
    int i      = int(std::upper_bound(x.data(), x.data() + x.size(), position) - x.data()) - 1;
    i          = std::clamp(i, 0, last - 2);
    double sum = 0;
    for (int a = 0; a < 3; ++a) {
      double l = h[i + a];
      for (int m = 0; m < 3; ++m)
        if (m != a)
          l *= (position - x[i + m]) / (x[i + a] - x[i + m]);
      sum += l;
    }
    return sum;
  };
  const double length = x[last] - x[0];
  return slab_on_arc(b, gap, x[0] - 0.05 * length, x[last] + 0.05 * length, coupled);
}

// Passes solved once.
const fem::StripElastic &elastic_strip(const std::string &name, const bite::RollBite &b, const bite::Arc arc,
                                       const int along, const int through)
{
  static std::map<std::string, fem::StripElastic> states;
  const std::string key = name + "/" + std::to_string(int(arc)) + "/" + std::to_string(along);
  const auto match      = states.find(key);
  if (match != states.end())
    return match->second;
  fem::StripElasticModel model;
  model.arc              = arc;
  model.elements_along   = along;
  model.elements_through = through;
  return states.emplace(key, fem::solve_elastic_strip(b, model)).first->second;
}
const fem::StripElastic &elastic_strip(const std::string &name, const bite::Arc arc, const int along = 24,
                                       const int through = 4)
{
  return elastic_strip(name, reference_pass(name), arc, along, through);
}

// A pass between rolls that take next to nothing off: 1.5 % of thin strip under tension.
bite::RollBite light_pass()
{
  bite::RollBite b             = reference_pass("B5");
  b.strip.entry_thickness      = 0.4e-3;
  b.strip.exit_thickness       = 0.394e-3;
  b.strip.entry_tension        = 100e6;
  b.strip.exit_tension         = 100e6;
  b.strip.friction.coefficient = 0.08;
  return b;
}

double per_width(const bite::RollBite &b, const fem::StripElastic &state)
{
  return state.flow.state.force / b.strip.width;
}

std::vector<Check> stiff_strip()
{
  const bite::RollBite b = reference_pass("B1");
  fem::StripElasticModel model;
  model.elements_along          = 24;
  model.elements_through        = 4;
  model.finest                  = 0.25;
  model.derivatives             = false;
  const fem::StripElastic soft  = fem::solve_elastic_strip(b, model);
  model.stiffness               = 10;
  const fem::StripElastic stiff = fem::solve_elastic_strip(b, model);
  const double length           = soft.flow.state.arc_length - soft.flow.state.exit_position;
  return {relative("force per width, against ten times the elastic moduli", "N/mm", per_width(b, soft) / 1e3,
                   per_width(b, stiff) / 1e3, 0.005),
          relative("force per width, against the limit of the rigid-plastic strip", "N/mm",
                   per_width(b, soft) / 1e3, 923.3, 0.01),
          at_most("contact without yielding over the whole contact", "-",
                  (soft.elastic_entry + soft.elastic_exit) / length, 0.02),
          at_most("elastic energy carried off over the power", "-", std::abs(soft.elastic_power), 1e-4)};
}

std::vector<Check> rigid_roll()
{
  std::vector<Check> checks;
  for (const char *name : {"B5", "B6"}) {
    const bite::RollBite b         = reference_pass(name);
    const bool thin                = std::string(name) == "B6";
    const fem::StripElastic &state = elastic_strip(name, bite::Arc::rigid, thin ? 24 : 16, thin ? 4 : 3);
    const SlabOnArc with = slab_on_circle(b, true), without = slab_on_circle(b, false);
    const std::string n = std::string(name) + ": ";
    checks.push_back(relative(n + "force per width against the slab with friction in its elastic ends", "N/mm",
                              per_width(b, state) / 1e3, with.force / 1e3, 0.01));
    checks.push_back(reported(n + "against elastic ends without friction", "N/mm", per_width(b, state) / 1e3,
                              without.force / 1e3));
    checks.push_back(reported(n + "contact behind the line of centres", "mm",
                              -state.flow.state.exit_position * 1e3, with.exit * 1e3));
    checks.push_back(absolute(n + "thickness of the strip far behind the bite", "um",
                              state.flow.exit_thickness * 1e6, with.exit_gap * 1e6, 0.2e-3 * with.exit_gap * 1e6));
  }
  return checks;
}

std::vector<Check> elastic_roll()
{
  std::vector<Check> checks;
  const std::map<std::string, std::array<double, 2>> published{{"B5", {7568.72, 11.453}},
                                                               {"B6", {7971.13, 6.675}}};
  for (const auto &[name, slab] : published) {
    const bite::RollBite b         = reference_pass(name);
    const fem::StripElastic &state = elastic_strip(name, bite::Arc::elastic);
    const SlabOnArc with = slab_on_its_arc(b, state, true), without = slab_on_its_arc(b, state, false);
    const std::string n = name + ": ";
    const double F      = per_width(b, state) / 1e3;
    checks.push_back(
        relative(n + "force per width against the slab on the same arc", "N/mm", F, with.force / 1e3, 0.02));
    const FreeArcSlab third = slab_on_free_arc(b, 800, true), plain = slab_on_free_arc(b, 800, false);
    checks.push_back(relative(n + "against the slab with friction in its ends, with its own arc, by relaxation",
                              "N/mm", F, third.force / 1e3, 0.03));
    checks.push_back(relative(n + "that relaxation without friction in the ends against the reference", "N/mm",
                              plain.force / 1e3, slab[0], 0.003));
    const Check without_friction = relative(
        n + "against the slab whose elastic ends know no friction, with its own arc", "N/mm", F, slab[0], 0.05);
    checks.push_back(
        name == "B5"
            ? without_friction
            : known_deviation(without_friction, {9552.75, 10,
                                                 "the reference keeps the stress along the strip constant in its "
                                                 "elastic ends; with the friction there the same slab, on its "
                                                 "own arc and by a program of its own, gives 9731 N/mm",
                                                 "friction in the elastic ends, (19.16), in the reference"}));
    checks.push_back(reported(n + "the same ends on the arc found here", "N/mm", F, without.force / 1e3));
    checks.push_back(relative(n + "end of the contact behind the line of centres, against that relaxation", "mm",
                              -state.flow.state.exit_position * 1e3, third.exit * 1e3, 0.1));
    checks.push_back(relative(n + "entry", "mm", state.flow.entry_position * 1e3, slab[1], 0.05));
    checks.push_back(
        {n + "lines of the mesh end the contact", "-", double(state.ends_fitted), 1, 0, Judged::at_least});
    const Eigen::VectorXd &p = state.flow.state.pressure;
    checks.push_back(at_most(n + "pressure next to the exit over the peak", "-", p[0] / p.maxCoeff(), 0.2));
  }
  return checks;
}

std::vector<Check> temper_pass()
{
  const bite::RollBite b         = light_pass();
  const fem::StripElastic &state = elastic_strip("light", b, bite::Arc::rigid, 16, 3);
  const SlabOnArc with           = slab_on_circle(b, true);
  const double length            = state.flow.state.arc_length - state.flow.state.exit_position;
  return {relative("force per width against the slab with elastic ends", "N/mm", per_width(b, state) / 1e3,
                   with.force / 1e3, 0.05),
          relative("contact behind the line of centres", "mm", -state.flow.state.exit_position * 1e3,
                   with.exit * 1e3, 0.2),
          {"elastic part of the contact", "-", (state.elastic_entry + state.elastic_exit) / length, 0.1, 0,
           Judged::at_least},
          reported("reduction of the strip over that of the gap", "-",
                   (b.strip.entry_thickness - state.flow.exit_thickness) /
                       (b.strip.entry_thickness - b.strip.exit_thickness),
                   1)};
}

std::vector<Check> balances()
{
  std::vector<Check> checks;
  for (const auto &[name, arc] : {std::pair("B6", bite::Arc::rigid), std::pair("B6", bite::Arc::elastic),
                                  std::pair("B5", bite::Arc::elastic)}) {
    const fem::StripElastic &s = elastic_strip(name, arc);
    const std::string n = std::string(name) + (arc == bite::Arc::rigid ? ", rigid roll: " : ", elastic roll: ");
    const Strip &strip  = reference_pass(name).strip;
    double stress = 0, height = 0, largest = 0;
    for (int i = 0; i < s.outlet_stress.size(); ++i) {
      stress += s.outlet_stress[i] * s.outlet_weight[i];
      height += s.outlet_weight[i];
      largest = std::max(largest, std::abs(s.outlet_stress[i] - strip.exit_tension));
    }
    checks.push_back(at_most(n + "mass out over mass in, less one", "-", std::abs(s.flow.balance.flux), 1e-4));
    checks.push_back(at_most(n + "horizontal force left over k h1", "-", std::abs(s.flow.balance.force_x), 1e-6));
    checks.push_back(at_most(n + "power left over", "-", std::abs(s.flow.balance.power), 0.01));
    checks.push_back(relative(n + "mean stress far behind the bite", "MPa", stress / height / 1e6,
                              strip.exit_tension / 1e6, 1e-6));
    checks.push_back(reported(n + "largest residual stress", "MPa", largest / 1e6, 0));
  }
  return checks;
}

std::vector<Check> strip_derivatives()
{
  const bite::RollBite b = reference_pass("B6");
  fem::StripElasticModel model;
  model.elements_along           = 16;
  model.elements_through         = 3;
  model.tolerance                = 1e-11;
  const fem::StripElastic centre = fem::solve_elastic_strip(b, model);
  struct Shift {
    const char *name;
    bite::Input input;
    double step;
    double &(*of)(bite::RollBite &);
  };
  const double dh = b.strip.entry_thickness - b.strip.exit_thickness;
  const Shift shifts[]{
      {"exit thickness", bite::Input::exit_thickness, 1e-4 * dh,
       [](bite::RollBite &q) -> double & { return q.strip.exit_thickness; }},
      {"entry thickness", bite::Input::entry_thickness, 1e-4 * dh,
       [](bite::RollBite &q) -> double & { return q.strip.entry_thickness; }},
      {"entry tension", bite::Input::entry_tension, 1e4,
       [](bite::RollBite &q) -> double & { return q.strip.entry_tension; }},
      {"exit tension", bite::Input::exit_tension, 1e4,
       [](bite::RollBite &q) -> double & { return q.strip.exit_tension; }},
      {"friction", bite::Input::friction, 1e-5,
       [](bite::RollBite &q) -> double & { return q.strip.friction.coefficient; }},
      {"roll radius", bite::Input::arc_radius, 1e-5, [](bite::RollBite &q) -> double & { return q.roll_radius; }}};
  model.derivatives = false;
  std::vector<Check> checks;
  for (const Shift &shift : shifts) {
    double force[2];
    for (const int side : {0, 1}) {
      bite::RollBite moved = b;
      shift.of(moved) += (side ? 1 : -1) * shift.step;
      force[side] = fem::solve_elastic_strip(moved, model, nullptr, &centre).flow.state.force;
    }
    const double difference = (force[1] - force[0]) / (2 * shift.step);
    checks.push_back(relative(std::string("by the ") + shift.name, "SI",
                              bite::by(centre.flow.state.force_by, shift.input), difference, 1e-5));
  }
  checks.push_back(
      reported("plastic slope of the thin hard strip", "N/mm2",
               -bite::by(centre.flow.state.force_by, bite::Input::exit_thickness) / b.strip.width / 1e6, 26400.5));
  return checks;
}

std::vector<Check> mesh()
{
  const bite::RollBite b = reference_pass("B5");
  const double coarse    = per_width(b, elastic_strip("B5", bite::Arc::elastic, 16, 3)) / 1e3,
               fine      = per_width(b, elastic_strip("B5", bite::Arc::elastic)) / 1e3,
               finest    = per_width(b, elastic_strip("B5", bite::Arc::elastic, 32, 5)) / 1e3;
  return {relative("force per width, 24 x 4 against 32 x 5 elements", "N/mm", fine, finest, 0.004),
          relative("16 x 3 against 32 x 5 elements", "N/mm", coarse, finest, 0.01)};
}
}  // namespace

std::vector<Case> strip_elastic_cases()
{
  const std::string model =
      "Elastic-plastic strip (E 210 GPa, nu 0.3) by finite elements: Q2 velocity, linear pressure "
      "per element, stress carried along streamlines";
  std::vector<Case> cases;
  const auto add = [&](const char *name, const std::string &problem, const char *source, const char *reason,
                       const std::function<std::vector<Check>()> &run) {
    cases.push_back({name, "verification", problem, source, reason, run});
  };
  const char *slab =
      "horizontal equilibrium of slices with elastic loading before and unloading behind the plastic arc, "
      "integrated in 40000 steps by this case";
  add("strip-elastic-stiff",
      model +
          ", on the pass B1 (R 210, 8 -> 5 mm, k 28 MPa, mu 0.2), where elastic strain is a ten thousandth: the "
          "rigid-plastic force has to come out.",
      "the same strip ten times as stiff; limit of a rigid-plastic program, 923.3 +- 1.5 N/mm",
      "0.5 %, and 1 % of the limit: the edge of entry is singular, first order in the size of the elements there, "
      "0.9 % with 24 along the arc and 0.6 % with 32",
      stiff_strip);
  add("strip-elastic-rigid-roll",
      model + ", thin hardening strip B5 and B6 between rigid rolls, 16 x 3 and 24 x 4 elements: behind the line "
              "of centres "
              "the strip "
              "springs back while it still presses.",
      slab,
      "1 % of the force: the slab leaves out shear, and the uneven stress with which the strip leaves the rolls; "
      "spring-back "
      "to 0.02 % of the thickness",
      rigid_roll);
  add("strip-elastic-elastic-roll",
      model + ", B5 and B6 between rolls with the flexibility of a half plane, 24 x 4 elements, flattening inside "
              "Newton's "
              "method. The reference slab keeps the stress along the strip constant in its elastic ends; friction "
              "there "
              "raises the whole hill behind the neutral point, and with it the flattening.",
      "slab by this case on the arc found here; slab with its own arc and elastic ends without friction, 1600 "
      "points, F 7568.72 and 7971.13 N/mm; the same by a relaxation written for this case, with 800 points and "
      "with or "
      "without friction in the ends (1600 points with it: 7877.6 and 9730.7 N/mm)",
      "2 % on the same arc: shear, mesh; 3 % with its own arc, which flattens further under what differs; 5 % of "
      "the "
      "slab without friction in its ends, which B6 does not meet; 0.3 % between the two relaxations: grid, and "
      "Poisson's ratio of the strip (0.3 here, 0.28 there); 10 % of the place: the last millimetre carries next "
      "to no "
      "pressure",
      elastic_roll);
  add("strip-elastic-light-pass",
      model + ", 1.5 % off a strip of 0.4 mm under 100 MPa on both sides, 16 x 3 elements: the strip loads and "
              "unloads "
              "elastically over a good part of the contact.",
      slab, "5 %: the contact is as long as four thicknesses, and the slab leaves out shear", temper_pass);
  add("strip-elastic-balances",
      "What must close: mass, horizontal force, power with the elastic energy carried off, and the stress far "
      "behind the "
      "bite, whose mean is the tension.",
      "balances", "mass 1e-4 and power 1 % by quadrature; forces follow from the discrete equations", balances);
  add("strip-elastic-derivatives",
      "B6, rigid roll, 16 x 3 elements: derivatives of the force by one transposed solve.",
      "central differences of states converged to 1e-11 on one mesh", "1e-5: truncation of the difference",
      strip_derivatives);
  add("strip-elastic-mesh", model + ", B5 between elastic rolls on three meshes.", "the finest mesh",
      "0.4 % and 1 %: falls with the size of the elements", mesh);
  return cases;
}
}  // namespace mill::verify
