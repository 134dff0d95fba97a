#include "core/model/case.h"
#include "core/numerics/mesh_pair.h"
#include "fem/roll/roll_component.h"
#include "tests/manual/check/verification.h"
#include "tests/manual/solvers/whole_stand.h"
#include "tests/manual/stand/component_beams.h"
#include "tests/manual/stand/component_models.h"
#include "tests/manual/stand/component_statics.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::verify {
namespace {
const double nu = demo_roll_steel.poisson_ratio;
// Shear factor of a round section for vibration, J. R. Hutchinson, J. Appl. Mech. 68 (2001) 87.
const double hutchinson = 6 * (1 + nu) * (1 + nu) / (7 + 12 * nu + 4 * nu * nu);

Component component_of(const RollPart &roll, const int n_modes)
{
  fem::ModeChoice choice;
  choice.n_modes = n_modes;
  return fem::component_modes(*roll.part, roll.interface, choice);
}
Component component_below(const RollPart &roll, const double frequency)
{
  fem::ModeChoice choice;
  choice.frequency_limit = frequency;
  return fem::component_modes(*roll.part, roll.interface, choice);
}

double worst(const Eigen::VectorXd &result, const Eigen::VectorXd &reference)
{
  return (result.array() / reference.array() - 1).abs().maxCoeff();
}
int count_below(const Eigen::VectorXd &frequency, const double limit)
{
  return int((frequency.array() < limit).count());
}

// ---- component-free-bar ---------------------------------------------------------------------------------------

std::vector<Check> free_bar()
{
  const RollPart bar          = meshed_part("bar", {0.15, 0.9, 0, 0, 0, 0}, {0.15, 0.9, 0, 0, 0, 0},
                                            meshes::vibration_mesh_size({0.15, 0.9, 0, 0, 0, 0}, 4), 6);
  const Eigen::VectorXd solid = fem::free_modes(*bar.part, 4).frequency;
  const Eigen::VectorXd exact = free_bar_frequencies(0.3, 1.8, demo_roll_steel, hutchinson, 4);
  BeamSetup beam;
  beam.pieces       = {{0, 0.9, 0.3, 0.3}};
  beam.shear_factor = hutchinson;
  beam.per_piece    = 160;
  std::vector<Check> checks;
  for (int k = 0; k < 3; ++k)
    checks.push_back(relative(fmt::format("symmetric mode {}", k + 1), "Hz", solid[k], exact[k], 1e-3));
  // The stepped beam of the other cases against the transcendental solution: its own discretisation.
  checks.push_back(at_most("stepped beam against the exact solution, largest of 4", "-",
                           worst(SteppedTimoshenko(beam, demo_roll_steel).frequencies(4), exact), 5e-4));
  return checks;
}

// ---- component-free-roll --------------------------------------------------------------------------------------

Eigen::VectorXd free_beam(const RollGeometry &g, const double cone, const int k)
{
  BeamSetup beam;
  beam.pieces       = roll_pieces(2 * g.radius, g.half_length, 2 * g.neck_radius, g.seat_centre,
                                  g.half_length + g.neck_length, cone);
  beam.shear_factor = hutchinson;
  beam.per_piece    = cone > 0 ? 25 : 80;
  return SteppedTimoshenko(beam, demo_roll_steel).frequencies(k);
}

std::vector<Check> free_roll()
{
  std::vector<Check> checks;
  const auto add = [&](const std::string &name, const RollGeometry &g) {
    const RollPart roll           = roll_part(name, g);
    const Eigen::VectorXd full    = fem::free_modes(*roll.part, 6).frequency;
    const Component c             = component_below(roll, 1500);
    const int n                   = count_below(full, 1500);
    const Eigen::VectorXd reduced = frequencies(c.M, c.K, n, 1);
    checks.push_back(at_most(name + ", component against full, " + std::to_string(n) + " modes below 1500 Hz", "-",
                             worst(reduced, full.head(n)), 1e-3));
    const Eigen::VectorXd drawn = free_beam(g, 0, 2), cone = free_beam(g, 1, 2);
    for (int k = 0; k < 2; ++k) {
      const std::string mode = fmt::format("{}, mode {}: ", name, k + 1);
      checks.push_back(reported(mode + "full against beam as drawn", "Hz", full[k], drawn[k]));
      checks.push_back(reported(mode + "full against beam with 45-degree rule", "Hz", full[k], cone[k]));
      checks.push_back({mode + "share of the difference that the rule explains", "-",
                        (drawn[k] - cone[k]) / (drawn[k] - full[k]), 0.5, 0, Judged::at_least});
    }
  };
  add("work roll", demo_work_roll);
  add("backup roll", demo_backup_roll);
  // Without the step the beam needs no rule.
  const RollPart plain = plain_roll_part("roll without step", demo_backup_roll);
  RollGeometry bar     = demo_backup_roll;
  bar.neck_radius      = bar.radius;
  checks.push_back(relative("roll of one diameter, mode 1: full against beam", "Hz",
                            fem::free_modes(*plain.part, 1).frequency[0], free_beam(bar, 0, 1)[0], 1e-3));
  return checks;
}

// ---- component-kept-modes -------------------------------------------------------------------------------------

std::vector<Check> kept_modes()
{
  const RollPart roll = roll_part("backup roll", demo_backup_roll);
  const int n_y       = int(roll.interface.weights.cols());
  fem::WholeStand stand;
  stand.bodies = {{roll.part.get(), &roll.interface}};
  stand.mass   = Eigen::MatrixXd::Zero(n_y, n_y);
  Connection bearings{"K_Zy", Eigen::MatrixXd::Zero(1, n_y), Eigen::VectorXd::Constant(1, demo_bearings)};
  bearings.rows(0, n_y - 1)  = 1;
  stand.connections          = {bearings};
  const int n_modes          = 6;
  const Eigen::VectorXd full = fem::whole_modes(stand, n_modes).frequency;

  std::vector<Check> checks;
  Eigen::VectorXd last = Eigen::VectorXd::Constant(n_modes, 1e9);
  double growth = -1, lowest_ratio = 1e9, highest_ratio = 0;
  for (const int kept : {0, 1, 2, 4, 8, 16}) {
    const Component c = component_of(roll, kept);
    Eigen::MatrixXd K = c.K;
    K(n_y - 1, n_y - 1) += demo_bearings;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, c.M);
    const Eigen::VectorXd f = modes.eigenvalues().head(n_modes).cwiseSqrt() / (2 * M_PI);
    growth                  = std::max(growth, (f.array() / last.array() - 1).maxCoeff());
    last                    = f;
    checks.push_back({fmt::format("first mode with {} kept", kept), "Hz", f[0], full[0], kept >= 4 ? 1e-3 : 0,
                      kept >= 4 ? Judged::relative : Judged::reported});
    // The estimate is the first term of a series in (w / w_j)^2 over the modes left out: worth something well
    // below.
    const double left_out = component_of(roll, kept + 1).fixed_frequency[kept];
    for (int k = 0; k < n_modes; ++k)
      if (f[k] < 0.5 * left_out && f[k] / full[k] - 1 > 1e-9) {
        const Eigen::VectorXd q = modes.eigenvectors().col(k).head(n_y);
        const double estimate   = 0.5 * modes.eigenvalues()[k] * q.dot(c.residual * q);
        const double ratio      = estimate / (f[k] / full[k] - 1);
        lowest_ratio            = std::min(lowest_ratio, ratio);
        highest_ratio           = std::max(highest_ratio, ratio);
      }
  }
  const int below = count_below(full, 1000);
  checks.push_back(at_most(fmt::format("16 kept, {} modes below 1 kHz", below), "-",
                           worst(last.head(below), full.head(below)), 1e-3));
  checks.push_back(at_most("16 kept, largest of 6 modes", "-", worst(last, full), 1e-3));
  checks.push_back(at_most("largest growth of a frequency when modes are added", "-", growth, 1e-10));
  checks.push_back({"smallest estimate / true error", "-", lowest_ratio, 0.5, 0, Judged::at_least});
  checks.push_back(at_most("largest estimate / true error", "-", highest_ratio, 2));
  return checks;
}

