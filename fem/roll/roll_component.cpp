#include "fem/roll/roll_component.h"
#include "fem/roll/condensed_roll.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace mill::fem {
namespace {
constexpr int along_y = 1;

// P_0, P_2, .. of s by Bonnet's recursion.
double even_legendre(const int j, const double s)
{
  double previous = 1, current = s;
  if (j == 0)
    return 1;
  for (int n = 1; n < 2 * j; ++n) {
    const double next = ((2 * n + 1) * s * current - n * previous) / (n + 1);
    previous          = current;
    current           = next;
  }
  return current;
}

// Window of the bearing seat, as in condensed_roll.
double seat_window(const RollGeometry &g, const double z)
{
  const double width = std::min(0.5 * g.neck_length, g.half_length + g.neck_length - g.seat_centre);
  const double s     = (z - g.seat_centre) / width;
  return z > g.half_length && std::abs(s) < 1 ? std::pow(std::cos(0.5 * M_PI * s), 2) : 0;
}

// Nodal weights of a mean along y as a functional on the body's unknowns.
Eigen::VectorXd along(const Eigen::VectorXd &nodal)
{
  Eigen::VectorXd w = Eigen::VectorXd::Zero(3 * nodal.size());
  for (Eigen::Index n = 0; n < nodal.size(); ++n)
    w[3 * n + along_y] = nodal[n];
  return w;
}

// Ends and middles of the layers, from mid-length to the end; coordinates of one agree to rounding.
std::vector<double> stations(const ElasticBody &body, const RollGeometry &g)
{
  const auto z = body.nodes().col(2);
  std::vector<double> sorted(z.data(), z.data() + z.size()), out;
  std::sort(sorted.begin(), sorted.end());
  for (const double v : sorted)
    if (out.empty() || v - out.back() > 1e-6 * g.radius)
      out.push_back(v);
  return out;
}
}  // namespace

PartSupport roll_support(const ElasticBody &body)
{
  PartSupport s;
  s.held             = constrained_unknowns(body, {false, false}, false);
  const auto n_nodes = body.nodes().rows();
  s.rigid            = along(Eigen::VectorXd::Ones(n_nodes));
  s.rigid_names      = {"along y"};
  s.copies           = 8;
  return s;
}

PartInterface roll_interface(const ElasticBody &body, const RollGeometry &g, const int n_barrel)
{
  PartInterface out;
  const bool neck = g.neck_length > 0;
  out.weights.resize(3 * body.nodes().rows(), n_barrel + neck);
  const double volume = body.volume_load([&](const Eigen::Vector3d &x) { return x[2] < g.half_length; }).sum();
  for (int j = 0; j < n_barrel; ++j) {  // (21.13)
    const Eigen::VectorXd w = body.volume_load([&](const Eigen::Vector3d &x) {
      return x[2] < g.half_length ? even_legendre(j, x[2] / g.half_length) : 0;
    });
    out.weights.col(j)      = along((4 * j + 1) / volume * w);
    out.names.push_back("barrel P" + std::to_string(2 * j));
  }
  if (neck) {  // (21.14)
    const Eigen::VectorXd w   = body.volume_load([&](const Eigen::Vector3d &x) { return seat_window(g, x[2]); });
    out.weights.col(n_barrel) = along(w / w.sum());
    out.names.push_back("seat");
  }
  return out;
}

SectionMeans section_means(const ElasticBody &body, const RollGeometry &g)
{
  // Through one layer the section's mean is a parabola in z, since the mesh is extruded.  The weights below, put
  // over the volume of the layer, give the value of any parabola at its lower end, its middle and its upper end.
  const std::array<std::function<double(double)>, 3> dual{
      [](const double s) { return 9 - 36 * s + 30 * s * s; },
      [](const double s) { return 2.25 - 15 * (s - 0.5) * (s - 0.5); },
      [](const double s) { return 3 - 24 * s + 30 * s * s; },
  };
  const std::vector<double> z = stations(body, g);
  SectionMeans out;
  out.z = Eigen::Map<const Eigen::VectorXd>(z.data(), Eigen::Index(z.size()));
  out.rows.resize(3 * body.nodes().rows(), out.z.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    // A station between two layers is read from the one nearer to mid-length: at the barrel's end, the barrel.
    const std::size_t place = i == 0 ? 0 : i % 2 == 1 ? 1 : 2, low = i - place;
    const double from = z[low], to = z[low + 2];
    const auto inside       = [&](const Eigen::Vector3d &x) { return x[2] > from && x[2] < to; };
    const Eigen::VectorXd w = body.volume_load(
        [&](const Eigen::Vector3d &x) { return inside(x) ? dual[place]((x[2] - from) / (to - from)) : 0; });
    out.rows.col(Eigen::Index(i)) = along(w / w.sum());
  }
  return out;
}

