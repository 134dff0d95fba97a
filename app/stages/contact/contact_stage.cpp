#include "app/stages/contact/contact_stage.h"
#include "app/run/curve_files.h"
#include "app/run/kept_part.h"
#include "app/stages/contact/contact_details.h"
#include "app/stages/contact/contact_files.h"
#include "app/stages/contact/contact_model.h"
#include "app/stages/contact/contact_slope.h"
#include "app/stages/contact/contact_store.h"
#include "app/stages/contact/fourier_stage.h"
#include "core/base/files.h"
#include "core/base/force_text.h"
#include "core/model/four_high.h"
#include "core/numerics/mesh_pair.h"
#include "core/process/parallel.h"
#include "core/records/contact_name.h"
#include "core/records/record_text.h"
#include "core/records/rows_of_contact.h"
#include "fem/body/on_mesh.h"
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
  ContactCurve mirrored, in_stand, coarse, in_stand_coarse;
  std::optional<SecondEngine> second;
  std::string twin;                 // contact that is the same one, already written
  std::string key;                  // of what is solved, in the cache
  bool kept = false;                // all of it was there
  std::vector<std::string> fields;  // VTU files of backup roll and work roll, once they are made
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
// A second opinion widens the error estimate to the spread.
void add_check(Parameter &p, const std::string &who, const double value)
{
  if (std::isnan(value))
    return;
  p.checks.push_back({who, value, ""});
  p.error_estimate = std::fmax(p.error_estimate, difference(value, p.value));  // NaN: none yet
}

Parameter blank(const std::string &unit, const double load, const std::string &reference)
{
  Parameter p;
  p.unit   = unit;
  p.method = "contact FEM, " + reference;
  p.at     = at_force(load);
  return p;
}

const char *const fourier_solver = "Fourier solver";
const char *const coarse_mesh    = "mesh twice as coarse";

// Of a line contact the tangent compliance falls by A/F per newton (3.5b).
void add_curvature(RunContext &run, const Study &s, const std::string &pass, const double F, const double fine,
                   const double coarse, const double second)
{
  if (std::isnan(fine))
    return;
  const auto hertz = reduce::line_contact(s.model->closed_form, F);
  // (3.5a) and (3.5b) differ by one in the bracket.
  const double A_over_L = 1 / hertz.secant - 1 / hertz.tangent;
  Parameter curvature   = blank("N/m2", F, s.mirrored.reference);
  curvature.value       = fine;
  curvature.checks.push_back(
      {"Hertz line contact, K^3 A/(F L)", std::pow(hertz.tangent, 3) * A_over_L / F, "no barrel ends"});
  add_check(curvature, coarse_mesh, coarse);
  add_check(curvature, fourier_solver, second);
  run.results.add(row::roll_contact::curvature.of(pass, s.K), curvature);
}

// Tangent and secant with the rolls held as in the stand: by the same comparisons as those between mirrored
// contacts, each for its own quantity.
void add_held(RunContext &run, const Study &s, const std::string &pass, const double F, const ContactSlope &held,
              const Parameter &tangent, const Parameter &secant)
{
  const auto coarse = slope_at(s.model->in_stand_coarse, s.in_stand_coarse, F, Role::companion);
  std::optional<ContactSlope> second;
  if (s.second)
    second = slope_of(s.second->in_stand, F);
  const auto add = [&](const RowOf<2> &row, const double value, const double on_coarse, const double exact,
                       const double by_second, const Parameter &mirrored) {
    Parameter h      = blank("N/m", F, s.in_stand.reference);
    h.value          = value;
    h.error_estimate = std::max(mesh_pair_error(value, on_coarse), difference(exact, value));
    h.checks.push_back(
        {"rolls squeezed between mirrored contacts", mirrored.value, "another datum and no bending"});
    h.checks.push_back({coarse_mesh, on_coarse, ""});
    add_check(h, fourier_solver, by_second);
    h.inputs.insert(h.inputs.end(), {"strip.width", "backup_roll.bearing_span"});
    run.results.add(row.of(pass, s.K), h);
  };
  add(row::roll_contact::in_stand_tangent, held.tangent, coarse.tangent, held.exact,
      second ? second->tangent : not_given, tangent);
  add(row::roll_contact::in_stand_secant, held.secant, coarse.secant, held.secant,
      second ? second->secant : not_given, secant);
}