// ---- component-assembly ---------------------------------------------------------------------------------------

// Work roll on an elastic foundation to the backup roll, its chock on a spring; backup roll on its bearings.
struct TwoRolls {
  RollPart work   = roll_part("work roll", demo_work_roll);
  RollPart backup = roll_part("backup roll", demo_backup_roll);
  int n_w = int(work.interface.weights.cols()), n_b = int(backup.interface.weights.cols());
  std::vector<Connection> connections() const
  {
    const int n_barrel = n_w - 1, n_y = n_w + n_b + 1;
    Connection foundation{"K3", Eigen::MatrixXd::Zero(n_barrel, n_y), Eigen::VectorXd::Zero(n_barrel)};
    for (int j = 0; j < n_barrel; ++j) {  // integral of P_2j^2 over the barrel, by its length: 1 / (4 j + 1)
      foundation.rows(j, j)       = 1;
      foundation.rows(j, n_w + j) = -1;
      foundation.stiffness[j]     = demo_contact / (4 * j + 1);
    }
    Connection bearings{"K_Zy", Eigen::MatrixXd::Zero(1, n_y), Eigen::VectorXd::Constant(1, demo_bearings)};
    bearings.rows(0, n_w + n_b - 1) = 1;
    Connection chock{"Kzc", Eigen::MatrixXd::Zero(1, n_y), Eigen::VectorXd::Constant(1, 2 * 2.01e10)};
    chock.rows(0, n_w - 1) = 1;
    chock.rows(0, n_y - 1) = -1;
    return {foundation, bearings, chock};
  }
  static constexpr double chock_mass = 2 * 880;  // kg, lower work-roll chocks (demo.inputs)
};

