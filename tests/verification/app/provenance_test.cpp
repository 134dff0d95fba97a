#include "app/stages/bearing/bearing_model.h"
#include "app/stages/bite/bite_roll_stage.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/strip_flow_stage.h"
#include "app/stages/contact/contact_model.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/closed_form_parts.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/model/seat_load.h"
#include "core/records/record_text.h"
#include "core/records/rows_of_stand.h"
#include "reduce/chain/line_contact.h"
#include "tests/support/changed_rows.h"
#include "tests/support/run_results.h"
#include "tests/support/short_records.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <unistd.h>

// The inputs that a result states, against what moves it: every row of the case is changed and every result
// computed again by closed forms.  What those do not follow is read from the texts that the finite elements are
// kept under.
namespace {
using namespace mill;
using Results = std::vector<ClosedFormResult>;

double load_of(const Pass &pass)
{
  return std::isnan(pass.load) ? force_of(pass).force.mean() : pass.load;
}

// Elements of the strip, and the section of the roll on its backup roll where the arc is free.
std::string text_of_bite(const FourHigh &stand)
{
  const Pass &pass = stand.passes[0];
  const auto bite  = bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel);
  std::string text = flow_inputs({bite, stand.bite, ""}, nullptr);
  if (stand.bite.arc != BiteArc::elastic)
    return text;
  BiteQuestion q;
  q.bite  = bite;
  q.setup = stand.bite;
  q.backup_half_width =
      reduce::line_contact({stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter,
                            std::min(stand.work_roll.barrel_length, stand.backup_roll.barrel_length), stand.steel},
                           load_of(pass))
          .half_width;
  return text + section_inputs(q);
}

// What the finite elements behind a result are made from; nothing for the others.
std::string text_of(const FourHigh &stand, const std::string &name)
{
  if (stand.given.count(name))
    return "";
  if (name == "K3" || name == "K5") {
    const bool upper         = name == "K3";
    ContactSettings settings = upper ? stand.upper_contact : stand.lower_contact;
    std::vector<double> loads;
    for (const Pass &pass : stand.passes)
      loads.push_back(load_of(pass));
    settings.loads    = swept_range(upper ? "upper" : "lower", settings, loads);
    settings.friction = settings.path_trim = 0;  // of other results
    const auto plan                        = planned_rolls(stand, settings, settings.loads[1], first_reach);
    std::string text =
        record_text(settings, stand.strip.width, stand.work_roll.bending_force, stand.work_roll.axial_shift,
                    profile_drop(stand, settings, upper ? 1 : -1, Eigen::VectorXd::LinSpaced(41, -.7, .7)));
    for (const PlannedRoll *roll : {&plan.backup, &plan.work})
      text += roll_inputs(roll->geometry, roll->size, stand.steel, plan.wanted, false);
    return text;
  }
  if (name.rfind("Kzc", 0) == 0) {
    const bool backup   = name[3] == '1' || name[3] == '4';
    const auto &bearing = bearing_of(stand.bearings, (backup ? stand.backup_roll : stand.work_roll).bearing);
    if (bearing.roller_law != OneRollerLaw::fe && bearing.rings != RingBodies::elastic)
      return "";
    // The mesh of the roller is made for the heaviest load of all passes and both seats, in steps of two.
    std::string text = roller_inputs(bearing, 1e5) + ring_inputs(bearing);
    for (std::size_t p = 0; p < stand.passes.size(); ++p)
      for (const ContactSettings *contact : {&stand.upper_contact, &stand.lower_contact})
        text += number_text(seat_load(stand, backup, *contact, load_of(stand.passes[p])).value);
    return text;
  }
  return name == "K4" && stand.bite.method == BiteMethod::fe ? text_of_bite(stand) : "";
}

std::string text_of(const Case &the_case, const std::string &name)
{
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec))
    return text_of(*stand, name);
  if (const auto *spec = std::get_if<BearingCase>(&the_case.spec)) {
    const auto &bearing = bearing_of(spec->bearings, spec->load.bearing);
    return roller_inputs(bearing, 1e5) + ring_inputs(bearing) + record_text(spec->load.loads);
  }
  if (const auto *pair = std::get_if<TwoCylinders>(&the_case.spec)) {
    if (pair->in_space)  // kept nowhere: every row that the grids are made from
      return record_text(pair->space.rectangles, pair->space.tilt);
    std::string rolls;
    for (const RoundBody *body : {&pair->upper, &pair->lower})
      if (!body->plane() && !body->rigid) {
        const auto plan = planned_cylinder(*pair, body->diameter);
        rolls +=
            roll_inputs(plan.geometry, plan.size, material_of(*body, pair->steel), {true, false, false}, false);
      }
    return name == "contact.line.tangent" ? rolls + record_text(pair->contact.samples) : rolls;
  }
  return "";
}