// K.tangent, K.secant and their values with the rolls held as in the stand, at one working load.
std::array<Parameter, 2> add_stiffness(RunContext &run, const Study &s, const std::string &pass, const double F)
{
  const auto fine             = slope_at(s.model->mirrored, s.mirrored, F);
  const auto coarse           = slope_at(s.model->coarse, s.coarse, F, Role::companion);
  const auto hertz            = reduce::line_contact(s.model->closed_form, F);
  const auto laws             = reduce::secant_laws(s.model->closed_form, F);
  const auto middle           = fem::barrel_profile(s.model->mirrored, fem::solve_load(s.model->mirrored, F));
  const auto mid              = fem::middle_station(s.model->mirrored.grid);
  const double section_secant = s.model->closed_form.length * middle.line_load[mid] / middle.approach[mid];
  const auto held             = slope_at(s.model->in_stand, s.in_stand, F);
  const std::string held_note = "bending, strip width, backup roll balanced by shear";

  Parameter tangent = blank("N/m", F, s.mirrored.reference);
  Parameter secant  = tangent;
  tangent.value     = fine.tangent;
  tangent.error_estimate =
      std::max(mesh_pair_error(fine.tangent, coarse.tangent), difference(fine.exact, fine.tangent));
  tangent.checks.push_back({"Hertz line contact, infinitely long (3.5b)", hertz.tangent, "no barrel ends"});
  tangent.checks.push_back({"active set of this one load (2.8)", fine.exact, "steps as nodes come into contact"});
  tangent.checks.push_back({coarse_mesh, coarse.tangent, ""});
  tangent.checks.push_back(check(CheckId::held_as_in_stand, held.tangent, held_note));
  secant.value          = fine.secant;
  secant.error_estimate = mesh_pair_error(fine.secant, coarse.secant);
  secant.checks.push_back(check(CheckId::johnson_secant, hertz.secant, "upper end of the band of closed forms"));
  secant.checks.push_back({"Foeppl (3.8)", laws.foeppl, ""});
  secant.checks.push_back({"half space (3.9)", laws.half_space, ""});
  secant.checks.push_back({"Palmgren (3.10)", laws.palmgren, "lower end of the band"});
  secant.checks.push_back(
      check(CheckId::middle_section, section_secant, "the remaining difference belongs to the barrel ends"));
  secant.checks.push_back({coarse_mesh, coarse.secant, ""});
  secant.checks.push_back(check(CheckId::held_as_in_stand, held.secant, held_note));
  std::optional<ContactSlope> second;
  if (s.second) {
    second = slope_of(s.second->mirrored, F);
    add_check(tangent, fourier_solver, second->tangent);
    add_check(secant, fourier_solver, second->secant);
  }
  run.results.add(row::roll_contact::tangent.of(pass, s.K), tangent);
  run.results.add(row::roll_contact::secant.of(pass, s.K), secant);
  add_curvature(run, s, pass, F, fine.curvature, coarse.curvature, second ? second->curvature : not_given);
  add_held(run, s, pass, F, held, tangent, secant);
  const double effect = held.tangent / fine.tangent - 1;
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
  if (middle.half_width[mid] == 0)
    run.warn(of_contact(WarningId::contact_partly_open, s.name,
                        fmt::format("at {} the rolls do not touch at mid-length", in_kN(F)), ""));
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
void add_section(RunContext &run, Study &s, const FourHigh &stand, const double F)
{
  const auto point  = fem::solve_load(s.model->mirrored, F);
  const auto point2 = fem::solve_load(s.model->coarse, F);
  const auto fine   = fem::barrel_profile(s.model->mirrored, point);
  const auto coarse = fem::barrel_profile(s.model->coarse, point2);
  const auto held   = fem::barrel_profile(s.model->in_stand, fem::solve_load(s.model->in_stand, F));
  const auto hertz  = reduce::line_contact(s.model->closed_form, F);
  const auto mid = fem::middle_station(s.model->mirrored.grid), mid2 = fem::middle_station(s.model->coarse.grid);
  // Half width and peak are fitted apart (1.4); a parabola of them must carry the line load again.
  const double misfit =
      std::abs(0.5 * M_PI * fine.half_width[mid] * fine.peak_pressure[mid] / fine.line_load[mid] - 1);
  const auto add = [&](const RowOf<1> &row, const double value, const double second, const double other,
                       const double closed, const std::string &reference, const double least_error) {
    Parameter p      = blank(row.unit, F, reference);
    p.value          = value;
    p.error_estimate = std::max(mesh_pair_error(value, second), least_error);
    p.checks.push_back({"Hertz line contact", closed, ""});
    p.checks.push_back({coarse_mesh, second, ""});
    add_check(p, fourier_solver, other);
    run.results.add(row.of(s.name), p);
  };
  const auto at_middle = [&](const Eigen::VectorXd &values) {
    return s.second ? values[s.model->mirrored.grid.whole ? values.size() / 2 : 0] : not_given;
  };
  const BarrelProfile other = s.second ? s.second->mirrored_at : BarrelProfile();
  add(row::contact::half_width, fine.half_width[mid], coarse.half_width[mid2], at_middle(other.half_width),
      hertz.half_width, "at mid-length", misfit);
  add(row::contact::peak_pressure, fine.peak_pressure[mid], coarse.peak_pressure[mid2],
      at_middle(other.peak_pressure), hertz.peak_pressure, "at mid-length", misfit);
  add(row::contact::approach, point.approach, point2.approach,
      s.second ? F / slope_of(s.second->mirrored, F).secant : not_given, hertz.approach, s.mirrored.reference, 0);
  if (s.second) {
    add_line_load_spread(run, s.name, held, s.second->in_stand_at);
    write_curve(run, curve::contact_barrel_second, s.name, barrel_table(s.second->in_stand_at));
    write_curve(run, curve::contact_second, s.name, curve_table(s.second->mirrored, "N", "N/m"));
  }

  write_curve(run, curve::contact_barrel, s.name, barrel_table(held));
  write_curve(run, curve::contact_barrel_mirrored, s.name, barrel_table(fine));
  write_study_fields(run, s, stand, point2.state);
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
  s.mirrored        = std::move(kept.mirrored);
  s.in_stand        = std::move(kept.in_stand);
  s.coarse          = std::move(kept.coarse);
  s.in_stand_coarse = std::move(kept.in_stand_coarse);
  s.second          = std::move(kept.second);
  s.fields          = std::move(kept.fields);
  s.kept            = true;
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
  SolvedStudy all{s.mirrored, s.in_stand, s.coarse, s.in_stand_coarse, s.second, {}, s.fields};
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
      s.second = solve_again(part_run, stand, *second, s.name, settings, every_other, load);
    });
  sweeps.push_back(
      [](RunContext &) { fem::on_mesh(); });  // of rolls from the cache the fields are the first to ask
  sweeps.insert(sweeps.end(),
                {swept(s.mirrored, s.model->mirrored), swept(s.in_stand, s.model->in_stand),
                 swept(s.coarse, s.model->coarse), swept(s.in_stand_coarse, s.model->in_stand_coarse)});
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
  for (ContactCurve *curve : {&s.mirrored, &s.in_stand, &s.coarse, &s.in_stand_coarse})
    curve->name = name;
  return s;
}

