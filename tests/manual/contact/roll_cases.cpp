#include "core/model/case.h"
#include "fem/roll/contact_readings.h"
#include "fem/roll/contact_study.h"
#include "meshes/roll/contact_mesh_size.h"
#include "reduce/chain/line_contact.h"
#include "tests/manual/check/verification.h"
#include "tests/manual/contact/engine_agreement.h"
#include "tests/manual/contact/roll_models.h"
#include "tests/manual/solvers/full_contact.h"
#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace mill::verify {
namespace {
const Material roll_steel{210e9, 0.3, 7700};

// A small pair with necks: coarse, since identities hold on any mesh.
const RollGeometry small_backup{0.3, 0.4, 0.2, 0.3, 0.55, 0}, small_work{0.12, 0.4, 0.08, 0.25, 0.52, 0};

meshes::RollMeshSize coarse_size(const RollGeometry &geometry, const double load)
{
  const auto hertz = reduce::line_contact(
      {2 * small_backup.radius, 2 * small_work.radius, 2 * geometry.half_length, roll_steel}, load);
  auto size               = meshes::roll_contact_size(hertz.half_width, 3, 1.5);
  size.end_layer          = 0.01;
  size.section.far_growth = 2;
  return size;
}

// ---- symmetry-identity
// ------------------------------------------------------------------------------------------

// The whole roll, assembled from the stiffness of the eighth and its seven mirror images.
struct WholeBody {
  std::vector<std::array<int, 8>>
      image;  // node of the whole for node n of the eighth and reflection g (bits x, y, z)
  Eigen::MatrixXd points;
  SymmetricSparse K;
};

WholeBody whole_body(const fem::ElasticBody &eighth)
{
  WholeBody w;
  const auto &p      = eighth.nodes();
  const double small = 1e-9 * p.cwiseAbs().maxCoeff();
  w.image.resize(std::size_t(p.rows()));
  std::vector<Eigen::RowVector3d> points;
  for (int n = 0; n < p.rows(); ++n)
    for (int g = 0; g < 8; ++g) {
      // A reflection does not move a node on its plane: the image is that of the smaller group element.
      int kept = g;
      for (int c = 0; c < 3; ++c)
        if (std::abs(p(n, c)) < small)
          kept &= ~(1 << c);
      if (kept < g)
        w.image[std::size_t(n)][std::size_t(g)] = w.image[std::size_t(n)][std::size_t(kept)];
      else {
        Eigen::RowVector3d x = p.row(n);
        for (int c = 0; c < 3; ++c)
          if (g >> c & 1)
            x[c] = -x[c];
        w.image[std::size_t(n)][std::size_t(g)] = int(points.size());
        points.push_back(x);
      }
    }
  w.points.resize(Eigen::Index(points.size()), 3);
  for (std::size_t n = 0; n < points.size(); ++n)
    w.points.row(Eigen::Index(n)) = points[n];
  std::vector<Eigen::Triplet<double>> entries;
  const SymmetricSparse &K = eighth.stiffness();
  for (int g = 0; g < 8; ++g)
    for (int j = 0; j < K.cols(); ++j)
      for (SymmetricSparse::InnerIterator it(K, j); it; ++it) {
        const int a = int(it.row()) % 3, b = j % 3;
        const double sign = ((g >> a & 1) ? -1 : 1) * ((g >> b & 1) ? -1 : 1);
        int row           = 3 * w.image[std::size_t(it.row() / 3)][std::size_t(g)] + a,
            col           = 3 * w.image[std::size_t(j / 3)][std::size_t(g)] + b;
        if (row > col)
          std::swap(row, col);
        // An off-diagonal entry between two unknowns that the reflection maps to one another is added from both
        // sides.
        entries.emplace_back(row, col, sign * it.value() * (row == col && it.row() != j ? 2 : 1));
      }
  const int n = int(3 * points.size());
  w.K.resize(n, n);
  w.K.setFromTriplets(entries.begin(), entries.end());
  return w;
}

// Loads on the contact line y > 0 that differ everywhere, carried by unequal loads on the two bearing seats.
std::vector<Check> symmetry_identity()
{
  fem::CondenseOptions options;
  options.both_sides = true;
  const auto model   = roll_model("whole", small_work, coarse_size(small_work, 2e5), roll_steel, options, 1);
  const auto &roll   = model.roll;
  const auto held    = fem::held_by_necks(roll, fem::Extent::whole);
  const auto &grid   = held.grid;
  const int n        = grid.n_x * grid.n_z;
  Eigen::VectorXd f(n);  // on x >= 0
  for (int i = 0; i < n; ++i)
    f[i] = grid.area[i] * (1 + 0.7 * std::sin(1 + 13. * i) + grid.z[i / grid.n_x] / 0.4);
  Eigen::Vector2d resultant = Eigen::Vector2d::Zero();
  for (int i = 0; i < n; ++i)
    resultant += Eigen::Vector2d(f[i], f[i] * grid.z[i / grid.n_x]);
  const Eigen::VectorXd condensed      = held.flexibility * f + held.support * resultant;
  const Eigen::VectorXd condensed_axis = held.axis * f + held.axis_support * resultant;

  const WholeBody whole = whole_body(*model.body);
  const auto &eighth    = *model.body;
  Eigen::VectorXd load  = Eigen::VectorXd::Zero(whole.K.rows());
  const auto patch      = fem::patch_in_grid_order(eighth);
  // Node of the whole for the unfolded station k and column i: y > 0, reflected in z where k is on that side.
  const auto patch_node = [&](const int k, const int i, const bool mirrored_x) {
    const int station = k - (roll.grid.n_z - 1);
    const int node    = patch[std::size_t(std::abs(station) * grid.n_x + i)];
    return whole.image[std::size_t(node)][std::size_t((station < 0 ? 4 : 0) + (mirrored_x ? 1 : 0))];
  };
  for (int k = 0; k < grid.n_z; ++k)
    for (int i = 0; i < grid.n_x; ++i)
      for (const bool mirrored_x : {false, true})
        load[3 * patch_node(k, i, mirrored_x) + 1] -= f[k * grid.n_x + i];
  // Seats: the distribution of the eighth over both halves in x and y, scaled to the reaction of each side.
  const double moment = resultant[1] / roll.seat_lever;
  const auto weight   = [](const double z, const void *context) {
    const auto &g = *static_cast<const RollGeometry *>(context);
    const double s =
        (z - g.seat_centre) / std::min(0.5 * g.neck_length, g.half_length + g.neck_length - g.seat_centre);
    return std::abs(s) < 1 ? std::pow(std::cos(0.5 * M_PI * s), 2) : 0;
  };
  const Eigen::VectorXd seat = eighth.face_load("neck", weight, &small_work);
  for (int node = 0; node < seat.size(); ++node)
    for (int g = 0; g < 8; ++g) {
      const double side = 0.5 * (resultant[0] + (g & 4 ? -moment : moment));  // half in x of one seat
      load[3 * whole.image[std::size_t(node)][std::size_t(g)] + 1] += 0.5 * side * seat[node] / seat.sum();
    }
  // Statically determinate pins on the axis and off it; they carry nothing.
  int end[2] = {0, 0}, far_x = 0;
  for (int i = 0; i < whole.points.rows(); ++i) {
    if (whole.points.row(i).head<2>().norm() < 1e-9) {
      if (whole.points(i, 2) < whole.points(end[0], 2) || whole.points.row(end[0]).head<2>().norm() > 1e-9)
        end[0] = i;
      if (whole.points(i, 2) > whole.points(end[1], 2) || whole.points.row(end[1]).head<2>().norm() > 1e-9)
        end[1] = i;
    }
    if (std::abs(whole.points(i, 1)) < 1e-9 && whole.points(i, 0) > whole.points(far_x, 0))
      far_x = i;
  }
  std::vector<char> pinned(std::size_t(whole.K.rows()), 0);
  for (const int unknown : {3 * end[0], 3 * end[0] + 1, 3 * end[0] + 2, 3 * end[1], 3 * end[1] + 1, 3 * far_x + 1})
    pinned[std::size_t(unknown)] = 1;
  std::vector<int> place(std::size_t(whole.K.rows()), -1), node_of;
  for (int i = 0, k = 0; i < whole.K.rows(); ++i)
    if (!pinned[std::size_t(i)]) {
      place[std::size_t(i)] = k++;
      node_of.push_back(i / 3);
    }
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < whole.K.cols(); ++j)
    for (SymmetricSparse::InnerIterator it(whole.K, j); it; ++it)
      if (place[std::size_t(j)] >= 0 && place[std::size_t(it.row())] >= 0)
        entries.emplace_back(place[std::size_t(it.row())], place[std::size_t(j)], it.value());
  SymmetricSparse K(Eigen::Index(node_of.size()), Eigen::Index(node_of.size()));
  K.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd b(K.rows());
  for (int i = 0; i < load.size(); ++i)
    if (place[std::size_t(i)] >= 0)
      b[place[std::size_t(i)]] = load[i];
  const CondensingFactor factor(K, node_of, {});
  Eigen::VectorXd u              = factor.solve(b);
  const Eigen::VectorXd residual = b - K.selfadjointView<Eigen::Upper>() * u;
  u += factor.solve(residual);
  const auto along_y = [&](const int node) {
    const int i = place[std::size_t(3 * node + 1)];
    return i < 0 ? 0. : u[i];
  };
  // Patch and axis together, both up to one rigid motion.
  const int n_axis = int(held.axis_z.size());
  std::map<long, int> axis_node;
  for (int i = 0; i < whole.points.rows(); ++i)
    if (whole.points.row(i).head<2>().norm() < 1e-9)
      axis_node[std::lround(whole.points(i, 2) * 1e9)] = i;
  Eigen::VectorXd difference(n + n_axis);
  Eigen::MatrixXd rigid(n + n_axis, 3);  // along y, about x, about z
  for (int i = 0; i < n; ++i) {
    difference[i] = -along_y(patch_node(i / grid.n_x, i % grid.n_x, false)) - condensed[i];
    rigid.row(i) << 1, grid.z[i / grid.n_x], grid.x[i % grid.n_x];
  }
  for (int k = 0; k < n_axis; ++k) {
    difference[n + k] = -along_y(axis_node.at(std::lround(held.axis_z[k] * 1e9))) - condensed_axis[k];
    rigid.row(n + k) << 1, held.axis_z[k], 0;
  }
  const Eigen::VectorXd motion = (rigid.transpose() * rigid).ldlt().solve(rigid.transpose() * difference);
  const double spread          = condensed.maxCoeff() - condensed.minCoeff();
  return {{"displacements of contact line and axis, largest difference", "-",
           (difference - rigid * motion).cwiseAbs().maxCoeff() / spread, 0, 1e-9, Judged::absolute}};
}

