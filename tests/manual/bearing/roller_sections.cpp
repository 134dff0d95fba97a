#include "tests/manual/bearing/roller_sections.h"
#include "core/base/errors.h"
#include "fem/body/body_pair.h"
#include "fem/contact/active_set.h"
#include "meshes/bearing/raceway.h"
#include "meshes/common/block.h"
#include "tests/manual/check/units.h"
#include "tests/manual/contact/meshed.h"
#include "tests/manual/contact/roll_models.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <numeric>

namespace mill::verify {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

const Material bearing_steel{206e9, 0.3, 7850};

double sagitta(const double radius, const double x)
{
  return radius == 0 ? 0 : x * x / (radius + std::copysign(std::sqrt(radius * radius - x * x), radius));
}

// Johnson's approach of the roller's diametral plane and a raceway held at `depth`, m; radius < 0: concave.
double half_width(const double radius, const double q)
{
  const double E = bearing_steel.youngs_modulus / (2 * (1 - 0.3 * 0.3));
  return std::sqrt(4 * q / (M_PI * E * (2 / roller_diameter + (radius != 0 ? 1 / radius : 0))));
}
double johnson_approach(const double radius, const double depth, const double q)
{
  const double nu = bearing_steel.poisson_ratio, b = half_width(radius, q);
  const double body = q * (1 - nu * nu) / (M_PI * bearing_steel.youngs_modulus);
  return body * (2 * std::log(2 * roller_diameter / b) - 1) + body * (2 * std::log(2 * depth / b) - nu / (1 - nu));
}
double johnson_load(const double radius, const double depth, const double approach)
{
  double low = 1, high = 1e8;
  for (int i = 0; i < 200; ++i) {
    const double q                                               = std::sqrt(low * high);
    (johnson_approach(radius, depth, q) < approach ? low : high) = q;
  }
  return std::sqrt(low * high);
}

// Half of the approach that ISO/TS 16281 gives both contacts of a roller of this length under the line load.
double iso_approach(const double q)
{
  const double c = 35948 * std::pow(roller_length / mm, 8. / 9);  // N/mm^(10/9)
  return 0.5 * std::pow(q * roller_length / c, 0.9) * mm;
}

struct Race {
  double radius, depth;  // m; > 0 convex, < 0 concave, 0 flat
  double sides;          // m, where it is cut off
};

// Half of the section of roller and raceway, grids that do not match.
class RollerSection {
public:
  RollerSection(const Race &race, const double smallest, const double largest)
      : R(race.radius), roller(disc_section(0.5 * roller_diameter, smallest, largest, 14, bearing_steel)),
        raceway(section_of(race, smallest, largest)), slave(condensed_patch(raceway, held(raceway))),
        master(condensed_patch(roller, held_quarter(roller)))
  {
    fem::PairOptions options;
    options.gap = [this](const VectorXd &x) { return sagitta(R, x[0]) + sagitta(0.5 * roller_diameter, x[0]); };
    pair = fem::pair_bodies({&slave}, upside_down(master, 0.5 * roller_diameter), {master_moves_down()}, options);
    solver = std::make_unique<contact::ActiveSet>(pair.problem);
  }

  struct Result {
    double q, half_width;  // N/m, m
  };
  Result at(const double approach)
  {
    const auto state = solver->solve(prescribed(approach));
    return {2 * state.resultant[0], fitted_ellipse(pair, state).half_width};
  }
  double approach(const double q)
  {
    return solver->solve(by_resultant(0.5 * q)).motion[0];
  }

private:
  static fem::SectionBody section_of(const Race &race, const double smallest, const double largest)
  {
    const double element = smallest / 10, patch = 1.2 * largest;
    const int n = int(std::ceil(patch / element));
    meshes::RacewayPiece piece;
    piece.radius  = race.radius;
    piece.x       = meshes::mesh_lines({patch, n, 0, 1.4, race.sides});
    piece.depth   = meshes::mesh_lines({0, 0, element, 1.25, race.depth});
    piece.patch_x = patch;
    const ScratchFile file("raceway");
    return fem::SectionBody(meshes::mesh_raceway(piece, file.path), bearing_steel, 2, fem::Section::plane_strain);
  }
  static std::vector<char> held(const fem::SectionBody &body)
  {
    std::vector<char> out(std::size_t(body.stiffness().rows()), 0);
    for (const int node : body.group("symmetry.x"))
      out[std::size_t(2 * node)] = 1;
    for (const int node : body.group("back"))
      out[std::size_t(2 * node)] = out[std::size_t(2 * node + 1)] = 1;
    return out;
  }