struct Exceptions {
  std::vector<std::string>
      not_moved;  // declared, although no value that the case accepts shows it; with the reason
  std::vector<std::string> kept_apart;  // enter a text without moving the result
};

bool has_moved(const ClosedFormResult &r, const std::vector<std::pair<Case, Results>> &others)
{
  return std::any_of(others.begin(), others.end(), [&](const auto &other) {
    const ClosedFormResult *same = find(other.second, r.name);
    return same && differs(same->parameter.value, r.parameter.value);
  });
}

bool all_moved(const Results &before, const std::vector<std::pair<Case, Results>> &others, const std::string &key)
{
  return std::all_of(before.begin(), before.end(),
                     [&](const ClosedFormResult &r) { return !holds(r.closed, key) || has_moved(r, others); });
}

// Both ways: no key that moves a result is missing from its list, and none stands in it that cannot move it.
void expect_complete(const BaseCase &base, const Exceptions &known)
{
  const Case the_case = read(base);
  ClosedFormMemory memory;
  const Results before = closed_form_chain(the_case, memory);
  memory.with_inputs   = false;  // of the changed cases numbers alone are asked for
  std::map<std::string, std::string> texts;
  for (const ClosedFormResult &r : before)
    texts[r.name] = text_of(the_case, r.name);
  std::set<std::string> names;
  for (const TraceKey &key : keys_of(the_case)) {
    names.insert(key.name);
    const TraceKey trace_key = find_key(the_case, base.sets, key.name, {});
    // Up, down, and further as long as something that should move has not.
    std::vector<std::pair<Case, Results>> others, far;
    const auto add = [&](std::vector<std::pair<Case, Results>> &list, const std::string &value) {
      std::optional<Case> other = with_value(base, trace_key, value);
      if (!other)
        return;
      try {
        Results results = closed_form_chain(*other, memory);
        list.emplace_back(std::move(*other), std::move(results));
      } catch (const InputError &) {
        // The closed forms refuse it.
      } catch (const SolverError &) {
      }
    };
    for (const std::string &value : other_values(trace_key))
      if (others.size() < 2 || !all_moved(before, others, key.name))
        add(others, value);
    // What hardly moves does so far away; there other modes may have changed places in the order of frequencies.
    if (!all_moved(before, others, key.name))
      for (const std::string &value : far_values(trace_key))
        add(far, value);
    for (const ClosedFormResult &r : before) {
      if (r.name.rfind("pass 2.", 0) == 0)
        continue;  // as the first
      const bool closed = holds(r.closed, key.name), declared = holds(r.parameter.inputs, key.name);
      const bool moved        = has_moved(r, others) || (closed && has_moved(r, far));
      const std::string &text = texts.at(r.name);
      const bool entered      = !text.empty() && std::any_of(others.begin(), others.end(), [&](const auto &other) {
        return text_of(other.first, r.name) != text;
      });
      EXPECT_TRUE(declared || !closed) << key.name << " is followed by the closed form of " << r.name << " alone";
      if (fits_any(known.not_moved, key.name) || fits_any(known.not_moved, key.name + " of " + r.name))
        continue;
      EXPECT_EQ(moved, closed) << key.name << (moved ? " moves " : " does not move ") << r.name
                               << ", and its closed list says otherwise";
      if (!text.empty() && !fits_any(known.kept_apart, key.name))
        EXPECT_EQ(moved || entered, declared)
            << key.name << (declared ? " is idle in" : " is missing from") << " the inputs of " << r.name;
    }
  }
  for (const ClosedFormResult &r : before)
    for (const std::string &key : r.parameter.inputs)
      EXPECT_TRUE(names.count(key)) << r.name << " states an unknown key " << key;
}

// The demo stand, or the one with a drawn frame, with a made force and a load.
BaseCase stand(const std::string &name, std::vector<std::string> sets = {})
{
  std::string text   = read_text("cases/" + name + ".toml");
  const auto replace = [&](const std::string &from, const std::string &to) {
    for (auto position = text.find(from); position != std::string::npos;
         position      = text.find(from, position + to.size()))
      text.replace(position, from.size(), to);
  };
  replace("force          = \"data/pass-1.csv\"",
          "synthetic_range = [\"972 kN\", \"979 kN\"]\nsynthetic_duration = \"0.2 s\"");
  replace("force          = \"data/pass-2.csv\"", "load = \"738 kN\"");
  replace("crown            = \"0 um\"", "");
  const std::string file = testing::TempDir() + "provenance-" + std::to_string(getpid()) + "-" + name + ".toml";
  write_atomically(file, text);
  return {file, std::move(sets)};
}