// ---- condensed-identity ---------------------------------------------------------------------------------------

double half_width(const double q)
{
  return reduce::line_contact({0.4, 1.3, 1, roll_steel}, q).half_width;
}

fem::ContactPair slab_pair(const RollModel &a, const RollModel &b)
{
  return fem::make_pair("line", a.roll, fem::held_by_mirror(a.roll), b.roll, fem::held_by_mirror(b.roll),
                        Eigen::VectorXd::Zero(a.roll.grid.n_z));
}

std::vector<Check> condensed_identity()
{
  const auto upper = slab_model("upper", 0.4, half_width(2e5), half_width(5e6), 6, 0.02, roll_steel),
             lower = slab_model("lower", 1.3, half_width(2e5), half_width(5e6), 6, 0.02, roll_steel);
  const auto pair  = slab_pair(upper, lower);
  const auto point = fem::solve_load(pair, 1e6);
  const auto full =
      fem::solve_full_contact(*upper.body, *lower.body, pair.problem.initial_gap, point.approach, true);
  const auto nodal = point.state.nodal;
  return {{"force at the same approach", "N", full.force, nodal.sum(), 1e-8},
          {"nodal forces, largest difference over the largest", "-",
           (full.nodal - nodal).cwiseAbs().maxCoeff() / nodal.maxCoeff(), 0, 1e-6, Judged::absolute}};
}