SolvedContact report_study(RunContext &run, const FourHigh &stand, Study &s, const ContactSettings &settings,
                           const std::vector<double> &loads)
{
  const std::string &name = s.name, &K = s.K;
  const auto &range = s.mirrored.load;
  for (const double load : loads)
    require_resolved(run, *s.model, name, settings, load);
  SolvedContact out;
  out.curve = s.mirrored;
  for (std::size_t p = 0; p < loads.size(); ++p) {
    const auto [tangent, secant] = add_stiffness(run, s, p == 0 ? "" : stand.passes[p].name, loads[p]);
    out.tangent.push_back(tangent);
    out.secant.push_back(secant);
  }
  add_section(run, s, stand, loads[0]);
  add_contact_details(run, *s.model, name, K, stand, settings, loads[0], range[range.size() - 1], out.tangent[0]);
  write_curve(run, curve::contact, name, curve_table(s.mirrored, "N", "N/m"));
  write_curve(run, curve::contact_in_stand, name, curve_table(s.in_stand, "N", "N/m"));
  write_curve(run, curve::contact_closed, name, closed_table(s.model->closed_form, range, "N", "N/m"));
  run.progress.note(fmt::format("contact {}: {} loads, largest complementarity residual {:.1e}", name,
                                range.size(), s.mirrored.residual));
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