  double R;
  fem::SectionBody roller, raceway;
  fem::CondensedSurface slave, master;
  fem::BodyPair pair;
  std::unique_ptr<contact::ActiveSet> solver;
};

struct SeriesPoint {
  double approach, q, half_width;  // m, N/m, m; half width 0: not recorded
};

void check_series(std::vector<Check> &checks, const std::string &name, const Race &race,
                  const std::vector<SeriesPoint> &series, const double tolerance)
{
  RollerSection section(race, 0.12 * mm, 0.31 * mm);
  for (const SeriesPoint &point : series) {
    const auto solved       = section.at(point.approach);
    const std::string where = fmt::format("{}, d {:g} um", name, point.approach / um);
    checks.push_back(
        relative("line load P, " + where, "N/mm", solved.q / N_per_mm, point.q / N_per_mm, tolerance));
    checks.push_back(within("P FE / P Johnson, " + where,
                            solved.q / johnson_load(race.radius, race.depth, point.approach), 0.96, 1));
    checks.push_back(within("secant FE / ISO, " + where, iso_approach(solved.q) / point.approach, 1.05, 1.20));
    checks.push_back(relative("half width / Hertz at P, " + where, "-",
                              solved.half_width / half_width(race.radius, solved.q), 1, 0.005));
    if (point.half_width > 0)
      checks.push_back(reported("half width, " + where, "mm", solved.half_width / mm, point.half_width / mm));
  }
}

// ---- the product's element
// Roller and raceway as a slab one element thick, held between two planes: the hexahedra of the product with even
// elements of width h on the patch.
class Slab {
public:
  explicit Slab(const double h)
  {
    const double patch = 0.42 * mm, depth = 12 * mm, thickness = 1 * mm;
    const int n = 3 * int(std::ceil(patch / h / 3));
    RollGeometry geometry;
    geometry.radius      = 0.5 * roller_diameter;
    geometry.half_length = thickness;
    meshes::RollMeshSize size;
    size.section.first_element   = h;
    size.section.patch_elements  = n;
    size.section.depth_elements  = std::max(3, n / 6 * 3);
    size.section.depth_growth    = 1.15;
    size.section.far_growth      = 1.4;
    size.section.sector_elements = 6;
    size.end_layer = size.largest_layer = thickness;
    fem::CondenseOptions options;
    options.slab       = true;
    const auto roller  = roll_model("roller-slab", geometry, size, bearing_steel, options).roll;
    const auto surface = raceway(roller.grid, h, depth, thickness);
    contact::Problem p;
    p.C = roller.symmetric.patch + surface;
    p.G.setOnes(p.C.rows(), 1);
    p.initial_gap.resize(p.C.rows());
    for (Index i = 0; i < p.C.rows(); ++i)
      p.initial_gap[i] = sagitta(0.5 * roller_diameter, roller.grid.x[i % roller.grid.n_x]);
    to_line_load = 2 / thickness;
    solver       = std::make_unique<contact::ActiveSet>(p);
  }
  double line_load(const double approach)
  {
    return to_line_load * solver->solve(prescribed(approach)).resultant[0];
  }

private:
  static MatrixXd raceway(const fem::PatchGrid &grid, const double h, const double depth, const double thickness)
  {
    meshes::RacewayPiece piece;
    for (Index i = 0; i < grid.n_x; i += 2)
      piece.x.push_back(grid.x[i]);
    piece.patch_x = piece.x.back();
    for (const double x : meshes::mesh_lines({0, 0, h, 1.4, 4 * depth - piece.patch_x}))
      if (x > 0)
        piece.x.push_back(piece.patch_x + x);
    piece.depth = meshes::mesh_lines({0, 0, h, 1.25, depth});
    piece.z     = {0, thickness};
    const ScratchFile file("raceway-slab");
    const fem::ElasticBody body(meshes::mesh_raceway(piece, file.path), bearing_steel, 2);
    std::vector<char> held(std::size_t(3 * body.nodes().rows()), 0);
    const auto hold = [&](const char *group, const int direction) {
      for (const int node : body.group(group))
        held[std::size_t(3 * node + direction)] = 1;
    };
    hold("symmetry.x", 0);
    hold("symmetry.z", 2);
    hold("end", 2);
    for (const int direction : {0, 1, 2})
      hold("back", direction);
    fem::SurfaceOptions options;
    options.direction = Eigen::Vector3d(0, 1, 0);
    const fem::CondensedSurface surface(body.stiffness(), 3, held, body.surface("patch"), options);
    // In the order of the roller's grid: by z, then by x.
    const MatrixXd &points = surface.surface().points;
    std::vector<int> order(std::size_t(points.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const int a, const int b) {
      return std::abs(points(a, 2) - points(b, 2)) > 0.01 * h ? points(a, 2) < points(b, 2)
                                                              : points(a, 0) < points(b, 0);
    });
    return surface.flexibility()(order, order);
  }

