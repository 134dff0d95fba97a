// The library's half of bench/compare-calculix: meshes a pair of rolls, solves a list of loads with the condensed
// rolls, writes mesh and loads as a CalculiX deck, and prints results and timings as one JSON object.
//
// The pair: R 200 mm on R 650 mm, steel, half length 700 mm, a quarter of each section.  The barrel ends are held
// in z like the mid-plane, so the state is plane strain at every station and the closed form of two cylinders
// (theory.md 3) is exact, not only far from the ends; the model stays three-dimensional.
//     x = 0          u_x = 0                      z = 0 and z = 700 mm   u_z = 0
//     lower, y = 0   u_y = 0                      upper, y = 0           u_y = -approach
// The upper roll is the mesh of the smaller one, mirrored.  Units of the deck: mm, N, MPa.
#include "core/base/errors.h"
#include "core/numerics/sparse.h"
#include "core/process/parallel.h"
#include "fem/body/elastic_body.h"
#include "fem/roll/contact_study.h"
#include "meshes/gmsh/gmsh_scope.h"
#include "meshes/roll/contact_mesh_size.h"
#include "reduce/chain/line_contact.h"
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <gmsh.h>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

using namespace mill;

namespace {
struct Settings {
  std::string folder       = ".";     // where the meshes and pair.inp go
  std::string element      = "C3D8";  // of CalculiX: the library's trilinear one; C3D20R gets nodes on its edges
  double contact_stiffness = 50;     // of CalculiX, over Young's modulus, 1/mm; 50 is its default for hard contact
  int layers               = 28;     // along half the barrel
  int per_half_width       = 8;      // elements over the half width of the contact
  int sectors              = 3;      // elements along the far quarter of the circle
  double far_growth        = 1.5;    // ratio of neighbouring elements outside the fine box
  int loads                = 1;      // of the curve
  double lowest            = 200e3;  // N/m
  double highest           = 1000e3;  // N/m
  int degree               = 1;       // of the library's elements
  int threads              = 2;
};

constexpr double half_length = 0.7, small_radius = 0.2, large_radius = 0.65;  // m
const Material steel{210e9, 0.3, 7850};

reduce::LineContact closed_form(const double q)
{
  return reduce::line_contact({2 * small_radius, 2 * large_radius, 1, steel}, q);
}

// ---- The two meshes.

struct PairMesh {
  RollGeometry small, large;
  MeshFile upper, lower;
};

PairMesh mesh_pair(const Settings &set)
{
  auto size = meshes::slab_contact_size(closed_form(set.lowest).half_width, closed_form(set.highest).half_width,
                                        set.per_half_width);
  // A hair thicker than they end up, so that rounding cannot ask for one layer more.
  size.end_layer = size.largest_layer = half_length / set.layers * (1 + 1e-9);
  size.section.sector_elements        = set.sectors;
  size.section.far_growth             = set.far_growth;
  PairMesh mesh;
  mesh.small.radius      = small_radius;
  mesh.large.radius      = large_radius;
  mesh.small.half_length = mesh.large.half_length = half_length;
  mesh.upper = meshes::mesh_roll("upper roll", mesh.small, size, set.folder + "/upper.msh");
  mesh.lower = meshes::mesh_roll("lower roll", mesh.large, size, set.folder + "/lower.msh");
  return mesh;
}

// A mesh as Gmsh wrote it, with what the deck needs of it.
struct DeckMesh {
  std::vector<std::array<double, 3>> nodes;  // m
  std::vector<std::vector<int>> elements;    // positions in nodes, 8 or 20 each
  std::map<std::string, std::vector<int>> groups;
  std::vector<std::array<int, 2>> contact_faces;  // element, face 1..6
};

// Faces of a hexahedron in the numbering of CalculiX, S1 to S6; the order of the corners does not matter here.
constexpr int faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 4, 5}, {1, 2, 5, 6}, {2, 3, 6, 7}, {3, 0, 7, 4}};

