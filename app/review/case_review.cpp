#include "app/review/case_review.h"
#include "app/review/closed_form_modes.h"
#include "app/review/record_review.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/stability/critical_speed_stage.h"
#include "core/case/lumped_model_toml.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/model/lumped.h"
#include "core/records/contact_name.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_stand.h"
#include "reduce/chain/frame_closure.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace mill {
namespace {
// Factors between two numbers that should be one: noise and models differ by less, units by thousands.
constexpr double of_another_unit = 50, of_another_strip = 1.3, impossible_bite = 100;

std::string force_text(const double load)
{
  return load >= 1e6 ? fmt::format("{:.4g} MN", load / 1e6) : fmt::format("{:.4g} kN", load / 1e3);
}

double factor_between(const double a, const double b)
{
  return a > 0 && b > 0 ? std::max(a / b, b / a) : 1;
}

Place place_of(const Case &the_case, const std::string &key, const Place &otherwise)
{
  const auto entry = the_case.places.find(key);
  return entry == the_case.places.end() ? otherwise : entry->second;
}

// The record of each pass; one without has an empty one.
std::vector<ForceRecord> records_of(const std::vector<Pass> &passes)
{
  std::vector<ForceRecord> records;
  for (const Pass &pass : passes)
    records.push_back(has_force(pass) ? force_of(pass) : ForceRecord{});
  return records;
}

std::vector<Pass> with_force(std::vector<Pass> passes, const std::string &force_file)
{
  if (!force_file.empty())
    for (Pass &pass : passes)
      pass.force_file = force_file;
  return passes;
}

// A place that can be shown as related to another; a synthetic record has none.
std::vector<Place> of_file(const Place &place)
{
  return place.line > 0 ? std::vector<Place>{place} : std::vector<Place>{};
}

// The load of a pass against the mean of its record.
void review_load(const Case &the_case, const Pass &pass, const std::size_t p, const double mean,
                 CaseReview &review)
{
  const Place place = place_of(the_case, fmt::format("pass.{}.load", p), pass.place);
  if (!(mean > 0))
    review.warnings.push_back({WarningId::force_not_positive,
                               pass.name,
                               fmt::format("the mean of the force record is {}", in_kN(mean)),
                               "a rolling force is positive when it opens the stand",
                               "",
                               {},
                               "",
                               pass.force_place});
  if (std::isnan(pass.load) || !(mean > 0))
    return;
  const double factor = factor_between(pass.load, mean);
  if (factor > of_another_unit)
    review.problems.push_back({place,
                               fmt::format("{}: pass.load is {}, the mean of its force record {}, a factor of "
                                           "{:.4g}; one of the two is in another unit",
                                           pass.name, force_text(pass.load), force_text(mean), factor),
                               of_file(pass.force_place)});
  else if (auto warning = load_against_record(pass, p, mean)) {
    warning->place   = place;
    warning->related = of_file(pass.force_place);
    review.said_by_run.push_back(std::move(*warning));
  }
}

// Force of the bite by Karman's slab on Hitchcock's arc; nothing where it has no answer or K4 is given.
std::optional<double> slab_force(const FourHigh &stand, const Pass &pass)
{
  if (stand.given.count("K4"))
    return {};
  try {
    const auto bite = bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel);
    return bite::solve_slab(bite, {bite::Theory::karman, bite::Arc::hitchcock, 0}).force;
  } catch (const InputError &) {
  } catch (const SolverError &) {
  }
  return {};
}

void review_bite(const FourHigh &stand, const Pass &pass, const double load, CaseReview &review)
{
  const auto force = slab_force(stand, pass);
  if (!force || !(load > 0))
    return;
  const double factor = factor_between(*force, load);
  const std::string forces =
      fmt::format("by the slab theory this strip takes a rolling force of {}, the load is {}", force_text(*force),
                  force_text(load));
  if (factor > impossible_bite)
    review.problems.push_back(
        {pass.place,
         fmt::format("{}: {}, a factor of {:.3g}; is one of load, flow stress, width and thicknesses "
                     "in another unit? given.K4 leaves the strip out",
                     pass.name, forces, factor),
         {}});
  else if (factor > of_another_strip)
    review.said_by_run.push_back({WarningId::bite_force,
                                  pass.name,
                                  fmt::format("{} ({:+.0f} %)", forces, 100 * (*force / load - 1)),
                                  "",
                                  "check flow stress, friction and thicknesses",
                                  {result_name({family::bite, pass.name})},
                                  "",
                                  pass.place});
}

