#include "app/review/record_review.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "dynamics/response/record_times.h"
#include "dynamics/response/rolling_force.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double decay_times = 5;  // after which 0.7 % of a transient is left

std::string of_hertz(const double f)
{
  return f > 9999.5 ? fmt::format("{:.4g} kHz", f / 1e3) : fmt::format("{:.4g} Hz", f);
}

Warning of_record(const WarningId id, const Pass &pass, const Place &place, std::string fact, std::string detail,
                  std::string remedy = "")
{
  return {id, pass.name, std::move(fact), std::move(detail), std::move(remedy), {pass.name}, "", place};
}

void add_times(const Pass &pass, const Place &place, const char *what, const dynamics::RecordTimes &times,
               const std::string &more, CaseReview &review)
{
  review.facts.push_back(fmt::format("{}: the {} lasts {:.4g} s, {} samples at {}{}", pass.name, what,
                                     times.duration, times.samples, of_hertz(1 / times.step), more));
  if (times.n_gaps > 0)
    review.warnings.push_back(
        of_record(WarningId::record_gap, pass, place,
                  fmt::format("the {} has {}, the longest of {:.3g} s at {:.4g} s", what,
                              times.n_gaps == 1 ? "a gap" : fmt::format("{} gaps", times.n_gaps),
                              times.longest_gap, times.longest_at),
                  fmt::format("straight lines fill {}", times.n_gaps == 1 ? "it" : "them")));
}

void judge_length(const Pass &pass, const double duration, const ExpectedModes &modes, CaseReview &review)
{
  const double needed = needed_duration(modes);
  if (duration >= needed)
    return;
  review.warnings.push_back(of_record(
      WarningId::record_short, pass, pass.force_place,
      fmt::format("the force record lasts {:.3g} s; the lowest mode to be expected, at {:.3g} Hz by closed forms, "
                  "takes {:.3g} s to build up (five decay times at {:g} % damping)",
                  duration, modes.lowest, needed, 100 * modes.damping),
      "peaks and rms are those of a start", "give a longer record"));
}

void review_measured(const Pass &pass, const ForceRecord &force, const ExpectedModes &modes, CaseReview &review)
{
  const MeasuredRecord measured = measured_of(pass, force);
  const auto times              = dynamics::record_times(measured.time);
  add_times(pass, pass.measured_place, "measured record", times, "", review);
  const auto last = [](const Eigen::VectorXd &t) { return t[t.size() - 1]; };
  if (measured.time[0] >= last(force.time) || last(measured.time) <= force.time[0])
    review.problems.push_back(
        {pass.measured_place,
         fmt::format(
             "{}: the measured record, {:.4g} .. {:.4g} s, and the force record, {:.4g} .. {:.4g} s, have no "
             "time in common; count both from the same moment",
             pass.name, measured.time[0], last(measured.time), force.time[0], last(force.time)),
         {pass.force_place}});
  const double nyquist = 0.5 / times.step;
  if (nyquist < modes.highest)
    review.warnings.push_back(of_record(
        WarningId::measured_record_coarse, pass, pass.measured_place,
        fmt::format("the measured record is sampled at {} and shows nothing above {}", of_hertz(1 / times.step),
                    of_hertz(nyquist)),
        fmt::format("the highest mode to be expected is at {} by closed forms", of_hertz(modes.highest))));
}
}  // namespace

double needed_duration(const ExpectedModes &modes)
{
  return modes.lowest > 0 && modes.damping > 0 ? decay_times / (2 * M_PI * modes.damping * modes.lowest) : 0;
}

void review_records(const Pass &pass, const ForceRecord &force, const ExpectedModes &modes, CaseReview &review)
{
  const auto times = dynamics::record_times(force.time);
  add_times(pass, pass.force_place,
            pass.force_file.empty() ? "noise that represents a force record" : "force record", times,
            ", mean " + in_kN(force.force.mean()), review);
  for (const std::string &note : force.notes)
    review.facts.push_back(pass.name + ": " + note);
  judge_length(pass, times.duration, modes, review);
  if (modes.highest > 0)
    if (auto warning = dynamics::bandwidth_warning(dynamics::force_statistics(force), modes.highest)) {
      warning->subject = pass.name;
      warning->detail += " (mode by closed forms)";
      warning->place = pass.force_place;
      review.said_by_run.push_back(std::move(*warning));
    }
  if (!pass.measured_file.empty())
    review_measured(pass, force, modes, review);
}
}  // namespace mill