DeckMesh read_mesh(const MeshFile &file)
{
  const std::lock_guard alone(rand_access());
  const meshes::GmshScope gmsh_is_open;
  gmsh::open(file.path);
  DeckMesh mesh;
  std::vector<std::size_t> tags, element_tags, corners;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::map<std::size_t, int> place;
  for (std::size_t i = 0; i < tags.size(); ++i)
    if (place.emplace(tags[i], int(mesh.nodes.size())).second)
      mesh.nodes.push_back({file.unit * coordinates[3 * i], file.unit * coordinates[3 * i + 1],
                            file.unit * coordinates[3 * i + 2]});
  gmsh::model::mesh::getElementsByType(gmsh::model::mesh::getElementType("hexahedron", 1), element_tags, corners);
  mesh.elements.assign(element_tags.size(), std::vector<int>(8));
  for (std::size_t i = 0; i < corners.size(); ++i)
    mesh.elements[i / 8][i % 8] = place.at(corners[i]);
  for (const auto &[name, id] : file.groups) {
    gmsh::model::mesh::getNodesForPhysicalGroup(2, id, tags, coordinates);
    for (const std::size_t tag : tags)
      mesh.groups[name].push_back(place.at(tag));
  }
  std::vector<char> touches(mesh.nodes.size(), 0);
  for (const int node : mesh.groups.at("contact"))
    touches[node] = 1;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (int f = 0; f < 6; ++f)
      if (std::all_of(faces[f], faces[f] + 4, [&](const int k) { return touches[mesh.elements[e][k]]; }))
        mesh.contact_faces.push_back({int(e), f + 1});
  return mesh;
}

// Twenty-node elements: a node in the middle of every edge, on the true circle where both ends are.
void add_edge_nodes(DeckMesh &mesh, const double radius)
{
  constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  const auto on_circle       = [&](const std::array<double, 3> &p) {
    return std::abs(std::hypot(p[0], p[1]) - radius) < 1e-9 * radius;
  };
  std::map<std::pair<int, int>, int> middle;
  for (auto &element : mesh.elements)
    for (const auto &[a, b] : edges) {
      const std::pair<int, int> ends = std::minmax(element[a], element[b]);
      const auto [entry, added]      = middle.emplace(ends, int(mesh.nodes.size()));
      element.push_back(entry->second);
      if (!added)
        continue;
      const auto &p = mesh.nodes[ends.first], &q = mesh.nodes[ends.second];
      std::array<double, 3> m{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
      if (on_circle(p) && on_circle(q)) {
        const double out = radius / std::hypot(m[0], m[1]);
        m                = {out * m[0], out * m[1], m[2]};
      }
      mesh.nodes.push_back(m);
    }
  for (auto &[name, nodes] : mesh.groups) {
    const std::set<int> members(nodes.begin(), nodes.end());
    for (const auto &[ends, node] : middle)
      if (members.count(ends.first) && members.count(ends.second))
        nodes.push_back(node);
  }
}

// Mirrored at y = 0 and moved up.  Bottom and top of each element change places so that it keeps its orientation;
// so do its faces S1 and S2, while the four sides keep their numbers.
DeckMesh mirrored(DeckMesh mesh, const double rise)
{
  for (auto &p : mesh.nodes)
    p[1] = rise - p[1];
  for (auto &e : mesh.elements) {
    std::rotate(e.begin(), e.begin() + 4, e.begin() + 8);
    if (e.size() == 20)  // nodes on the edges of the bottom and of the top; the upright edges stay
      std::rotate(e.begin() + 8, e.begin() + 12, e.begin() + 16);
  }
  for (auto &face : mesh.contact_faces)
    face[1] = face[1] <= 2 ? 3 - face[1] : face[1];
  return mesh;
}

// ---- The deck.

class Deck {
public:
  explicit Deck(const std::string &path) : out(std::fopen(path.c_str(), "w"))
  {
    if (!out)
      throw InputError({path, 0, 0}, "the deck cannot be written");
  }
  ~Deck()
  {
    std::fclose(out);
  }
  Deck(const Deck &)            = delete;
  Deck &operator=(const Deck &) = delete;

  template <class... Values> void line(const char *format, const Values... values)
  {
    std::fprintf(out, format, values...);
    std::fputc('\n', out);
  }

  // Nodes, elements, one node set per group (its name without the dot) and the contact surface of a roll.
  void body(const DeckMesh &mesh, const std::string &name, const std::string &element)
  {
    line("*NODE, NSET=N%s", name.c_str());
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      line("%d,%.12e,%.12e,%.12e", first_node + int(i), 1e3 * mesh.nodes[i][0], 1e3 * mesh.nodes[i][1],
           1e3 * mesh.nodes[i][2]);
    line("*ELEMENT, TYPE=%s, ELSET=E%s", element.c_str(), name.c_str());
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      std::fprintf(out, "%d", first_element + int(e));
      for (std::size_t k = 0; k < mesh.elements[e].size(); ++k)
        std::fprintf(out, k == 14 ? ",\n%d" : ",%d", first_node + mesh.elements[e][k]);  // 16 entries a line
      std::fputc('\n', out);
    }
    for (const auto &[group, nodes] : mesh.groups) {
      std::string plain = group;
      plain.erase(std::remove(plain.begin(), plain.end(), '.'), plain.end());
      line("*NSET, NSET=%s%s", name.c_str(), plain.c_str());
      for (const int node : nodes)
        line("%d,", first_node + node);
    }
    line("*SURFACE, NAME=%sSURFACE, TYPE=ELEMENT", name.c_str());
    for (const auto &[place, face] : mesh.contact_faces)
      line("%d,S%d", first_element + place, face);
    first_node += int(mesh.nodes.size());
    first_element += int(mesh.elements.size());
  }

private:
  std::FILE *out;
  int first_node = 1, first_element = 1;
};

