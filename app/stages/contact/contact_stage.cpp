#include "app/stages/contact/contact_stage.h"
#include "app/run/curve_files.h"
#include "app/run/kept_part.h"
#include "app/stages/contact/contact_details.h"
#include "app/stages/contact/contact_files.h"
#include "app/stages/contact/contact_model.h"
#include "app/stages/contact/contact_store.h"
#include "app/stages/contact/fourier_stage.h"
#include "core/base/files.h"
#include "core/base/force_text.h"
#include "core/case/contact_inputs.h"
#include "core/model/four_high.h"
#include "core/process/parallel.h"
#include "core/records/contact_name.h"
#include "core/records/record_text.h"
#include "core/records/rows_of_contact.h"
#include "fem/body/on_mesh.h"
#include "fem/roll/contact_numbers.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <future>
#include <memory>

namespace mill {
namespace {
// One contact with everything that its results are made of.
struct Study {
  std::string name;                           // "upper"
  std::string K;                              // "K3"
  std::shared_ptr<const ContactModel> model;  // of twins the same
  fem::ContactCurves curves;
  std::string twin;                 // contact that is the same one, already written
  std::string key;                  // of what is solved, in the cache
  bool kept = false;                // all of it was there
  std::vector<std::string> fields;  // VTU files of backup roll and work roll, once they are made
};

// The load of one pass.
struct WorkingLoad {
  std::string pass;  // empty: the first one
  double force;      // N
  KeyList inputs;    // keys behind the results at this load
};

}  // namespace

std::array<double, 2> swept_range(const std::string &name, const ContactSettings &settings,
                                  const std::vector<double> &loads)
{
  const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
  if (std::isnan(settings.loads[0]))
    return {0.1 * *least, 2 * *most};
  for (const double load : loads)
    if (load < settings.loads[0] || load > settings.loads[1])
      throw InputError(
          settings.loads_place,
          fmt::format("contact.{}.loads = {} .. {} does not hold the working load of {}; a curve is never "
                      "extrapolated, widen the range",
                      name, in_kN(settings.loads[0]), in_kN(settings.loads[1]), in_kN(load)));
  return settings.loads;
}

namespace {
// The second engine, where it was asked.
void add_check(Parameter &p, const std::string &who, const double value)
{
  if (!std::isnan(value))
    p.checks.push_back({who, value, ""});
}

Parameter measured(const std::string &unit, const fem::Compared &number, const WorkingLoad &load,
                   const std::string &reference)
{
  Parameter p;
  p.value          = number.value;
  p.unit           = unit;
  p.method         = "contact FEM, " + reference;
  p.at             = at_force(load.force);
  p.error_estimate = number.error;
  p.inputs         = load.inputs;
  return p;
}

const char *const fourier_solver = "Fourier solver";
const char *const coarse_mesh    = "mesh twice as coarse";

void add_curvature(RunContext &run, const Study &s, const WorkingLoad &load, const fem::StiffnessAtLoad &k)
{
  if (std::isnan(k.curvature.value))
    return;
  Parameter curvature = measured("N/m2", k.curvature, load, s.curves.mirrored.reference);
  curvature.checks.push_back({"Hertz line contact, K^3 A/(F L)", k.hertz_curvature, "no barrel ends"});
  add_check(curvature, coarse_mesh, k.curvature.coarse);
  add_check(curvature, fourier_solver, k.curvature.second);
  run.results.add(row::roll_contact::curvature.of(load.pass, s.K), curvature);
}

// Tangent and secant with the rolls held as in the stand: by the same comparisons as those between mirrored
// contacts, each for its own quantity.
void add_held(RunContext &run, const Study &s, const WorkingLoad &load, const fem::StiffnessAtLoad &k)
{
  const auto add = [&](const RowOf<2> &row, const fem::Compared &number, const fem::Compared &mirrored) {
    Parameter h = measured("N/m", number, load, s.curves.in_stand.reference);
    h.checks.push_back(
        {"rolls squeezed between mirrored contacts", mirrored.value, "another datum and no bending"});
    h.checks.push_back({coarse_mesh, number.coarse, ""});
    add_check(h, fourier_solver, number.second);
    run.results.add(row.of(load.pass, s.K), h);
  };
  add(row::roll_contact::in_stand_tangent, k.in_stand_tangent, k.tangent);
  add(row::roll_contact::in_stand_secant, k.in_stand_secant, k.secant);
}

void warn_of_stiffness(RunContext &run, const Study &s, const WorkingLoad &load, const fem::StiffnessAtLoad &k)
{
  const std::string &pass = load.pass;
  const double effect     = k.in_stand_tangent.value / k.tangent.value - 1;
  const Warning warning{
      WarningId::contact_held,
      "",
      fmt::format("{} is that of rolls squeezed between mirrored contacts, the spring in series with "
                  "the bending of the backup roll",
                  row::roll_contact::tangent.of(pass, s.K).text()),
      fmt::format("held as in the stand the same pair has {:+.1f} %", 100 * effect),
      "",
      {result_name({pass, s.K})}};
  // Both are true, of two datums; a quarter of difference is more than any usual stand has.
  if (std::abs(effect) > 0.25)
    run.warn(warning);
  else if (pass.empty())
    run.assume(text_of(warning));
  if (k.open_at_middle)
    run.warn(of_contact(WarningId::contact_partly_open, s.name,
                        fmt::format("at {} the rolls do not touch at mid-length", in_kN(load.force)), ""));
}

// K.tangent, K.secant and their values with the rolls held as in the stand, at one working load.
std::array<Parameter, 2> add_stiffness(RunContext &run, const Study &s, const WorkingLoad &load,
                                       const fem::StiffnessAtLoad &k)
{
  const std::string held_note = "bending, strip width, backup roll balanced by shear";
  Parameter tangent           = measured("N/m", k.tangent, load, s.curves.mirrored.reference);
  Parameter secant            = measured("N/m", k.secant, load, s.curves.mirrored.reference);
  tangent.checks.push_back({"Hertz line contact, infinitely long (3.5b)", k.hertz.tangent, "no barrel ends"});
  tangent.checks.push_back({"active set of this one load (2.8)", k.exact, "steps as nodes come into contact"});
  tangent.checks.push_back({coarse_mesh, k.tangent.coarse, ""});
  tangent.checks.push_back(check(CheckId::held_as_in_stand, k.in_stand_tangent.value, held_note));
  secant.checks.push_back(check(CheckId::johnson_secant, k.hertz.secant, "upper end of the band of closed forms"));
  secant.checks.push_back({"Foeppl (3.8)", k.laws.foeppl, ""});
  secant.checks.push_back({"half space (3.9)", k.laws.half_space, ""});
  secant.checks.push_back({"Palmgren (3.10)", k.laws.palmgren, "lower end of the band"});
  secant.checks.push_back(
      check(CheckId::middle_section, k.middle_secant, "the remaining difference belongs to the barrel ends"));
  secant.checks.push_back({coarse_mesh, k.secant.coarse, ""});
  secant.checks.push_back(check(CheckId::held_as_in_stand, k.in_stand_secant.value, held_note));
  add_check(tangent, fourier_solver, k.tangent.second);
  add_check(secant, fourier_solver, k.secant.second);
  run.results.add(row::roll_contact::tangent.of(load.pass, s.K), tangent);
  run.results.add(row::roll_contact::secant.of(load.pass, s.K), secant);
  add_curvature(run, s, load, k);
  add_held(run, s, load, k);
  warn_of_stiffness(run, s, load, k);
  return {tangent, secant};
}

// Displacement, stress and pressure of both rolls for ParaView; those of a twin are copies.
void write_study_fields(RunContext &run, Study &s, const FourHigh &stand, const contact::State &state)
{
  const char *const endings[]                = {"-backup-roll.vtu", "-work-roll.vtu"};
  CondensedPair ContactModel::*const rolls[] = {&ContactModel::backup, &ContactModel::work};
  const bool made                            = s.fields.size() == 2;
  for (int i = 0; i < 2; ++i) {
    const std::string file = "fields/contact-" + s.name + endings[i];
    if (!s.twin.empty())
      run.out.write(file, read_text(run.out.file("fields/contact-" + s.twin + endings[i])));
    else if (made)
      run.out.write(file, s.fields[std::size_t(i)]);
    else {
      write_fields(run, file, complete(*s.model).*rolls[i], stand.steel, state);
      s.fields.push_back(read_text(run.out.file(file)));
    }
  }
}

// Half width, peak pressure and approach at mid-length, and the files of one working load.
void add_section(RunContext &run, Study &s, const FourHigh &stand, const WorkingLoad &load)
{
  const auto section = fem::section_at(*s.model, s.curves, load.force);
  const auto add     = [&](const RowOf<1> &row, const fem::Compared &number, const double closed,
                       const std::string &reference) {
    Parameter p = measured(row.unit, number, load, reference);
    p.checks.push_back({"Hertz line contact", closed, ""});
    p.checks.push_back({coarse_mesh, number.coarse, ""});
    add_check(p, fourier_solver, number.second);
    run.results.add(row.of(s.name), p);
  };
  add(row::contact::half_width, section.half_width, section.hertz.half_width, "at mid-length");
  add(row::contact::peak_pressure, section.peak_pressure, section.hertz.peak_pressure, "at mid-length");
  add(row::contact::approach, section.approach, section.hertz.approach, s.curves.mirrored.reference);
  if (const auto &second = s.curves.second) {
    add_line_load_spread(run, s.name, section.in_stand.load, section.line_load_spread);
    write_curve(run, curve::contact_barrel_second, s.name, barrel_table(second->in_stand_at));
    write_curve(run, curve::contact_second, s.name, curve_table(second->mirrored, "N", "N/m"));
  }

  write_curve(run, curve::contact_barrel, s.name, barrel_table(section.in_stand));
  write_curve(run, curve::contact_barrel_mirrored, s.name, barrel_table(section.mirrored));
  write_study_fields(run, s, stand, section.coarse_state);
}

std::string file_of(const RunContext &run, const Study &s)
{
  return run.cache + "/contact-" + s.key + ".bin";
}

// What an earlier run solved of this contact, of every pair of a model.
std::optional<SolvedStudy> kept_study(RunContext &run, const Study &s)
{
  auto kept = taken_from_cache<SolvedStudy>(run, file_of(run, s), s.key);
  if (kept && kept->pairs.size() != all_pairs(ContactModel()).size())
    return std::nullopt;
  return kept;
}

// A model that knows what was kept of it and makes its rolls when something else is asked.
// @param whole  the model with its rolls, when it is asked for
ContactModel known_model(const FourHigh &stand, const ContactSettings &settings, SolvedStudy &kept,
                         const std::shared_future<ContactModel> &whole)
{
  ContactModel m;
  m.extent         = is_one_sided(stand, settings) ? fem::Extent::whole : fem::Extent::quarter;
  m.closed_form    = closed_form(stand);
  m.completed      = [whole]() -> const ContactModel      &{ return whole.get(); };
  const auto pairs = all_pairs(m);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    *pairs[i]           = std::move(kept.pairs[i].pair);
    pairs[i]->solved    = std::make_shared<fem::SolvedLoads>(std::move(kept.pairs[i].loads));
    pairs[i]->completed = [whole, i]() -> const fem::ContactPair & { return *all_pairs(whole.get())[i]; };
  }
  return m;
}

void take_over(Study &s, SolvedStudy &&kept)
{
  s.curves = {std::move(kept.mirrored), std::move(kept.in_stand), std::move(kept.coarse),
              std::move(kept.in_stand_coarse), std::move(kept.second)};
  s.fields = std::move(kept.fields);
  s.kept   = true;
}

fem::ContactPair without_problem(const fem::ContactPair &pair)
{
  fem::ContactPair light;
  light.name         = pair.name;
  light.reference    = pair.reference;
  light.grid         = pair.grid;
  light.axis         = pair.axis;
  light.axis_support = pair.axis_support;
  light.path         = pair.path;
  light.mean         = pair.mean;
  light.drop         = pair.drop;
  light.radii_sum    = pair.radii_sum;
  light.multiplicity = pair.multiplicity;
  light.axial_mirror = pair.axial_mirror;
  light.tilt         = pair.tilt;
  light.load_offset  = pair.load_offset;
  return light;
}

// Curves and single loads outlive the run once all that is read off them has been.
void keep_study(RunContext &run, Study &s)
{
  if (s.kept)
    return;
  const auto &[mirrored, in_stand, coarse, in_stand_coarse, second] = s.curves;
  SolvedStudy all{mirrored, in_stand, coarse, in_stand_coarse, second, {}, s.fields};
  for (const fem::ContactPair *pair : all_pairs(*s.model))
    all.pairs.push_back({without_problem(*pair), pair->solved->known()});
  keep_in_cache(run, "contact " + s.name, file_of(run, s), s.key, all);
}

// The curves of both engines, side by side.
void sweep_all(RunContext &run, const FourHigh &stand, Study &s, const ContactSettings &settings,
               const std::optional<FourierRolls> &second, const std::array<double, 2> &reach, const double load)
{
  StageTimer timer(run, "contact " + s.name);
  const auto range = fem::log_spaced(reach[0], reach[1], settings.samples);
  // The second curve is smooth, every other load does; the largest is the last of both.
  const auto every_other = fem::log_spaced(reach[0], reach[1], std::max(8, (settings.samples + 1) / 2));
  const auto swept       = [&](ContactCurve &curve, const fem::ContactPair &pair) {
    return [&](RunContext &part_run) { curve = fem::sweep(pair, range, part_run.progress); };
  };
  std::vector<IndependentStage> sweeps;
  if (second)  // the longest
    sweeps.push_back([&](RunContext &part_run) {
      s.curves.second = solve_again(part_run, stand, *second, s.name, settings, every_other, load);
    });
  sweeps.push_back(
      [](RunContext &) { fem::on_mesh(); });  // of rolls from the cache the fields are the first to ask
  sweeps.insert(sweeps.end(),
                {swept(s.curves.mirrored, s.model->mirrored), swept(s.curves.in_stand, s.model->in_stand),
                 swept(s.curves.coarse, s.model->coarse),
                 swept(s.curves.in_stand_coarse, s.model->in_stand_coarse)});
  run_side_by_side(run, std::move(sweeps));
}

Study study_of(RunContext &run, const FourHigh &stand, const std::string &name, const std::string &K,
               const ContactSettings &settings, const std::vector<double> &loads)
{
  const auto range = swept_range(name, settings, loads);
  Study s;
  s.name           = name;
  s.K              = K;
  s.key            = hash_of(contact_inputs(stand, name, settings, loads));
  auto kept        = kept_study(run, s);
  const bool again = second_engine_knows(run, stand, name);  // or says why not
  const auto model = [&run, &stand, &settings, name, most = range[1]] {
    return contact_model(run, stand, name, settings, most);
  };
  if (kept) {
    s.model = std::make_shared<const ContactModel>(
        known_model(stand, settings, *kept, std::async(std::launch::deferred, model).share()));
    take_over(s, std::move(*kept));
    return s;
  }
  std::optional<FourierRolls> second;
  std::vector<IndependentStage> rolls{[&](RunContext &part_run) {
    s.model = std::make_shared<const ContactModel>(contact_model(part_run, stand, name, settings, range[1]));
  }};
  if (again)
    rolls.push_back([&](RunContext &part_run) { second = fourier_rolls(part_run, stand, settings, range[1]); });
  run_side_by_side(run, std::move(rolls));
  sweep_all(run, stand, s, settings, second, range, loads[0]);
  return s;
}

// Upper and lower rolls are the same pair under the same load: solved once.
bool same_contact(const FourHigh &stand)
{
  return !is_one_sided(stand, stand.upper_contact) &&
         record_text(stand.upper_contact) == record_text(stand.lower_contact);
}

Study renamed(Study s, const std::string &name, const std::string &K)
{
  s.twin = s.name;
  s.name = name;
  s.K    = K;
  for (ContactCurve *curve : {&s.curves.mirrored, &s.curves.in_stand, &s.curves.coarse, &s.curves.in_stand_coarse})
    curve->name = name;
  return s;
}

SolvedContact report_study(RunContext &run, const FourHigh &stand, Study &s, const ContactSettings &settings,
                           const std::vector<double> &loads)
{
  const std::string &name = s.name, &K = s.K;
  const auto &range = s.curves.mirrored.load;
  for (const double load : loads)
    require_resolved(run, *s.model, name, settings, load);
  SolvedContact out;
  out.curve          = s.curves.mirrored;
  const auto working = [&](const std::size_t p) {
    return WorkingLoad{p == 0 ? "" : stand.passes[p].name, loads[p],
                       contact_keys(*run.keys, name, p, ContactReading::curve)};
  };
  std::vector<fem::Compared> tangents;
  for (std::size_t p = 0; p < loads.size(); ++p) {
    const auto k                 = fem::stiffness_at(*s.model, s.curves, loads[p]);
    const auto [tangent, secant] = add_stiffness(run, s, working(p), k);
    tangents.push_back(k.tangent);
    out.tangent.push_back(tangent);
    out.secant.push_back(secant);
  }
  add_section(run, s, stand, working(0));
  add_contact_details(run, *s.model, name, K, stand, settings, loads[0], range[range.size() - 1], tangents[0]);
  write_curve(run, curve::contact, name, curve_table(s.curves.mirrored, "N", "N/m"));
  write_curve(run, curve::contact_in_stand, name, curve_table(s.curves.in_stand, "N", "N/m"));
  write_curve(run, curve::contact_closed, name, closed_table(s.model->closed_form, range, "N", "N/m"));
  run.progress.note(fmt::format("contact {}: {} loads, largest complementarity residual {:.1e}", name,
                                range.size(), s.curves.mirrored.residual));
  return out;
}
}  // namespace

std::string in_kN(const double load)
{
  return force_text(load);
}

std::map<std::string, SolvedContact> solve_contacts(RunContext &run, const FourHigh &stand,
                                                    const std::vector<double> &loads)
{
  std::map<std::string, SolvedContact> out;
  const bool upper = !stand.given.count("K3"), lower = !stand.given.count("K5");
  std::vector<Study> studies;
  if (upper)
    studies.push_back(study_of(run, stand, "upper", "K3", stand.upper_contact, loads));
  if (lower)
    studies.push_back(upper && same_contact(stand)
                          ? renamed(studies[0], "lower", "K5")
                          : study_of(run, stand, "lower", "K5", stand.lower_contact, loads));
  for (Study &s : studies) {
    StageTimer timer(run, "contact " + s.name + ", results");
    timer.cached         = s.kept;
    const auto &settings = is_contact(s.name, ContactName::upper) ? stand.upper_contact : stand.lower_contact;
    out[s.name]          = report_study(run, stand, s, settings, loads);
    if (s.twin.empty())
      keep_study(run, s);
  }
  return out;
}
}  // namespace mill