// ---- tangent-difference, complementarity ----------------------------------------------------------------------

std::vector<Check> tangent_difference()
{
  fem::CondenseOptions options;
  options.both_sides = true;
  const auto size    = coarse_size(small_work, 4e5);
  const auto backup  = roll_model("backup", small_backup, size, roll_steel, options),
             work    = roll_model("work", small_work, size, roll_steel, options);
  std::vector<Check> checks;
  const auto judge = [&](const std::string &what, const fem::ContactPair &pair, const double load) {
    const auto state  = fem::solve_load(pair, load);
    const double step = 1e-7;
    const auto above  = fem::solve_load(pair, load * (1 + step), state.state.active),
               below  = fem::solve_load(pair, load * (1 - step), state.state.active);
    checks.push_back(
        {what + ": tangent", "N/m", state.tangent, 2 * step * load / (above.approach - below.approach), 1e-6});
    checks.push_back({what + ": complementarity residual", "-", state.state.residual, 1e-12, 0, Judged::at_most});
  };
  const auto pair_of = [&](const fem::HeldRoll &a, const fem::HeldRoll &b, const double crown) {
    Eigen::VectorXd drop = 0.5 * crown * (a.grid.z / 0.4).array().square();
    return fem::make_pair("rolls", backup.roll, a, work.roll, b, drop);
  };
  const auto quarter = fem::Extent::quarter, whole = fem::Extent::whole;
  judge("mirrored", pair_of(fem::held_by_mirror(backup.roll), fem::held_by_mirror(work.roll), 0), 1e5);
  judge("on necks and strip, crown 30 um",
        pair_of(fem::held_by_necks(backup.roll, quarter), fem::held_by_strip(work.roll, 0.5, quarter), 30e-6),
        2e5);
  auto tilted = pair_of(fem::held_by_mirror(backup.roll, whole), fem::held_by_mirror(work.roll, whole), 0);
  tilted.tilt = 2e-5;
  judge("mirrored, axes tilted by 0.02 mrad", tilted, 1e5);
  auto aside = pair_of(fem::held_by_necks(backup.roll, whole), fem::held_by_strip(work.roll, 0.5, whole), 0);
  aside.load_offset = 0.06;
  judge("on necks and strip, force 60 mm off the middle", aside, 2e5);
  auto held = pair_of(fem::held_by_necks(backup.roll, whole), fem::held_by_strip(work.roll, 0.5, whole), 0);
  held.tilt = 1e-5;
  judge("on necks and strip, axes tilted by 0.01 mrad", held, 2e5);
  // Without anything one-sided the model of both sides must give what the quarter gives.
  const auto one =
      fem::solve_load(pair_of(fem::held_by_necks(backup.roll), fem::held_by_strip(work.roll, 0.5), 0), 2e5);
  auto straight  = pair_of(fem::held_by_necks(backup.roll, whole), fem::held_by_strip(work.roll, 0.5, whole), 0);
  const auto two = fem::solve_load(straight, 2e5);
  checks.push_back({"both sides against the quarter, approach", "m", two.approach, one.approach, 1e-9});
  checks.push_back({"both sides against the quarter, tangent", "N/m", two.tangent, one.tangent, 1e-9});
  return checks;
}