void write_deck(const Settings &set, const DeckMesh &lower, const DeckMesh &upper, const Eigen::VectorXd &approach)
{
  Deck deck(set.folder + "/pair.inp");
  deck.line("** Two rolls, plane strain between held ends; mm, N, MPa.  Generated by tests/bench/calculix_deck.");
  deck.body(lower, "LOWER", set.element);
  deck.body(upper, "UPPER", set.element);
  deck.line("*MATERIAL, NAME=STEEL\n*ELASTIC\n%.10e,%.10e", steel.youngs_modulus / 1e6, steel.poisson_ratio);
  deck.line("*SOLID SECTION, ELSET=ELOWER, MATERIAL=STEEL\n*SOLID SECTION, ELSET=EUPPER, MATERIAL=STEEL");
  deck.line("*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n%.10e",
            set.contact_stiffness * steel.youngs_modulus / 1e6);
  deck.line("*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\nUPPERSURFACE,LOWERSURFACE");
  deck.line("*BOUNDARY");
  for (const char *name : {"LOWER", "UPPER"})
    deck.line("%ssymmetryx,1,1\n%ssymmetryz,3,3\n%send,3,3", name, name, name);
  deck.line("LOWERsymmetryy,2,2");
  for (const double a : approach) {
    deck.line("*STEP, INC=200\n*STATIC\n1.,1.");
    deck.line("*BOUNDARY\nUPPERsymmetryy,2,2,%.12e", -1e3 * a);
    // Into the result file, which is complete after every step; the printed one is not when ccx is stopped.
    deck.line("*NODE FILE, NSET=UPPERsymmetryy, FREQUENCY=10000\nRF");
    deck.line("*CONTACT FILE, FREQUENCY=10000\nCSTR");
    deck.line("*END STEP");
  }
}

// ---- The library's solution.

struct Stopwatch {
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  std::clock_t cpu                           = std::clock();
  // Seconds since the last lap; those of the processor are of all threads together.
  nlohmann::json lap()
  {
    const Stopwatch now;
    const nlohmann::json out{{"wall", std::chrono::duration<double>(now.wall - wall).count()},
                             {"cpu", double(now.cpu - cpu) / CLOCKS_PER_SEC}};
    *this = now;
    return out;
  }
};

std::vector<double> listed(const Eigen::VectorXd &values, const double factor)
{
  const Eigen::VectorXd scaled = factor * values;
  return {scaled.data(), scaled.data() + scaled.size()};
}

// Pressures (mm, MPa) over the half width at the station next to mid-length.
void add_profile(const fem::PatchGrid &grid, const fem::ContactPoint &point, nlohmann::json &out)
{
  const int station = grid.n_z / 2;
  out["station"]    = 1e3 * grid.z[station];
  for (int i = 0; i < grid.n_x; ++i) {
    const int node = station * grid.n_x + i;
    out["profile"].push_back({1e3 * grid.x[i], 1e-6 * point.state.nodal[node] / grid.area[node]});
  }
}