  double to_line_load = 0;  // 1/m
  std::unique_ptr<contact::ActiveSet> solver;
};
}  // namespace

double plane_approach(const double radius, const double q)
{
  return RollerSection({radius, 12 * mm, 48 * mm}, 0.12 * mm, 0.31 * mm).approach(q);
}

std::vector<Check> fe_2d_flat()
{
  std::vector<Check> checks;
  const std::vector<SeriesPoint> thin{{4 * um, 135.1 * N_per_mm, 0.125 * mm},
                                      {8 * um, 291.4 * N_per_mm, 0.183 * mm},
                                      {20 * um, 814.1 * N_per_mm, 0.307 * mm}};
  const std::vector<SeriesPoint> thick{
      {4 * um, 124.5 * N_per_mm, 0}, {8 * um, 266.7 * N_per_mm, 0}, {20 * um, 737.1 * N_per_mm, 0}};
  check_series(checks, "t 12 mm", {0, 12 * mm, 48 * mm}, thin, 0.01);
  check_series(checks, "t 25 mm", {0, 25 * mm, 100 * mm}, thick, 0.01);
  // How much of the distance is the width, which the series does not say.
  for (const auto &[depth, point] : {std::pair(12 * mm, thin[1]), std::pair(25 * mm, thick[1])})
    checks.push_back(
        reported(fmt::format("line load P, t {:g} mm, d 8 um, 20 mm to each side", depth / mm), "N/mm",
                 RollerSection({0, depth, 20 * mm}, 0.12 * mm, 0.31 * mm).at(point.approach).q / N_per_mm,
                 point.q / N_per_mm));
  return checks;
}

std::vector<Check> fe_2d_races()
{
  std::vector<Check> checks;
  check_series(checks, "inner race R 144.8 mm", {144.8 * mm, 12 * mm, 48 * mm},
               {{8 * um, 289.0 * N_per_mm, 0.176 * mm}}, 0.01);
  check_series(checks, "outer race R 166.3 mm", {-166.3 * mm, 12 * mm, 48 * mm},
               {{8 * um, 293.6 * N_per_mm, 0.190 * mm}}, 0.01);
  return checks;
}

std::vector<Check> fe_mesh_order()
{
  const double b = half_width(0, 291.4 * N_per_mm);  // at 8 um
  const std::vector<double> ratios{1.6, 0.8, 0.5, 0.25, 0.125};
  // A node that has just joined and one about to join differ by the whole error of the mesh: rms over approaches
  // that carry the edge across an element and more.
  const VectorXd approaches = VectorXd::LinSpaced(12, 6 * um, 11 * um);
  Slab finest(0.05 * b);
  VectorXd reference(approaches.size());
  for (Index i = 0; i < approaches.size(); ++i)
    reference[i] = finest.line_load(approaches[i]);
  std::vector<Check> checks;
  VectorXd log_h(Index(ratios.size())), log_error(log_h.size());
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    Slab slab(ratios[k] * b);
    double sum = 0;
    for (Index i = 0; i < approaches.size(); ++i)
      sum += std::pow(slab.line_load(approaches[i]) / reference[i] - 1, 2);
    const double error  = std::sqrt(sum / double(approaches.size()));
    log_h[Index(k)]     = std::log(ratios[k]);
    log_error[Index(k)] = std::log(error);
    checks.push_back({fmt::format("error of the load, rms, h/b {:g}", ratios[k]), "%", 100 * error, 0.3, 0,
                      ratios[k] > 0.5 ? Judged::reported : Judged::at_most});
  }
  const VectorXd dx = log_h.array() - log_h.mean(), dy = log_error.array() - log_error.mean();
  checks.push_back({"observed order in h", "-", dx.dot(dy) / dx.dot(dx), 1.5, 0, Judged::at_least});
  checks.push_back(
      relative("line load at 8 um, h/b 0.05", "N/mm", finest.line_load(8 * um) / N_per_mm, 291.4, 0.003));
  return checks;
}
}  // namespace mill::verify