// ---- complementarity ------------------------------------------------------------------------------------------

std::vector<Check> complementarity()
{
  fem::CondenseOptions options;
  options.both_sides = true;
  const auto size    = coarse_size(small_work, 4e5);
  const auto backup  = roll_model("backup", small_backup, size, roll_steel, options),
             work    = roll_model("work", small_work, size, roll_steel, options);
  const auto loads   = fem::log_spaced(1e4, 4e5, 20);
  std::vector<Check> checks;
  for (const double crown : {0., 40e-6, -40e-6, 400e-6})
    for (const auto extent : {fem::Extent::quarter, fem::Extent::whole}) {
      const auto a               = fem::held_by_necks(backup.roll, extent);
      const Eigen::VectorXd drop = 0.5 * crown * (a.grid.z / 0.4).array().square();
      const auto pair =
          fem::make_pair("rolls", backup.roll, a, work.roll, fem::held_by_strip(work.roll, 0.5, extent), drop);
      const auto curve        = fem::sweep(pair, loads);
      const std::string where = fmt::format("crown {:.0f} um, {}", 1e6 * crown,
                                            extent == fem::Extent::whole ? "both sides" : "a quarter");
      checks.push_back({where + ": residual", "-", curve.residual, 1e-12, 0, Judged::at_most});
      checks.push_back(
          {where + ": iterations of the first load", "-", double(curve.iterations[0]), 8, 0, Judged::at_most});
      checks.push_back({where + ": iterations of the others", "-",
                        double(curve.iterations.tail(curve.iterations.size() - 1).maxCoeff()), 3, 0,
                        Judged::at_most});
    }
  return checks;
}

