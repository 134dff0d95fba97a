#include "app/stages/bearing/bearing_model.h"
#include "app/run/kept_part.h"
#include "core/base/files.h"
#include "core/case/kinds.h"
#include "core/records/record_text.h"
#include "fem/bearing/chock_flexibility.h"
#include "fem/bearing/roller_slices.h"
#include "meshes/bearing/bearing_rings.h"
#include "meshes/bearing/chock.h"
#include "meshes/bearing/roller.h"
#include "meshes/common/mesher.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/ring_sections.h"
#include "reduce/bearing/roller_profile.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <vector>

namespace mill {
namespace {
// Raised by hand when meshing or condensation changes what it computes.
constexpr const char *roller_version = "roller 2", *rings_version = "rings 6";

std::string file_name(const RunContext &run, const char *what, const std::string &key)
{
  return run.cache + "/" + what + "-" + key + ".bin";
}

std::string inputs_of(const RollerSetup &setup)
{
  return record_text(roller_version, fem::library_version(), meshes::library_version(), setup);
}

fem::CondensedRoller condensed_roller(RunContext &run, const RollerBearing &b, const std::string &name,
                                      const RollerSetup &s)
{
  const std::string key = hash_of(inputs_of(s));
  const auto make       = [&] {
    const RollerMeshes meshes = meshes::mesh_roller(s, run.out.staging(), "roller-" + key);
    auto roller               = fem::condense_roller(s, meshes, run.progress);
    meshes::remove_meshes(meshes);
    return roller;
  };
  return kept_part<fem::CondensedRoller>(run, name, file_name(run, "roller", key), key, make,
                                         "bearing." + b.name + ".roller_law = \"iso\"");
}

// Everything the rings' flexibility is made from: their sections and what holds them.
std::string inputs_of(const RingSections &sections)
{
  return record_text(rings_version, fem::library_version(), meshes::library_version(), sections);
}

std::string ring_key(const RollerBearing &b, const bearing::RacewayDatum &datum)
{
  return hash_of(inputs_of(bearing::ring_sections(b, datum)));
}

// What needs less memory than the rings.
std::string rigid_rings(const RollerBearing &b)
{
  return "bearing." + b.name + ".rings = \"rigid\"";
}

fem::RingResult condensed_rings(RunContext &run, const RollerBearing &b, const bearing::RacewayDatum &datum)
{
  const std::string key = ring_key(b, datum);
  const auto make       = [&] {
    const RingSections sections = bearing::ring_sections(b, datum);
    const std::string name      = "rings-" + key;
    const RingMeshes fine       = meshes::mesh_rings(sections, {}, run.out.staging(), name);
    const RingMeshes coarse =
        meshes::mesh_rings(sections, meshes::coarsened({}), run.out.staging(), name + "-coarse");
    auto result = fem::ring_flexibility(sections, fine, &coarse, {}, run.progress, run.threads);
    meshes::remove_meshes(fine);
    meshes::remove_meshes(coarse);
    return result;
  };
  return kept_part<fem::RingResult>(run, "rings and chock of bearing " + b.name, file_name(run, "rings", key), key,
                                    make, rigid_rings(b));
}

// What surrounds the cup in another way: the orders in which it shows, on the coarser meshes.
fem::RingResult condensed_surroundings(RunContext &run, const bearing::ChockSupport &support,
                                       const bearing::RacewayDatum &datum, const int harmonics)
{
  const std::string key =
      hash_of(fmt::format("{} | {} orders of the surroundings", ring_key(support.bearing, datum), harmonics));
  const auto make = [&] {
    const RingSections sections = bearing::ring_sections(support.bearing, datum);
    const RingMeshes meshes =
        meshes::mesh_rings(sections, meshes::coarsened({}), run.out.staging(), "rings-" + key);
    fem::RingOptions options;
    options.chock_harmonics = harmonics;
    options.last_harmonic   = harmonics - 1;
    options.share           = 0;  // all of these orders
    auto result             = fem::ring_flexibility(sections, meshes, nullptr, options, run.progress, run.threads);
    meshes::remove_meshes(meshes);
    return result;
  };
  return kept_part<fem::RingResult>(run, support.name + ", bearing " + support.bearing.name,
                                    file_name(run, "rings", key), key, make, rigid_rings(support.bearing));
}
}  // namespace

std::function<double(double)> drop_of(const RollerBearing &b)
{
  return [b](const double x) { return bearing::profile_drop(b, Eigen::VectorXd::Constant(1, x))[0]; };
}

namespace {
void add_rings(RunContext &run, const RollerBearing &b, const fem::RingResult &rings, BearingParts &parts)
{
  parts.model.rings = rings.flexibility;
  parts.notes       = rings.notes;
  for (bearing::BearingVariant &companion : parts.companions)
    companion.model.rings = rings.flexibility;
  parts.companions.push_back({"rings and chock on a coarser mesh", parts.model});
  parts.companions.back().model.rings = parts.coarse_rings = rings.companion;
  for (const bearing::ChockSupport &support : bearing::open_supports(b))
    parts.supports.push_back({support.name, with_support(run, b, parts, support).model});
}

// What is condensed for a bearing, each by itself.
struct CondensedParts {
  std::optional<fem::CondensedRoller> roller, coarse_roller;
  std::optional<fem::RingResult> rings;
  std::map<std::string, fem::RingResult> surroundings;
};

CondensedParts condensed_parts(RunContext &run, const RollerBearing &b, const double largest_load,
                               const std::vector<bearing::ChockSupport> &supports)
{
  CondensedParts parts;
  std::vector<IndependentStage> stages;
  if (b.rings == RingBodies::elastic)
    stages.push_back(
        [&](RunContext &part_run) { parts.rings = condensed_rings(part_run, b, bearing::law_datum(b)); });
  if (b.roller_law == OneRollerLaw::fe) {
    const auto setup = bearing::roller_setup(b, largest_load);
    const auto name  = "roller of bearing " + b.name;
    stages.push_back(
        [&, setup, name](RunContext &part_run) { parts.roller = condensed_roller(part_run, b, name, setup); });
    stages.push_back([&, setup, name](RunContext &part_run) {
      parts.coarse_roller = condensed_roller(part_run, b, name + ", coarse mesh", coarsened(setup));
    });
  }
  for (const bearing::ChockSupport &support : supports) {
    auto &result = parts.surroundings[support.name];
    stages.push_back([&](RunContext &part_run) {
      result =
          condensed_surroundings(part_run, support, bearing::law_datum(b), fem::RingOptions().chock_harmonics);
    });
  }
  run_side_by_side(run, std::move(stages));
  return parts;
}
}  // namespace

BearingParts with_support(RunContext &run, const RollerBearing &b, BearingParts parts,
                          const bearing::ChockSupport &support)
{
  const int harmonics = parts.model.rings.chock_harmonics;
  const auto made     = parts.surroundings.find(support.name);
  const auto other    = made != parts.surroundings.end() && harmonics == fem::RingOptions().chock_harmonics
                            ? made->second
                            : condensed_surroundings(run, support, bearing::law_datum(b), harmonics);
  const auto exchange = [&](bearing::BearingModel &model) {
    model.rings = bearing::with_surroundings_of(model.rings, parts.coarse_rings, other.flexibility, harmonics);
  };
  exchange(parts.model);
  for (bearing::BearingVariant &companion : parts.companions)
    exchange(companion.model);
  return parts;
}

std::string roller_inputs(const RollerBearing &b, const double largest_load)
{
  return b.roller_law == OneRollerLaw::fe ? inputs_of(bearing::roller_setup(b, largest_load)) : "";
}

std::string ring_inputs(const RollerBearing &b)
{
  return b.rings == RingBodies::elastic ? inputs_of(bearing::ring_sections(b, bearing::law_datum(b))) : "";
}

BearingParts bearing_parts(RunContext &run, const RollerBearing &b, const double largest_load,
                           const std::vector<bearing::ChockSupport> &also)
{
  BearingParts parts;
  parts.model.bearing = bearing::with_row_places(b);
  auto supports       = also;
  if (b.rings == RingBodies::elastic) {
    const auto open = bearing::open_supports(b);
    supports.insert(supports.begin(), open.begin(), open.end());
  }
  auto condensed     = condensed_parts(run, b, largest_load, supports);
  parts.surroundings = std::move(condensed.surroundings);
  if (b.roller_law == OneRollerLaw::fe) {
    const auto walls      = bearing::ring_walls(b);
    parts.law_depth_inner = walls.inner;
    parts.law_depth_outer = walls.outer;
    parts.companions.push_back({"roller on a mesh twice as coarse", parts.model});
    parts.companions.back().model.roller =
        bearing::with_limits(fem::fe_roller_law(*condensed.coarse_roller, b.slices, drop_of(b)));
    parts.roller       = std::make_shared<const fem::CondensedRoller>(std::move(*condensed.roller));
    parts.model.roller = bearing::with_limits(fem::fe_roller_law(*parts.roller, b.slices, drop_of(b)));
  } else
    parts.model.roller = bearing::with_limits(bearing::roller_law(b));
  if (b.rings == RingBodies::elastic)
    add_rings(run, b, *condensed.rings, parts);
  return parts;
}

double largest_contact_load(const BearingParts &parts)
{
  return parts.roller ? 0.6 * parts.roller->setup.largest_load : 0;
}

void write_chock(RunContext &run, const RollerBearing &b, const Eigen::MatrixXd &load)
{
  if (!counts_its_chock(b))
    return;
  StageTimer timer(run, "fields of bearing " + b.name);
  const RingSections sections = bearing::ring_sections(b, bearing::law_datum(b));
  const std::string mesh_file = run.out.file("fields/chock.msh");
  const MeshFile mesh         = meshes::mesh_chock(sections.cup, sections.housing, 1, mesh_file);
  fem::write_chock_vtu(run.out.file("fields/bearing-" + slug(b.name) + "-chock.vtu"), sections.cup, mesh,
                       meshes::mirrored_rows(sections.cup), sections.material, load);
  std::filesystem::remove(mesh_file);
}

namespace {
Place place_of(const Case &the_case, const std::string &key)
{
  const auto place = the_case.places.find(key);
  return place == the_case.places.end() ? Place{the_case.path} : place->second;
}

void check_fit(const Case &the_case, const RollerBearing &b, std::vector<Problem> &problems)
{
  const auto fit = bearing::resting_fit(b);
  if (!fit || fit->pressure <= b.yield_pressure)
    return;
  const bool preloaded  = b.preload > 0;
  const std::string key = "bearing." + b.name + (preloaded ? ".preload" : ".radial_clearance");
  const std::string given =
      preloaded ? fmt::format("{:.4g} kN", b.preload / 1e3) : fmt::format("{:.4g} mm", 1e3 * b.radial_clearance);
  const std::string most = preloaded ? fmt::format("{:.3g} kN", fit->yield_share * b.preload / 1e3)
                                     : fmt::format("{:.3g} mm", 1e3 * fit->yield_share * b.radial_clearance);
  problems.push_back(
      {place_of(the_case, key),
       fmt::format("{} = \"{}\" presses every roller with {:.4g} kN before any load acts, {:.0f} MPa on the inner "
                   "raceway; it yields at {:.0f} MPa (yield_pressure), reached at about {}",
                   key, given, fit->load / 1e3, fit->pressure / 1e6, b.yield_pressure / 1e6, most),
       {}});
}

// Refuses a drawing that cannot be meshed, before anything is computed.
void check_drawing(const Case &the_case, const RollerBearing &b, std::vector<Problem> &problems)
{
  if (b.rings != RingBodies::elastic && b.roller_law != OneRollerLaw::fe)
    return;
  try {
    if (b.rings == RingBodies::elastic)
      bearing::ring_sections(b, bearing::law_datum(b));
    else
      bearing::roller_setup(b, 0);
    if (b.profile != RollerProfile::none)
      drop_of(b)(0);
  } catch (const InputError &e) {
    problems.push_back({place_of(the_case, "bearing." + b.name + ".type"), e.problems.at(0).message, {}});
  }
}
}  // namespace

std::vector<std::string> said_of_bearings(const Case &the_case)
{
  std::vector<std::string> out;
  for (const RollerBearing &b : all_bearings(the_case)) {
    if (const double closing = closing_cup_angle(b); std::isfinite(closing))
      out.push_back(fmt::format(
          "bearing.{}: the apex condition closes at a cup angle of {:.4g} deg; cup_angle is {:.4g} deg", b.name,
          closing * 180 / M_PI, b.cup_angle * 180 / M_PI));
    if (b.arrangement_assumed)
      out.push_back(fmt::format("bearing.{}: arrangement is not given; {} is assumed", b.name,
                                arrangement_name(b.arrangement, b.rows)));
  }
  return out;
}

void check_fits(const Case &the_case)
{
  std::vector<Problem> problems;
  for (const RollerBearing &b : all_bearings(the_case)) {
    check_fit(the_case, b, problems);
    check_drawing(the_case, b, problems);
  }
  if (!problems.empty())
    throw InputError(std::move(problems));
}
}  // namespace mill