// Solves the loads; the first alone and once more with the others.  Returns the curve, adds results and times.
ContactCurve solve(const Settings &set, const PairMesh &mesh, const Eigen::VectorXd &loads, nlohmann::json &out)
{
  fem::CondenseOptions options;
  options.slab = true;
  Stopwatch watch;
  const fem::ElasticBody upper_body(mesh.upper, steel, set.degree), lower_body(mesh.lower, steel, set.degree);
  upper_body.stiffness();
  lower_body.stiffness();
  out["timing"]["read and assemble"] = watch.lap();
  const fem::CondensedRoll upper     = fem::condense(upper_body, mesh.small, options),
                           lower     = fem::condense(lower_body, mesh.large, options);
  out["timing"]["condense"]          = watch.lap();
  const auto pair  = fem::make_pair("line", upper, fem::held_by_mirror(upper), lower, fem::held_by_mirror(lower),
                                    Eigen::VectorXd::Zero(upper.grid.n_z));
  const auto first = fem::solve_load(pair, loads[0]);
  out["timing"]["first load"] = watch.lap();
  const ContactCurve curve    = fem::sweep(pair, loads);
  out["timing"]["curve"]      = watch.lap();

  out["unknowns"]         = upper.n_unknowns + lower.n_unknowns;
  out["retained"]         = upper.grid.n_x * upper.grid.n_z;
  out["approach"]         = listed(curve.approach, 1e3);
  out["tangent"]          = listed(curve.tangent, 1e-6);
  out["iterations"]       = std::vector<int>(curve.iterations.begin(), curve.iterations.end());
  out["first iterations"] = first.state.iterations;
  add_profile(upper.grid, first, out);
  return curve;
}

nlohmann::json compare(const Settings &set)
{
  set_blas_threads(set.threads);
  fem::set_assembly_threads(set.threads);
  // The curve starts at the largest load, so that its first solve is the single load of the comparison.
  const Eigen::VectorXd loads =
      set.loads == 1 ? Eigen::VectorXd::Constant(1, set.highest)
                     : Eigen::VectorXd(fem::log_spaced(set.lowest, set.highest, set.loads).reverse());
  nlohmann::json out{{"blas", blas_in_use()}, {"layers", set.layers}, {"load", listed(loads, 1e-3)}};
  for (const double q : loads) {
    const auto c = closed_form(q);
    out["closed"].push_back({{"half width", 1e3 * c.half_width},
                             {"peak pressure", 1e-6 * c.peak_pressure},
                             {"approach", 1e3 * c.approach},
                             {"tangent", 1e-6 * c.tangent}});
  }
  const PairMesh mesh      = mesh_pair(set);
  const ContactCurve curve = solve(set, mesh, loads, out);
  DeckMesh upper = read_mesh(mesh.upper), lower = read_mesh(mesh.lower);
  if (set.element.rfind("C3D20", 0) == 0) {
    add_edge_nodes(upper, small_radius);
    add_edge_nodes(lower, large_radius);
  }
  write_deck(set, lower, mirrored(upper, small_radius + large_radius), curve.approach);
  out["elements"] = upper.elements.size() + lower.elements.size();
  return out;
}

Settings read_arguments(const int n, char **argument)
{
  Settings set;
  const std::map<std::string, std::function<void(const std::string &)>> known{
      {"--folder", [&](const std::string &v) { set.folder = v; }},
      {"--element", [&](const std::string &v) { set.element = v; }},
      {"--contact-stiffness", [&](const std::string &v) { set.contact_stiffness = std::stod(v); }},
      {"--layers", [&](const std::string &v) { set.layers = std::stoi(v); }},
      {"--per-half-width", [&](const std::string &v) { set.per_half_width = std::stoi(v); }},
      {"--sectors", [&](const std::string &v) { set.sectors = std::stoi(v); }},
      {"--far-growth", [&](const std::string &v) { set.far_growth = std::stod(v); }},
      {"--loads", [&](const std::string &v) { set.loads = std::stoi(v); }},
      {"--lowest", [&](const std::string &v) { set.lowest = 1e3 * std::stod(v); }},    // N/mm
      {"--highest", [&](const std::string &v) { set.highest = 1e3 * std::stod(v); }},  // N/mm
      {"--degree", [&](const std::string &v) { set.degree = std::stoi(v); }},
      {"--threads", [&](const std::string &v) { set.threads = std::stoi(v); }}};
  for (int i = 1; i < n; i += 2) {
    const auto option = known.find(argument[i]);
    if (option == known.end() || i + 1 == n)
      throw InputError({"calculix_deck", 0, 0}, std::string("unknown option or missing value: ") + argument[i]);
    option->second(argument[i + 1]);
  }
  return set;
}
}  // namespace

int main(const int n, char **argument)
{
  try {
    std::puts(compare(read_arguments(n, argument)).dump(1).c_str());
  } catch (const std::exception &e) {
    std::fprintf(stderr, "calculix_deck: %s\n", e.what());
    return 1;
  }
}