// Every constant of every law, so that each law may take the place of the other.
const std::string every_friction =
    "strip.friction={law = \"coulomb\", coefficient = 0.4, entry_factor = 0.1, "
    "exit_factor = 0.12, at_unit_speed = "
    "0.067, per_log_speed = -0.006, mu0 = 0.012, mu1 = 0.142, decay = \"2.43 1/um\", viscosity = \"0.005 "
    "Pa s\", pressure_viscosity = \"2e-8 "
    "1/Pa\"}";
std::string every_flow_stress(const std::string &law, const std::string &k)
{
  return "strip.flow_stress={law = \"" + law + "\", k = \"" + k + "\", eps0 = 0.9, n = 0.2, k0 = \"" + k +
         "\", table = [[0.0, \"" + k + "\"], [1.0, \"1200 MPa\"]]}";
}

const std::vector<std::string> tapered{"bearing.trb.roller_total_length=34 mm",
                                       "bearing.trb.radial_clearance=0.02 mm"};

// Of a stand: the type of a bearing follows from its angles and is not changed alone, nor may an end play or
// a preload be given with a clearance; the closed forms bend one beam whatever bending_model says; another bearing
// or a seat for the chocks puts the horizontal modes in another order; in another frame a mode has another name;
// another law of friction makes a bite of
// another stiffness, with which a mode has another name; the offset of the axes changes the load of the bearings
// by so little that modes of the other half do not show it; what is not given yet stands in no list of what it
// would replace; the work rolls' bearing does not go on the necks of the backup rolls, and the stand has no third
// bearing.  The bite's elements are kept under all constants of all laws.
const Exceptions of_a_stand{
    {"backup_roll.bearing", "bearing.trb.type", "bearing.crb.type", "bearing.trb.end_play", "bearing.trb.preload",
     "given.*", "backup_roll.bending_model", "work_roll.bearing of fh3", "bearing.trb.profile of fh3",
     "bearing.trb.profile of fh4", "dynamics.frame of mode.*", "dynamics.frame of open.mode.*",
     "frame.chock_to_housing_stiffness", "strip.friction of mode.gap_first_kind_roll_upper*",
     "strip.friction.law of mode.gap_first_kind_roll_upper*", "contact.upper.axis_offset of f4",
     "contact.lower.axis_offset of f3"},
    {"strip.initial_thickness", "strip.youngs_modulus", "strip.poisson_ratio", "strip.flow_stress.*",
     "strip.friction.*", "pass.0.speed"}};

Exceptions also(Exceptions known, const std::vector<std::string> &not_moved)
{
  known.not_moved.insert(known.not_moved.end(), not_moved.begin(), not_moved.end());
  return known;
}
}  // namespace

TEST(Provenance, ResultsOfAStandStateTheirInputs)
{
  BaseCase base = stand("four-high-1400", tapered);
  for (const char *set :
       {"contact.upper.axis_offset=5 mm", "contact.lower.axis_offset=5 mm", "work_roll.end_chamfer_length=50 mm",
        "work_roll.end_chamfer_depth=20 um", "backup_roll.end_chamfer_length=50 mm",
        "backup_roll.end_chamfer_depth=20 um", "bite.arc=elastic", "pass.0.speed=2 m/s", "pass.1.speed=2 m/s"})
    base.sets.push_back(set);
  base.sets.push_back(every_friction);
  base.sets.push_back(every_flow_stress("constant", "28 MPa"));
  expect_complete(base, of_a_stand);
  std::filesystem::remove(base.file);
}

TEST(ProvenanceLong, ResultsOfADrawnFrameAndGivenSpringsStateTheirInputs)
{
  BaseCase base = stand("four-high-drawn", tapered);
  for (const char *set :
       {"work_roll.end_chamfer_length=50 mm", "work_roll.end_chamfer_depth=20 um",
        "backup_roll.end_chamfer_length=50 mm", "backup_roll.end_chamfer_depth=20 um",
        "screwdown.load_cell_bore=100 mm", "given.K1=6e3 kN/mm", "given.K_ZW=6.5e4 kN/mm", "given.Kzc2=2e4 kN/mm",
        "given.K5=1.5e4 kN/mm",
        "backup_roll.crown_table=[[\"-700 mm\", \"0 um\"], [\"0 mm\", \"20 um\"], [\"700 mm\", \"0 um\"]]",
        "work_roll.crown_polynomial=[[2, \"30 um\"]]"})
    base.sets.push_back(set);
  // Friction given as a number excludes its section; a soft seat or another bearing puts the horizontal modes in
  // another order; a barrel whose crown table reaches its ends can only grow, beyond the other one.  K5 keeps
  // every mode away from the share of the gap where its name changes.
  expect_complete(base,
                  also(of_a_stand, {"strip.friction.*", "strip.flow_stress.law", "bite.strip", "contact.*",
                                    "frame.chock_to_housing_stiffness", "work_roll.bearing of fh4",
                                    "backup_roll.barrel_length of K3", "backup_roll.barrel_length of stand.*"}));
  std::filesystem::remove(base.file);
}