std::vector<Check> assembly()
{
  const TwoRolls rolls;
  const auto connections = rolls.connections();
  const int n_w = rolls.n_w, n_b = rolls.n_b, n_y = n_w + n_b + 1;
  fem::WholeStand stand;
  stand.bodies                 = {{rolls.work.part.get(), &rolls.work.interface},
                                  {rolls.backup.part.get(), &rolls.backup.interface}};
  stand.n_lumps                = 1;
  stand.mass                   = Eigen::MatrixXd::Zero(n_y, n_y);
  stand.mass(n_y - 1, n_y - 1) = TwoRolls::chock_mass;
  stand.connections            = connections;
  const int n_modes            = 8;
  const Eigen::VectorXd full   = fem::whole_modes(stand, n_modes).frequency;
  const int below              = count_below(full, 1000);

  std::vector<Check> checks;
  Eigen::VectorXd last = Eigen::VectorXd::Constant(n_modes, 1e9);
  double growth        = -1;
  const auto reduced   = [&](const Component &w, const Component &b) {
    const int m_w = int(w.M.rows()), m_b = int(b.M.rows()), n = m_w + m_b + 1;
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n), K = M;
    M.topLeftCorner(m_w, m_w) = w.M, K.topLeftCorner(m_w, m_w) = w.K;
    M.block(m_w, m_w, m_b, m_b) = b.M, K.block(m_w, m_w, m_b, m_b) = b.K;
    M(n - 1, n - 1) = TwoRolls::chock_mass;
    std::vector<int> place;  // of each coordinate y among the unknowns
    for (int i = 0; i < n_w; ++i)
      place.push_back(i);
    for (int i = 0; i < n_b; ++i)
      place.push_back(m_w + i);
    place.push_back(n - 1);
    for (const Connection &c : connections)
      K(place, place) += c.rows.transpose() * c.stiffness.asDiagonal() * c.rows;
    const Eigen::VectorXd f = frequencies(M, K, n_modes);
    growth                  = std::max(growth, (f.array() / last.array() - 1).maxCoeff());
    return last             = f;
  };
  for (const int kept : {0, 2, 4, 8, 16}) {
    const Eigen::VectorXd f = reduced(component_of(rolls.work, kept), component_of(rolls.backup, kept));
    checks.push_back(reported(fmt::format("{} kept in each, largest error below 1 kHz", kept), "-",
                              worst(f.head(below), full.head(below)), 0));
  }
  const Component w = component_below(rolls.work, 1000), b = component_below(rolls.backup, 1000);
  checks.push_back(at_most("largest growth of a frequency when modes are added", "-", growth, 1e-10));
  const Eigen::VectorXd f = reduced(w, b);
  for (int k = 0; k < below; ++k)
    checks.push_back(relative(fmt::format("mode {}, kept by the limit of 1 kHz ({} + {})", k + 1,
                                          w.fixed_frequency.size(), b.fixed_frequency.size()),
                              "Hz", f[k], full[k], 1e-3));
  return checks;
}

// ---- component-mesh -------------------------------------------------------------------------------------------

Eigen::VectorXd on_bearings(const RollGeometry &g, const int elements_per_radius, const int n_barrel)
{
  const RollPart roll = roll_part("roll", g, elements_per_radius, n_barrel);
  Component c         = component_of(roll, 10);
  // On an elastic foundation along the barrel and on springs at the seats: every function of the interface takes
  // part.
  for (int j = 0; j < n_barrel; ++j)
    c.K(j, j) += demo_contact / (4 * j + 1);
  c.K(n_barrel, n_barrel) += demo_bearings;
  return frequencies(c.M, c.K, 5);
}

// N/m, even load on the barrel, seats held, by the mean deflection of the barrel (c_0).
double even_load_stiffness(const int elements_per_radius)
{
  const Component c       = component_of(roll_part("backup roll", demo_backup_roll, elements_per_radius), 0);
  const Eigen::Index n    = c.n_interface() - 1;  // without the seat
  const Eigen::VectorXd q = c.K.topLeftCorner(n, n).ldlt().solve(Eigen::VectorXd::Unit(n, 0));
  return 1 / q[0];
}