// ---- scale-invariance -----------------------------------------------------------------------------------------

struct Scaled {
  double approach, tangent, half_width, peak;
};

// The pair with all lengths multiplied by `length` and the modulus by `modulus`; the load follows.
Scaled scaled_pair(const double length, const double modulus)
{
  Material material       = roll_steel;
  material.youngs_modulus = roll_steel.youngs_modulus * modulus;
  const auto scaled       = [&](RollGeometry g) {
    for (double *value : {&g.radius, &g.half_length, &g.neck_radius, &g.neck_length, &g.seat_centre})
      *value *= length;
    return g;
  };
  auto size = coarse_size(small_work, 2e5);
  size.section.first_element *= length;
  size.end_layer *= length;
  size.largest_layer *= length;
  const double load = 1e5 * modulus * length * length;
  const auto backup = roll_model("backup", scaled(small_backup), size, material, {}),
             work   = roll_model("work", scaled(small_work), size, material, {});
  const auto pair =
      fem::make_pair("rolls", backup.roll, fem::held_by_necks(backup.roll), work.roll,
                     fem::held_by_strip(work.roll, 0.5 * length), Eigen::VectorXd::Zero(work.roll.grid.n_z));
  const auto point   = fem::solve_load(pair, load);
  const auto profile = fem::barrel_profile(pair, point);
  return {point.approach / length, point.tangent / (modulus * length), profile.half_width[0] / length,
          profile.peak_pressure[0] / modulus};
}

std::vector<Check> roll_scale_invariance()
{
  const Scaled metres = scaled_pair(1, 1);
  std::vector<Check> checks;
  const auto compare = [&](const std::string &name, const Scaled &other) {
    checks.push_back({name + ": approach", "m", other.approach, metres.approach, 1e-10});
    checks.push_back({name + ": tangent", "N/m", other.tangent, metres.tangent, 1e-10});
    checks.push_back({name + ": half width", "m", other.half_width, metres.half_width, 1e-10});
    checks.push_back({name + ": peak pressure", "Pa", other.peak, metres.peak, 1e-10});
  };
  compare("written in mm and N/mm2", scaled_pair(1e3, 1e-6));
  compare("10 x geometry", scaled_pair(10, 1));
  return checks;
}

// ---- published-k ----------------------------------------------------------------------------------------------

