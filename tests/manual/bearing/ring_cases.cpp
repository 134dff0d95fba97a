#include "fem/bearing/chock_flexibility.h"
#include "fem/bearing/ring_flexibility.h"
#include "fem/body/harmonic_body.h"
#include "meshes/bearing/bearing_rings.h"
#include "meshes/bearing/chock.h"
#include "meshes/common/block.h"
#include "reduce/bearing/assembly.h"
#include "reduce/bearing/rigid_rings.h"
#include "reduce/bearing/ring_sections.h"
#include "tests/manual/bearing/bearing_models.h"
#include "tests/manual/check/units.h"
#include "tests/manual/check/verification.h"
#include "tests/manual/contact/annulus.h"
#include "tests/manual/contact/meshed.h"
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace mill::verify {
namespace {
const Material ring_steel{206e9, 0.3, 7850};

// The four-row bearing of the demo stand and a chock around it.
RollerBearing mill_bearing(const ChockForm chock)
{
  RollerBearing b       = bearing_266(19.66);
  b.chock               = chock;
  b.chock_width         = 600 * mm;
  b.chock_height        = 560 * mm;
  b.chock_length        = 260 * mm;
  b.chock_support_width = 300 * mm;
  return b;
}

// Meshes of one bearing in the scratch folder, removed at the end of the scope.
struct ScratchRings {
  ScratchRings(const RingSections &sections, const meshes::RingMeshSize &size, const std::string &name)
      : meshes(meshes::mesh_rings(sections, size, std::filesystem::temp_directory_path().string(),
                                  "millstand-verify-" + std::to_string(::getpid()) + "-" + name))
  {
  }
  ~ScratchRings()
  {
    meshes::remove_meshes(meshes);
  }
  ScratchRings(const ScratchRings &) = delete;
  RingMeshes meshes;
};

// ---- ring-harmonics, ring-on-rigid-back -----------------------------------------------------------------------

std::vector<Check> ring_harmonics()
{
  std::vector<Check> checks;
  const Annulus thick{100 * mm, 150 * mm, false};
  const AnnulusByElements by_elements(thick, ring_steel, 24);
  for (const int m : {0, 2, 3, 8, 20})
    checks.push_back(relative("inner displacement, harmonic " + std::to_string(m), "nm/MPa",
                              1e15 * by_elements.displacement(m), 1e15 * inner_displacement(thick, m, ring_steel),
                              1e-5));
  // A ring bent without stretching: p R^4 / (E' I (m^2 - 1)^2), its pressure taken at the mean radius.
  const Annulus thin{99 * mm, 101 * mm, false};
  const double R = 100 * mm, t = 2 * mm,
               E    = ring_steel.youngs_modulus / (1 - std::pow(ring_steel.poisson_ratio, 2));
  const double bent = thin.a / R * std::pow(R, 4) / (E * std::pow(t, 3) / 12 * 9);
  checks.push_back(relative("thin ring, harmonic 2", "um/MPa",
                            1e12 * AnnulusByElements(thin, ring_steel, 4).displacement(2), 1e12 * bent, 2e-2));
  return checks;
}

std::vector<Check> ring_on_rigid_back()
{
  std::vector<Check> checks;
  const Annulus cup{165.8 * mm, 178.6 * mm, true};
  const AnnulusByElements by_elements(cup, ring_steel, 10);
  for (const int m : {0, 2, 10, 40})
    checks.push_back(relative("inner displacement, harmonic " + std::to_string(m), "nm/MPa",
                              1e15 * by_elements.displacement(m), 1e15 * inner_displacement(cup, m, ring_steel),
                              1e-4));
  const int m         = 150;
  const double half   = 2 * (1 - std::pow(ring_steel.poisson_ratio, 2)) / ring_steel.youngs_modulus * cup.a / m;
  const double answer = by_elements.displacement(m);
  checks.push_back(relative("harmonic 150 against the half space", "nm/MPa", 1e15 * answer, 1e15 * half, 1e-2));

  const RingSections sections = bearing::ring_sections(mill_bearing(ChockForm::round));
  const ScratchRings scratch(sections, {1, 1}, "decay");
  fem::RingOptions options;
  options.last_harmonic = 60;
  const auto rings      = fem::ring_flexibility(sections, scratch.meshes, nullptr, options).flexibility;
  for (const auto *side : {&rings.inner, &rings.outer}) {
    double sum = 0;
    for (const Eigen::MatrixXd &harmonic : *side)
      sum += harmonic(0, 0);
    const std::string name = side == &rings.inner ? "cone on neck" : "cup in housing";
    checks.push_back(at_most(name + ": harmonic 60 less rigid back, of the sum", "-",
                             std::abs(side->back()(0, 0)) / sum, 1e-4));
  }
  return checks;
}

// ---- neck-inertia-relief --------------------------------------------------------------------------------------

std::vector<Check> neck_inertia_relief()
{
  // A plain solid cylinder under a line load over its whole length: the cone without its raceways.
  const double radius = 130 * mm, length = 200 * mm;
  const ScratchFile file("neck");
  meshes::BlockGrid grid;
  grid.x              = meshes::even_lines(0, radius, 3);
  grid.y              = meshes::even_lines(-0.5 * length, 0.5 * length, 4);
  MeshFile mesh       = meshes::mesh_block(grid, file.path);
  const int axis      = mesh.groups.at("left");
  mesh.groups["axis"] = axis;
  const fem::SectionBody body(mesh, ring_steel, 2, fem::Section::axisymmetric);
  const fem::HarmonicBody neck(body);
  RacewayLine line;
  line.middle                = {radius, 0};
  line.normal                = {1, 0};
  line.along                 = {0, 1};
  const Eigen::MatrixXd load = fem::raceway_loads(body, "right", line, length, 3, -1);
  const Eigen::MatrixXd even = neck.flexibility(0, load), across = neck.flexibility(1, load);
  const double closed = (1 - ring_steel.poisson_ratio) / (2 * M_PI * ring_steel.youngs_modulus * length);

  // Body forces along the rigid motions balance themselves; between them and the load nothing may pass either.
  double rigid = 0;
  for (const int m : {0, 1}) {
    const Eigen::MatrixXd R = neck.rigid_motions(m);
    Eigen::MatrixXd loads(R.rows(), R.cols() + 1);
    loads << R, load.col(0);
    for (Eigen::Index n = 0; n < neck.volumes().size(); ++n)
      loads.block(3 * n, 0, 3, R.cols()) *= neck.volumes()[n] / body.measure();
    for (Eigen::Index k = 1; k < R.cols(); ++k)
      loads.col(k) /= radius;
    const Eigen::MatrixXd C = neck.flexibility(m, loads);
    rigid = std::max(rigid, C.topRows(R.cols()).cwiseAbs().maxCoeff() / C(C.rows() - 1, C.cols() - 1));
  }
  return {relative("even load all around", "nm/kN", 1e12 * even(0, 0), 1e12 * closed, 1e-9),
          relative("load across, cos(theta)", "nm/kN", 1e12 * across(0, 0), 1e12 * closed, 1e-9),
          at_most("response to rigid body forces / to the load", "-", rigid, 1e-9),
          at_most("even load tilts the neck / moves it", "-", std::abs(across(0, 1)) / across(0, 0), 1e-9)};
}

// ---- chock-round ----------------------------------------------------------------------------------------------

std::vector<Check> chock_round()
{
  const RingSections sections = bearing::ring_sections(mill_bearing(ChockForm::round));
  const RingSection &cup      = sections.cup;
  const int n = 8, modes = 3, size = 4 * modes;
  const ScratchRings fine(sections, {1, 1}, "round");
  RingSections as_block = sections;  // for the section on the block's mesh lines
  as_block.housing.kind = ChockForm::block;
  const ScratchRings coarse(as_block, {0.5, 1}, "lines");
  const ScratchFile file("round-block");
  const MeshFile block = meshes::mesh_chock(cup, sections.housing, 1, file.path);
  const auto solid = fem::chock_flexibility(cup, block, meshes::mirrored_rows(cup), sections.material, n, modes);

  const auto by_section = [&](const MeshFile &mesh) {
    const fem::SectionBody body(mesh, sections.material, 2, fem::Section::axisymmetric);
    const fem::HarmonicBody harmonic(body);
    Eigen::MatrixXd loads(harmonic.n_unknowns(), size);
    for (int r = 0; r < 4; ++r)
      loads.middleCols(r * modes, modes) = fem::raceway_loads(body, "raceway." + std::to_string(r),
                                                              cup.raceways[std::size_t(r)], cup.length, modes, 1);
    std::vector<Eigen::MatrixXd> out;
    for (int m = 0; m < n; ++m)
      out.push_back(harmonic.flexibility(m, loads));
    return out;
  };
  const auto exact = by_section(fine.meshes.cup), same_lines = by_section(coarse.meshes.chock_section);
  std::vector<Check> checks;
  double mixed = 0;
  for (int m = 0; m < n; ++m) {
    const auto cosine = [&](const int k) { return solid.cosine.block(m * size, k * size, size, size); };
    const Eigen::MatrixXd &reference = exact[std::size_t(m)];
    const std::string name           = "harmonic " + std::to_string(m);
    const Eigen::MatrixXd &lines     = same_lines[std::size_t(m)];
    if (m == 2)
      checks.push_back(relative(name + ", outer row, even load, block alone", "nm/kN", 1e12 * cosine(m)(0, 0),
                                1e12 * reference(0, 0), 1e-2));
    checks.push_back(relative(name + ", outer row, even load", "nm/kN",
                              1e12 * (cosine(m) + reference - lines)(0, 0), 1e12 * reference(0, 0), 1e-2));
    const auto corrected = [&](const Eigen::MatrixXd &C) { return (C - lines).norm() / reference.norm(); };
    double worst         = corrected(cosine(m));
    if (m > 0)
      worst = std::max(worst, corrected(solid.sine.block((m - 1) * size, (m - 1) * size, size, size)));
    checks.push_back(at_most(name + ", all entries", "-", worst, 1e-2));
    for (int k = 0; k < n; ++k)
      if (k != m)
        mixed = std::max(mixed, cosine(k).norm() / reference.norm());
  }
  checks.push_back(at_most("between different harmonics", "-", mixed, 1e-6));
  return checks;
}

// ---- ring-rigid-limit, ring-mesh ------------------------------------------------------------------------------

// Rings, neck and block a thousand times as stiff as steel, in the assembly, against the bracketed search for one
// displacement between rigid rings.
std::vector<Check> ring_rigid_limit()
{
  const RollerBearing bearing = mill_bearing(ChockForm::block);
  RingSections sections       = bearing::ring_sections(bearing);
  sections.material.youngs_modulus *= 1000;
  const ScratchRings scratch(sections, {0.4, 0.6}, "limit");
  fem::RingOptions options;
  options.last_harmonic   = 20;
  options.chock_harmonics = 3;
  auto model              = bearing::rigid_model(bearing);
  model.rings             = fem::ring_flexibility(sections, scratch.meshes, nullptr, options).flexibility;
  const double load       = 1e6;
  const auto loading      = bearing::radial_drive(load);
  const auto stiff        = bearing::BearingAssembly(model).solve(loading);
  const auto rigid        = bearing::solve_bearing(bearing, load);
  return {relative("displacement", "um", stiff.motion[0] / 1e-6, rigid.displacement / 1e-6, 1e-3),
          relative("tangent", "kN/mm", bearing::radial_tangent(stiff, loading) / 1e6, rigid.tangent / 1e6, 1e-3),
          relative("heaviest roller", "kN", stiff.roller_load.maxCoeff() / 1e3, rigid.roller_max / 1e3, 1e-3),
          at_most("largest difference of a roller load / heaviest", "-",
                  (stiff.roller_load - rigid.roller_load).cwiseAbs().maxCoeff() / rigid.roller_max, 1e-3)};
}

// Flexibility of the mill bearing's rings under a radial load.
double whole_flexibility(const ChockForm chock, const meshes::RingMeshSize &size, const int last_harmonic)
{
  const RingSections sections = bearing::ring_sections(mill_bearing(chock));
  const ScratchRings scratch(sections, size, word_of(chock));
  fem::RingOptions options;
  options.last_harmonic = last_harmonic;
  return fem::stribeck_flexibility(fem::ring_flexibility(sections, scratch.meshes, nullptr, options).flexibility,
                                   39);
}

std::vector<Check> ring_mesh()
{
  const double rings      = whole_flexibility(ChockForm::round, {0.5, 1}, 40);
  const double fine_rings = whole_flexibility(ChockForm::round, {0.75, 1}, 40);
  // The block's own part lies in its eight harmonics.
  const double block      = whole_flexibility(ChockForm::block, {0.4, 0.65}, 10);
  const double fine_block = whole_flexibility(ChockForm::block, {0.4, 0.8}, 10);
  return {
      relative("rings and round housing, size 0.5 against 0.75", "nm/MN", 1e15 * rings, 1e15 * fine_rings, 1e-2),
      relative("block, size 0.65 against 0.8", "nm/MN", 1e15 * block, 1e15 * fine_block, 1e-2)};
}

// ---- chock-m-shape --------------------------------------------------------------------------------------------

// Azimuth of the heaviest roller of the first row on the side psi >= 0, degrees.
double heaviest(const bearing::AssemblyState &state)
{
  Eigen::Index j = 0;
  state.roller_load.row(0).head(state.azimuth.size() / 2).maxCoeff(&j);
  return state.azimuth[j] / degree;
}

std::vector<Check> chock_m_shape()
{
  RollerBearing bearing = mill_bearing(ChockForm::block);
  bearing.roller_law    = OneRollerLaw::iso;
  bearing.rings         = RingBodies::elastic;
  const double load     = 1e6;
  auto model            = bearing::rigid_model(bearing);
  const auto solved     = [&] { return bearing::BearingAssembly(model).solve(bearing::radial_drive(load)); };
  const auto rigid      = solved();
  const auto in_block   = [&](const double width, const double gap) {
    bearing.chock_support_width = width;
    bearing.chock_support_gap   = gap;
    const auto sections         = bearing::ring_sections(bearing);
    const ScratchRings scratch(sections, {0.5, 0.8}, "shape");
    fem::RingOptions options;
    options.last_harmonic = 40;
    return fem::ring_flexibility(sections, scratch.meshes, nullptr, options).flexibility;
  };
  const auto on_feet = in_block(600 * mm, 400 * mm);
  model.rings        = on_feet;
  const auto feet    = solved();
  model.rings        = bearing::stiffer(on_feet, 1000);
  const auto stiff   = solved();
  model.rings        = in_block(300 * mm, 0);
  const auto middle  = solved();
  const auto secant  = [](const bearing::AssemblyState &state) { return bearing::radial_secant(state) / 1e6; };
  Check off{"heaviest roller, block on two feet", "deg", heaviest(feet), 15, 0, Judged::at_least};
  // Asked of any elastic chock.
  Check behind{"heaviest roller, block on its middle", "deg", heaviest(middle), 15, 0, Judged::at_least};
  return {
      off,
      at_most("the same, at most", "deg", heaviest(feet), 30),
      known_deviation(behind, {0, 4.6,
                               "a block carried right behind the heaviest rollers is stiffest on the load line: "
                               "the shortest way to the support; it moves the load off the line where it can bend "
                               "away from it, on two feet or hung from its far side",
                               "the drawing of the published chock, with its support; or a bound that names the "
                               "support"}),
      reported("heaviest roller, rigid rings", "deg", heaviest(rigid), 0),
      reported("secant, block on two feet / rigid rings", "kN/mm", secant(feet), secant(rigid)),
      reported("secant, block on its middle / rigid rings", "kN/mm", secant(middle), secant(rigid)),
      relative("secant, modulus x 1000 / rigid rings", "kN/mm", secant(stiff), secant(rigid), 1e-3)};
}
}  // namespace

std::vector<Case> ring_cases()
{
  const char *const product = "finite elements of this program, one against the other";
  std::vector<Case> cases;
  cases.push_back({"ring-harmonics", "verification",
                   "Annulus of radii 100 and 150 mm in plane strain under the pressure cos(m theta) on its inner "
                   "side, as a meridian section of some 50 quadratic quadrilaterals and one factorisation per "
                   "harmonic; and a ring 2 mm thick at a radius of 100 mm.",
                   "Michell's solution with the Airy functions r^m, r^-m, r^(m+2), r^(2-m) (Lame for m = 0); thin "
                   "ring: Timoshenko, Strength of Materials, bending without stretching",
                   "1e-5: discretisation of quadratic elements at this size; thin ring 2 %: the bending theory "
                   "neglects terms of the order thickness over radius",
                   ring_harmonics});
  cases.push_back(
      {"ring-on-rigid-back", "verification",
       "Annulus as thick as the cup of the mill bearing, outer side held, and its short waves against a "
       "half space; then cone with neck and cup with round housing of the 266.7 x 355.6 mm bearing less "
       "their raceways on a rigid back, quadratic meridian sections of some 7000 unknowns per harmonic.",
       "Michell's solution; half space: displacement 2 (1 - nu^2) p R / (E m); the difference must "
       "vanish for short waves, which do not reach the back",
       "1e-4: discretisation; half space 1 %: waves of 7 mm on a radius of 166 mm; 1e-4 of the sum: the "
       "harmonic at which the series may end",
       ring_on_rigid_back});
  cases.push_back(
      {"neck-inertia-relief", "verification",
       "Solid cylinder of radius 130 mm without any support under a line load over its whole length, "
       "even around and as cos(theta), the resultant balanced by a body force; 12 quadratic elements.",
       "polynomial solutions: even, u = (1 - nu) p R / E; across, sigma_x = sigma_y = -p x / R with the "
       "body force p / R, u = (1 - nu) p R / (2 E) against the mean motion; both (1 - nu)/(2 pi E L) "
       "per unit line load",
       "rounding: quadratic elements hold these fields exactly", neck_inertia_relief});
  cases.push_back(
      {"chock-round", "verification",
       "Cup of the mill bearing in a round block held at a radius of 280 mm: a quarter in quadratic "
       "hexahedra (25000 unknowns per symmetry case) against the harmonics of its meridian section, rows with "
       "inclined raceways, three Legendre polynomials along the rollers.",
       product,
       "1 %: 13 degrees per element are 4 elements for the shortest of the eight waves; as in the "
       "product, what the block's coarse mesh lines get wrong in the meridian is taken off with a "
       "section on the same lines; harmonics must not mix, 1e-6",
       chock_round});
  cases.push_back(
      {"ring-rigid-limit", "verification",
       "Rings, neck and chock of the mill bearing by finite elements with a thousandfold modulus on coarse "
       "meshes, in the assembled bearing under 1 MN.",
       "the rigid-ring solver, a bracketed search for one displacement that shares nothing with rings "
       "and assembly but the law of one roller",
       "rings as flexible as the rollers leave 1/1000 of their part", ring_rigid_limit});
  cases.push_back(
      {"ring-mesh", "verification",
       "Flexibility of rings, neck and housing of the mill bearing under a radial load spread by "
       "Stribeck's law, on meshes of 0.5 and 0.75 (rings) and 0.65 and 0.8 (block) of the elements per "
       "length that the product takes.",
       product, "1 %: what the results are to be good for; the product takes the size 1", ring_mesh});
  cases.push_back({"chock-m-shape", "verification",
                   "Mill bearing under 1 MN with rings, neck and block by finite elements: a block of 600 x 560 x "
                   "260 mm carried by two feet of 100 mm at the ends of its face, and by the middle 300 mm of it.",
                   "Lin, Sun, Peng, Engineering Mechanics 38(1) (2021) 231: the heaviest roller lies 15 to 30 "
                   "degrees off the load line; rigid rings: the assembly without flexibility",
                   "a range: dimensions and support of the published chock are not known, and it was asked for of "
                   "any elastic chock. The load is M-shaped "
                   "where the block can bend away from the rollers on the load line, that is on two feet; carried "
                   "right behind them it is not. The rings' share of the deflection, 0.7 of the rollers', becomes "
                   "0.07 % with a thousandfold modulus",
                   chock_m_shape});
  return cases;
}
}  // namespace mill::verify