std::vector<Check> mesh_and_functions()
{
  std::vector<Check> checks;
  const double K2 = even_load_stiffness(2), K3 = even_load_stiffness(3), K4 = even_load_stiffness(4);
  const double limit    = K4 - (K2 - K4) / (std::pow(2., fem::shoulder_order) - 1);
  const double estimate = mesh_pair_error(K3, K2, std::pow(1.5, fem::shoulder_order));
  checks.push_back(
      at_most("backup roll: K_ZW with 3 elements per radius, distance to that extrapolated from 2 and 4, "
              "over the estimate from 2 and 3",
              "-", std::abs(K3 / limit - 1) / estimate, 1));
  checks.push_back(at_most("the estimate", "-", estimate, 0.01));
  const auto add = [&](const std::string &name, const RollGeometry &g) {
    const Eigen::VectorXd fine = on_bearings(g, 5, 6);
    const int k                = count_below(fine, 1000);
    const auto largest         = [&](const Eigen::VectorXd &f, const Eigen::VectorXd &reference) {
      return worst(f.head(k), reference.head(k));
    };
    const Eigen::VectorXd usual = on_bearings(g, 3, 6), four = on_bearings(g, 3, 4), ten = on_bearings(g, 3, 10);
    const std::string modes = fmt::format("{}, {} modes below 1 kHz: ", name, k);
    checks.push_back(at_most(modes + "3 against 5 elements per radius", "-", largest(usual, fine), 3e-3));
    checks.push_back(reported(modes + "4 against 10 barrel functions", "-", largest(four, ten), 0));
    checks.push_back(at_most(modes + "6 against 10 barrel functions", "-", largest(usual, ten), 3e-3));
  };
  add("work roll", demo_work_roll);
  add("backup roll", demo_backup_roll);
  return checks;
}

// ---- component-reach ------------------------------------------------------------------------------------------

std::vector<Check> reach()
{
  std::vector<Check> checks;
  const auto add = [&](const double radius, const std::vector<int> &coarse) {
    const RollGeometry g{radius, 0.9, 0, 0, 0, 0};
    const auto model = [&](const int layers, const int section) {
      meshes::RollMeshSize size = meshes::vibration_mesh_size(g, section);
      size.largest_layer = size.end_layer = 0.9 / layers;
      size.layer_growth                   = 1;
      return meshed_part("bar", g, g, size, 1);
    };
    const Eigen::VectorXd fine = fem::free_modes(*model(24, 3).part, 6).frequency;
    for (const int layers : coarse) {
      const RollPart bar      = model(layers, 2);
      const double reach      = fem::roll_reach(*bar.body, g, demo_roll_steel);
      const Eigen::VectorXd f = fem::free_modes(*bar.part, 6).frequency;
      const int n             = count_below(f, reach);
      checks.push_back(
          at_most(fmt::format("radius {:.2f} m, {} elements in 0.9 m: {} modes below the reach of {:.0f} Hz",
                              radius, layers, n, reach),
                  "-", worst(f.head(n), fine.head(n)), 4.2e-3));
    }
  };
  add(0.05, {8, 12});
  add(0.15, {4, 6, 8});
  add(0.4, {3, 4, 6});
  return checks;
}
}  // namespace

