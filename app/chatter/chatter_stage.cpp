#include "app/chatter/chatter_stage.h"
#include "app/chatter/chatter_files.h"
#include "app/chatter/chatter_question.h"
#include "app/chatter/chatter_results.h"
#include "app/run/asked_speeds.h"
#include "app/run/error_warnings.h"
#include "core/laws/flow_stress_law.h"
#include "core/model/case.h"
#include <cmath>
#include <exception>
#include <fmt/format.h>

namespace mill {
namespace {
void check_tension(const Case &the_case, const std::string &key, const double tension, const double flow_stress,
                   std::vector<Problem> &problems)
{
  if (tension < flow_stress)
    return;
  const auto place = the_case.places.find(key);
  problems.push_back({place == the_case.places.end() ? Place{the_case.path} : place->second,
                      fmt::format("{} = {:.6g} MPa would stretch the strip outside the bite, whose flow stress is "
                                  "{:.6g} MPa there; lower the tension",
                                  key, tension / 1e6, flow_stress / 1e6),
                      {}});
}

void finish(RunContext &run, const ChatterStudy &study)
{
  add_chatter_results(run, study);
  write_chatter(run, study);
  run.summary += verdict_sentence(study) + "\n";
  const ChatterQuestion &q = study.question;
  if (run.asked)
    run.asked->add({q.condition.name, q.condition.speed, {q.stand, 0, q.bite, q.scheme, chatter_range(q)}});
}
}  // namespace

void check_conditions(const Case &the_case)
{
  const auto &spec = std::get<ChatterCase>(the_case.spec);
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < spec.conditions.size(); ++i) {
    const RollingCondition &c = spec.conditions[i];
    const double initial =
        std::isnan(spec.strip.initial_thickness) ? c.entry_thickness : spec.strip.initial_thickness;
    const auto check = [&](const char *which, const double tension, const double thickness) {
      try {
        check_tension(the_case, fmt::format("condition.{}.{}", i, which), tension,
                      bite::flow_stress(spec.strip.flow_stress, std::log(initial / thickness)), problems);
      } catch (const InputError &e) {
        problems.push_back({c.place, "condition \"" + c.name + "\": " + e.problems.front().message, {}});
      }
    };
    check("entry_tension", c.entry_tension, c.entry_thickness);
    check("exit_tension", c.exit_tension, c.exit_thickness);
  }
  if (!problems.empty())
    throw InputError(std::move(problems));
}

void solve_chatter_case(RunContext &run, const ChatterCase &spec)
{
  std::vector<ChatterStudy> studies;
  std::exception_ptr failure;
  for (std::size_t i = 0; i < spec.conditions.size(); ++i) {
    try {
      studies.push_back(study_chatter(run, chatter_question(spec, i, run.keys.get())));
      finish(run, studies.back());
    } catch (const SolverError &e) {  // the others still have an answer
      failure = std::current_exception();
      run.warn(warning_of(WarningId::chatter_refused, e));
    }
    run.progress.at("chatter", double(i + 1) / double(spec.conditions.size()));
  }
  if (!failure)
    try {
      solve_tandem(run, spec);
    } catch (const SystemError &) {  // a full disk says nothing about the tandem
      throw;
    } catch (const InputError &e) {  // the stands for themselves have their answer
      run.warn(warning_of(WarningId::chatter_refused, e));
    } catch (const SolverError &e) {
      failure = std::current_exception();
      run.warn(warning_of(WarningId::chatter_refused, e));
    }
  run.assume(
      "the flattened radius and the far ends of the strip do not follow the vibration; friction forces have no "
      "part in the vertical force; the far stands run at constant speed");
  if (has_film(spec.strip.friction) && spec.strip.friction.film_factor == 3)
    run.assume(
        "film factor 3 is that of the source of the published friction law; the inlet film of Wilson and Walowit "
        "has 3/2, and a friction law goes with the factor it was fitted with");
  if ((spec.model || spec.files) && std::isnan(spec.stand.dampings[0]))
    run.assume(fmt::format("modal damping of {:g} % in every mode of the stand, as {} says",
                           100 * spec.modal_damping, spec.stand.from));
  if (const std::string table = published_table(studies); !table.empty())
    run.summary += "\n" + table;
  if (failure)
    std::rethrow_exception(failure);
}

void solve_stand_chatter(RunContext &run, const FourHigh &stand, const Pass &pass,
                         const reduce::LumpedStand &chain, const StandModels &models)
{
  const StandQuestion asked = chatter_question(stand, pass, chain, models);
  for (const std::string &sentence : asked.assumed)
    run.assume(sentence);
  finish(run, study_chatter(run, asked.question));
}
}  // namespace mill