double roll_reach(const ElasticBody &body, const RollGeometry &g, const Material &material)
{
  const auto &p               = body.nodes();
  const double small          = 1e-6 * g.radius;
  const std::vector<double> z = stations(body, g);
  double barrel = 0, neck = 0;
  for (std::size_t i = 0; i + 2 < z.size(); i += 2) {
    double &longest = z[i] < g.half_length - small ? barrel : neck;
    longest         = std::max(longest, z[i + 2] - z[i]);
  }
  double reach = mesh_reach(barrel, g.radius, material);
  if (neck > 0)
    reach = std::min(reach, mesh_reach(neck, g.neck_radius, material));
  // Across the section waves are those of shear, of a bar without end to its thickness.
  double widest = 0;
  body.each_cell([&](const std::vector<int> &nodes, const std::vector<SolidPoint> &) {
    for (std::size_t a = 0; a < 8; ++a)  // the corners come first; an edge of the section joins two of them
      for (const std::size_t bit : {1u, 2u})
        if (!(a & bit))
          widest = std::max(widest, (p.row(nodes[a]) - p.row(nodes[a | bit])).norm());
  });
  return std::min(reach, mesh_reach(widest, 1e3 * widest, material));
}

namespace {
// The outside of the eighth: corners of the faces of every group that is not a plane of symmetry.
ComponentSurface outside(const ElasticBody &body, const bool neck, const ComponentBasis &basis)
{
  ComponentSurface out;
  std::map<int, int> number;  // of a node among the points
  std::vector<int> nodes;
  std::vector<std::array<int, 4>> faces;
  for (const std::string &group : neck ? std::vector<std::string>{"contact", "barrel", "shoulder", "neck", "end"}
                                       : std::vector<std::string>{"contact", "barrel", "end"}) {
    const Surface s  = body.surface(group);
    const auto &f    = s.faces;
    const int across = f.cols() == 9 ? 3 : 2;  // nodes along a side, first parameter fastest
    for (Eigen::Index i = 0; i < f.rows(); ++i) {
      std::array<int, 4> face{};
      int c = 0;
      for (const int corner : {0, across - 1, across * across - 1, across * (across - 1)}) {
        const int node         = s.node[std::size_t(f(i, corner))];
        const auto [at, fresh] = number.try_emplace(node, int(nodes.size()));
        if (fresh)
          nodes.push_back(node);
        face[std::size_t(c++)] = at->second;
      }
      faces.push_back(face);
    }
  }
  Eigen::MatrixXd coordinates(basis.constraint.rows(), basis.constraint.cols() + basis.modes.cols());
  coordinates << basis.constraint, basis.modes;
  const Eigen::MatrixXd stress = body.nodal_stress(coordinates);
  const Eigen::Index n = Eigen::Index(nodes.size()), k = coordinates.cols();
  out.position.resize(n, 3);
  out.displacement.resize(3 * n, k);
  out.stress.resize(6 * n, k);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node               = nodes[std::size_t(i)];
    out.position.row(i)                   = body.nodes().row(node);
    out.displacement.middleRows(3 * i, 3) = coordinates.middleRows(3 * node, 3);
    out.stress.middleRows(6 * i, 6)       = stress.middleRows(6 * node, 6);
  }
  out.faces.resize(Eigen::Index(faces.size()), 4);
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (int c = 0; c < 4; ++c)
      out.faces(Eigen::Index(i), c) = faces[i][std::size_t(c)];
  return out;
}
}  // namespace

RollComponent roll_component(const std::string &name, const ElasticBody &body, const RollGeometry &g,
                             const Material &material, const RollComponentOptions &options, ComponentBasis *basis)
{
  const PartModel part(name, body, roll_support(body));
  const PartInterface interface = roll_interface(body, g, options.n_barrel);
  ModeChoice choice;
  choice.n_modes         = options.n_modes;
  choice.frequency_limit = options.frequency_limit;
  choice.reach           = roll_reach(body, g, material);
  ComponentBasis own_basis;
  ComponentBasis &fields = basis ? *basis : own_basis;
  RollComponent out;
  Component &c = out.component = component_modes(part, interface, choice, &fields);
  c.n_barrel                   = options.n_barrel;
  c.half_barrel                = g.half_length;
  const SectionMeans means     = section_means(body, g);
  c.axis_z                     = means.z;
  c.axis.resize(means.z.size(), c.M.rows());
  c.axis << means.rows.transpose() * fields.constraint, means.rows.transpose() * fields.modes;
  if (options.surface)
    c.surface = outside(body, g.neck_length > 0, fields);
  out.mesh_mass = c.mass;
  c.mass        = 2 * M_PI * material.density *
           (g.half_length * g.radius * g.radius + g.neck_length * g.neck_radius * g.neck_radius);
  out.n_unknowns   = part.n_unknowns();
  out.factor_bytes = part.factor_bytes();
  return out;
}
}  // namespace mill::fem