TEST(Provenance, ResultsOfTheOtherKindsStateTheirInputs)
{
  expect_complete({"cases/two-cylinders.toml", {}}, {});
  // A face as long as the examples does not cut the ellipse; a profile needs a length, a cylinder a
  // diameter.
  expect_complete({"cases/elliptic-contact.toml", {}},
                  {{"upper.length", "lower.length", "upper.profile", "lower.profile", "lower.shape"}, {}});
  // In a closed frame a mode has another name; the frame joins masses of which the highest mode has nothing.
  const ShortRecords published("published-1400");
  expect_complete(
      {published.file, {}},
      {{"dynamics.frame of mode.*", "dynamics.frame of open.mode.*", "dynamics.frame of open.f6"}, {}});
  // Two stands share their strip, so that neither changes it alone; the range of the search holds the answer.
  expect_complete({"cases/chatter-two-stands.toml", {}}, {{"condition.*", "analysis.speeds"}, {}});
}

TEST(Provenance, ResultsOfBearingsStateTheirInputs)
{
  // [model] says law, rings and slices of the one bearing again; neither end play nor preload may be given with a
  // clearance; the example of a pitch diameter is the mean that represents it where it is not given.
  const std::vector<std::string> known{
      "bearing.trb.type",     "bearing.trb.roller_law", "bearing.trb.rings",
      "bearing.trb.slices",   "model.slices",           "load.bearing",
      "bearing.trb.end_play", "bearing.trb.preload",    "bearing.trb.pitch_diameter"};
  for (const char *profile : {"iso", "log"}) {
    BaseCase base{"cases/bearing-266.toml", tapered};
    base.sets.push_back(std::string("bearing.trb.profile=\"") + profile + "\"");
    expect_complete(base, {known, {}});
  }
}

TEST(Provenance, ResultsOfBitesByEveryLawStateTheirInputs)
{
  for (const char *friction : {"coulomb", "factor", "speed", "film"})
    for (const char *flow : {"constant", "swift", "ludwik", "table"}) {
      if (std::string(friction) != "coulomb" && std::string(flow) != "constant")
        continue;
      SCOPED_TRACE(std::string(friction) + " " + flow);
      // A limit of the friction that does not bind moves nothing.
      expect_complete({"cases/cold-strip.toml",
                       {every_friction, std::string("strip.friction.law=") + friction,
                        "strip.friction.coefficient=0.06", every_flow_stress(flow, "1180 MPa"), "bite.method=slab",
                        "bite.arc=hitchcock", "bite.strip=rigid-plastic", "strip.initial_thickness=0.3 mm"}},
                      {{"strip.friction", "strip.friction.shear_limit"}, {}});
    }
}

TEST(Provenance, ARunStatesTheListsThatATraceFollows)
{
  const std::vector<std::string> coarse{"contact.upper.elements_per_half_width=2",
                                        "contact.lower.elements_per_half_width=2",
                                        "contact.upper.samples=7",
                                        "contact.lower.samples=7",
                                        "bite.method=slab",
                                        "bite.arc=rigid",
                                        "bearing.trb.roller_law=iso",
                                        "bearing.trb.rings=rigid"};
  const std::vector<BaseCase> bases{{"cases/four-high-1400.toml", coarse},
                                    {"cases/elliptic-contact.toml", {}},
                                    {"cases/bearing-266.toml", {"model.roller_law=iso", "model.rings=rigid"}},
                                    {"cases/oil-film.toml", {}},
                                    {"cases/cold-fit.toml", {}}};
  for (const BaseCase &base : bases) {
    SCOPED_TRACE(base.file);
    std::string sets;
    for (const std::string &set : base.sets)
      sets += " --set " + set;
    const std::string folder = "lists-" + read(base).name;
    const auto outcome =
        millstand("stiffness " + base.file + " -q -o " + scratch(folder) + " --cache " + shared_cache() + sets);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto values = results_of(folder).at("values");
    ClosedFormMemory memory;
    int n_compared = 0;
    for (const ClosedFormResult &r : closed_form_chain(read(base), memory)) {
      if (r.name == row::stand::K_bend.of("").text())  // the trace bends beams, whose list has no key of a mesh
        continue;
      for (const char *ending : {"", ".tangent", ".combined"})
        if (const auto made = values.find(r.name + ending); made != values.end()) {
          EXPECT_EQ(made->at("inputs").get<KeyList>(), r.parameter.inputs) << r.name << ending;
          ++n_compared;
        }
    }
    EXPECT_GE(n_compared, 2);
  }
}