std::vector<Case> component_cases()
{
  std::vector<Case> cases;
  const auto add = [&](Case page) { cases.push_back(std::move(page)); };
  const std::string lanczos =
      "Full finite elements on the same meshes without reduction, by Lanczos on the inverse of the assembled "
      "stiffness.";
  const std::string rule =
      "The 45-degree rule (rotordynamics practice, for instance J. M. Vance, Rotordynamics of Turbomachinery, "
      "1988) "
      "gives mass but no stiffness to the barrel outside a cone of 45 degrees from the neck. ";
  const std::string more_than_half = "A rule of thumb for the shoulder must account for the greater part of the "
                                     "difference if the shoulder is its "
                                     "cause; without a step there must be none. ";
  add({"component-identities", "unit",
       "An eighth of the demo backup roll (1450 x 1400 mm, necks 950 mm), triquadratic elements: mass and "
       "rigid motion of its component, and the fixed interface of its modes.",
       "A rigid roll carries its mass and no stress; mass of the drawing: entry demo.moving_masses.",
       "Rounding of a factorised system of 6 000 unknowns. The mesh's mass may miss what lies between the circle "
       "and "
       "its quadratic edges.",
       component_identities});
  add({"component-free-bar", "verification",
       "Free steel bar, diameter 300 mm, length 1800 mm: symmetric bending modes of the meshed eighth and of "
       "Timoshenko's beam.",
       "Timoshenko's equations solved exactly (determinant of the free end), shear factor of J. R. Hutchinson, J. "
       "Appl. "
       "Mech. 68 (2001) 87.",
       "0.1 %: that shear factor is derived from the elasticity of the solid; wave number times radius is 1.4 at "
       "the "
       "third mode, and the mesh has four elements per radius. The stepped beam has 160 elements of lumped mass: "
       "errors "
       "of (k h)^2 / 24, 2e-4 at the fourth mode.",
       free_bar});
  add({"component-free-roll", "verification",
       "Work roll and backup roll of the demo stand, free: modes of the full mesh, of the component with the "
       "modes kept "
       "for 1500 Hz, and of stepped Timoshenko beams: as drawn, and with the 45-degree rule.",
       "Full finite elements on the same mesh; stepped Timoshenko beams, shear factor of Hutchinson (2001). " +
           rule,
       "0.1 % is what the kept modes promise. " + more_than_half +
           "The roll turned to one diameter: 0.1 %, as for the bar.",
       free_roll});
  add({"component-kept-modes", "verification",
       "Backup roll on its two bearings (K_Zy at the seats): first six modes with 0 to 16 kept modes against full "
       "finite elements, and the residual estimate of each against its true error.",
       lanczos,
       "0.1 % wanted below 1 kHz. By Rayleigh's principle a larger basis cannot raise a frequency: rounding only. "
       "The "
       "estimate leaves out a factor 1 / (1 - w^2/w_j^2), at most 4/3 in the range where it is judged.",
       kept_modes});
  add({"component-assembly", "verification",
       "Work roll, foundation K3, backup roll on K_Zy and a work-roll chock on its bearing: two components "
       "against both "
       "full "
       "meshes joined by the same springs.",
       lanczos,
       "0.1 % is what the modes kept for 1 kHz promise for every mode below. A larger basis cannot raise a "
       "frequency.",
       assembly});
  add({"component-mesh", "verification",
       "Work roll and backup roll on an elastic foundation of K3 along the barrel and springs at the seats, modes "
       "below 1 kHz: "
       "the "
       "usual mesh of 3 elements per radius against 5, 6 Legendre functions of the barrel against 10.",
       "Convergence; a corner of 270 degrees lets energies converge as h^1.09 (M. L. Williams, J. Appl. Mech. 19 "
       "(1952) "
       "526).",
       "0.3 % wanted below 1 kHz; an estimate from two meshes must cover the error, and 1 % is what K_ZW is to be "
       "sure "
       "to.",
       mesh_and_functions});
  add({"component-reach", "verification",
       "Free bars of three thicknesses on coarse layers: every mode below the frequency that the mesh is said to "
       "reach, "
       "against a fine mesh.",
       "Convergence; the rule of four quadratic elements per wave, with the bending stiffness of long elements.",
       "0.42 % is the error of a quadratic element at four elements per wave, (pi/2)^4 / 1440.", reach});
  add({"component-on-seats", "verification",
       "ST-16: first frequency of the backup roll with its bearing seats at rest, from the beam of the closed "
       "form to "
       "the solid roll, one ingredient at a time.",
       "312.0 Hz by Timoshenko beam elements (stand.md, ST-16). " + rule,
       "0.1 % for the beam: two independent programs, the reference has four digits. " + more_than_half +
           "Against the beam as drawn the difference of the solid roll is shown, not judged.",
       roll_on_rigid_seats});
  add({"component-deflection", "verification",
       "Backup roll under an even load on the barrel, held by its seats: shape of its axis and stiffness K_ZW "
       "against "
       "the closed form, and the share of shoulder and seat in the difference.",
       "Entries backup_shape.shear.w_rel and K_ZW; stepped Timoshenko beams. 6.14 to 6.17e10 N/m: K_ZW by an "
       "independent finite-element program on meshes of its own, by how the bearing holds the neck. " +
           rule,
       "2 % of w(0) for the shape, as wanted of shapes by finite elements. 1e-6: elements with exact stiffness, "
       "the "
       "even load put on 200 nodes per piece. 0.5 %: the range of the other program with its middle, and 0.25 % "
       "for our "
       "mesh. 2 % of the closed form's K_ZW, as of its shape. " +
           more_than_half +
           "2 % for the roll without step: the even load of a bar one diameter long is carried by its whole "
           "section, "
           "which Cowper's and Hutchinson's shear factors do not describe.",
       roll_deflection});
  return cases;
}
}  // namespace mill::verify