void review_theory(const FourHigh &stand, const Pass &pass, CaseReview &review)
{
  if (stand.given.count("K4"))
    return;
  if (auto warning = bite_without_theory(bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel),
                                         stand.bite, pass))
    review.said_by_run.push_back(std::move(*warning));
}

bool is_same(const Place &a, const Place &b)
{
  return !(a < b) && !(b < a);
}

// Of the six masses by closed forms at the load of the first pass.  A mill modulus that leaves nothing for the
// frame is refused here, before the finite elements.
ExpectedModes expected_modes(const FourHigh &stand, const double load, CaseReview &review)
{
  ExpectedModes modes;
  modes.damping = stand.dynamics.modal_damping;
  try {
    for (const ClosedFormResult &r : closed_form_stand(stand, load))
      if (const auto id = result_id(r.name); id && id->is_of(row::modes::vertical) && id->place("open").empty()) {
        modes.lowest  = modes.lowest > 0 ? std::min(modes.lowest, r.parameter.value) : r.parameter.value;
        modes.highest = std::max(modes.highest, r.parameter.value);
      }
  } catch (const InputError &error) {  // the run says other problems with their place
    for (const Problem &problem : error.problems)
      if (reduce::is_closed(stand.frame) && is_same(problem.place, stand.frame.modulus_place))
        review.problems.push_back(problem);
  } catch (const SolverError &) {
  }
  return modes;
}

// Of a stand in files those that the case names, which a run finds again or refuses.
ExpectedModes modes_of(const Case &the_case, const DynamicsSettings &settings)
{
  if (const auto &lumped = std::get<Lumped>(the_case.spec); lumped.detailed) {
    ExpectedModes named{0, 0, settings.modal_damping};
    for (const auto &[number, frequency] : lumped.model.modes)
      if (frequency <= lumped.model.frequency_limit) {
        named.lowest  = named.lowest > 0 ? std::min(named.lowest, frequency) : frequency;
        named.highest = std::max(named.highest, frequency);
      }
    return named;
  }
  const auto frequency = chain_modes(lumped_model_of(the_case), settings).modes.frequency;
  return {frequency.minCoeff(), frequency.maxCoeff(), settings.modal_damping};
}
}  // namespace

void review_speed(const Pass &pass, const std::vector<std::string> &missing, CaseReview &review)
{
  if (!missing.empty())
    review.said_by_run.push_back(warning_of(not_searched(pass.name, pass.speed, missing), pass.place));
}

CaseReview review_stand(const Case &the_case, const std::string &force_file)
{
  const auto &stand  = std::get<FourHigh>(the_case.spec);
  const auto passes  = with_force(stand.passes, force_file);
  const auto records = records_of(passes);
  CaseReview review;
  std::vector<double> loads;
  for (std::size_t p = 0; p < passes.size(); ++p)
    loads.push_back(working_load(passes[p], records[p]));
  const ExpectedModes modes = expected_modes(stand, loads.front(), review);
  for (std::size_t p = 0; p < passes.size(); ++p) {
    if (has_force(passes[p])) {
      review_load(the_case, passes[p], p, records[p].force.mean(), review);
      review_records(passes[p], records[p], modes, review);
    }
    review_bite(stand, passes[p], loads[p], review);
    review_theory(stand, passes[p], review);
    review_speed(passes[p], missing_for_critical_speed(the_case, stand, p), review);
  }
  for (const auto &[name, contact] : {std::pair(word_of(ContactName::upper), &stand.upper_contact),
                                      std::pair(word_of(ContactName::lower), &stand.lower_contact)})
    if (!stand.given.count(spring_of_contact(name)))
      try {
        swept_range(name, *contact, loads);
      } catch (const InputError &e) {
        review.problems.insert(review.problems.end(), e.problems.begin(), e.problems.end());
      }
  return review;
}

CaseReview review_lumped(const Case &the_case, const std::string &force_file)
{
  const auto &lumped = std::get<Lumped>(the_case.spec);
  const auto passes  = with_force(lumped.passes, force_file);
  const auto records = records_of(passes);
  CaseReview review;
  const ExpectedModes modes = modes_of(the_case, lumped.dynamics);
  for (std::size_t p = 0; p < passes.size(); ++p)
    if (has_force(passes[p])) {
      review_load(the_case, passes[p], p, records[p].force.mean(), review);
      review_records(passes[p], records[p], modes, review);
    }
  return review;
}
}  // namespace mill