std::vector<Check> published_k()
{
  const Material published{2.7e11, 0.28, 7700};
  const RollGeometry backup{0.725, 0.7, 0.475, 0.95, 1.225, 0}, work{0.210, 0.7, 0.13335, 0.46, 1.0, 0};
  const double F   = 976217.5;
  const auto hertz = reduce::line_contact({0.42, 1.45, 1.4, published}, F);
  const auto size  = meshes::roll_contact_size(hertz.half_width, 4, 1.5);
  const auto a     = roll_model("backup", backup, size, published, {}),
             b     = roll_model("work", work, size, published, {});
  const auto pair  = fem::make_pair("upper", a.roll, fem::held_by_mirror(a.roll), b.roll,
                                    fem::held_by_mirror(b.roll), Eigen::VectorXd::Zero(b.roll.grid.n_z));
  const auto point = fem::solve_load(pair, F);
  const auto path  = fem::path_plateau(pair, point, 0.1);
  const auto k     = fem::barrel_profile(pair, point);
  std::vector<Check> checks;
  const auto compare = [&](const std::string &what, const double value, const double published_value) {
    checks.push_back({what, "N/m", value, published_value, 0, Judged::reported});
  };
  compare("axis-to-axis tangent", point.tangent, 7.534e11);
  compare("axis-to-axis secant", F / point.approach, 7.534e11);
  compare(fmt::format("path plateau, tributary length {:.1f} mm", 1e3 * path.tributary_length), path.mean,
          7.534e8);
  checks.push_back(
      {"tangent against the line contact of infinite length", "N/m", point.tangent, hertz.tangent, 0.02});
  checks.push_back({"tangent per length at mid-length", "N/m2", k.tangent[0], hertz.tangent / 1.4, 0.03});
  return checks;
}
}  // namespace

std::vector<Case> roll_cases()
{
  const std::string reduced = "rounding of two ways through the same equations, conditioning about 1e7";
  return {
      {"symmetry-identity", "verification",
       "Roll with necks, trilinear hexahedra: flexibility recombined from four parities of an eighth against one "
       "solve "
       "of the whole roll (assembled from the eight mirror images), unlike loads everywhere, unequal bearing "
       "loads.",
       "identity, theory.md 2.2", reduced, symmetry_identity},
      {"condensed-identity", "verification",
       "Two discs 400/1300 mm, 1000 N/mm: condensed contact against the contact solved on the full stiffness "
       "matrices, "
       "factorised again for each active set.",
       "identity; code_aster V6.04.193 compares the same to 1e-6", reduced, condensed_identity},
      {"tangent-difference", "verification",
       "Two rolls with necks, held in several ways, crowned, tilted, loaded off the middle: exact tangent against "
       "the "
       "central difference of the program's own curve; residual of every solve.",
       "identity, theory.md 2.4", "a step of 1e-7 of the load keeps seven digits of a difference",
       tangent_difference},
      {"complementarity", "verification",
       "Two rolls with necks, straight, crowned, hollow and with a crown that stays open: 20 loads each, residual "
       "of all "
       "conditions and iterations of the active set.",
       "Signorini's conditions, theory.md 9", "rounding; iterations as wanted of a solver without tolerance",
       complementarity},
      {"scale-invariance", "verification",
       "The same pair of rolls written in metres and in millimetres, and ten times as large.",
       "dimensional analysis", "rounding, conditioning about 1e5 of the contact problem", roll_scale_invariance},
      {"engine-agreement", "verification",
       "Rolls 420/1450 mm with necks, 976.2 kN: hexahedra condensed onto the patch against a Fourier series "
       "around each "
       "roll with one unknown per station. Line loads are means over the stations, along the whole barrel; the "
       "program "
       "has no third engine of coarse elements with a half-space correction.",
       "the Fourier solver, theory.md 11", "meshes of both engines; targets of two independent engines",
       engine_agreement},
      {"published-k", "benchmark",
       "Rolls 420/1450 mm, barrel 1400 mm, 976.2 kN, E = 270 GPa: the ways of evaluating a contact stiffness "
       "compared with "
       "the published K3 = 7.534e5 kN/mm; the plateau is compared with 7.534e5 N/mm.",
       "published stand; line contact of K. L. Johnson, Contact Mechanics, 5.57",
       "barrel ends and a mesh of four elements per half width against an infinitely long contact", published_k},
  };
}
}  // namespace mill::verify
