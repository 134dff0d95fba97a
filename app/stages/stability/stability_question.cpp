#include "app/stages/stability/stability_question.h"
#include "app/run/asked_speeds.h"
#include "app/run/error_warnings.h"
#include "app/stages/stability/gap_mode.h"
#include "core/base/errors.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_chatter.h"
#include "core/records/speed_verdict.h"
#include "dynamics/chatter/excess_growth.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace mill {
namespace {
using dynamics::StandSpeed;
using dynamics::Verdict;

constexpr double least_move = 1e-3;  // of the critical speed, that is worth a result

/// What was found of one pass.
struct Stability {
  StandSpeed critical;
  std::vector<std::pair<std::string, StandSpeed>> others;
  dynamics::SpeedInterval interval;
  std::array<double, 2> by_inputs{not_given, not_given};  ///< m/s, before the other models widen it
  std::optional<dynamics::WorkingPoint> working;          ///< at the speed of the pass
  std::string no_bite;                                    ///< why there is none
  double growth = not_given;                              ///< 1/s there
  bool grows    = false;                                  ///< by more than rounding, (25.9)
  std::complex<double> root;                              ///< 1/s, which grows most there
  GapMode gap;
  LeastDamped least;  ///< there
};

std::string reason_of(const std::exception_ptr &failure)
{
  try {
    std::rethrow_exception(failure);
  } catch (const InputError &error) {
    return error.problems.empty() ? error.what() : error.problems.front().message;
  } catch (const SolverError &error) {
    return error.report.what + (error.report.cause.empty() ? "" : "; " + error.report.cause);
  }
}

void find_working_point(Stability &s, const StabilityQuestion &q)
{
  try {
    s.working                    = dynamics::working_point(q.leading.bite, q.speed, q.leading.scheme);
    const Eigen::VectorXcd roots = dynamics::eigenvalues(dynamics::chatter_matrix(q.leading.stand, s.working->by));
    s.root                       = roots[0];
    s.growth                     = s.root.real();
    s.grows                      = dynamics::excess_growth(roots) > 0;
    s.gap                        = gap_mode(q.leading.stand, s.working->by, q.K4);
    s.least                      = least_damped(q.leading.stand, s.working->by);
  } catch (const InputError &) {
    s.no_bite = reason_of(std::current_exception());
  } catch (const SolverError &) {
    s.no_bite = reason_of(std::current_exception());
  }
}

// The interval reaches to the critical speeds of the other models of the stand.
void widen_by_models(dynamics::SpeedInterval &interval, const double speed, const Stability &s)
{
  for (const auto &[name, other] : s.others)
    if (other.verdict == Verdict::crossing) {
      const double apart = std::log(other.speed / speed);  // (27.13)
      if (apart < 0)                                       // the end on the other side keeps its digits
        interval.low = speed * std::exp(-std::hypot(std::log(speed / interval.low), apart));
      else
        interval.high = speed * std::exp(std::hypot(std::log(interval.high / speed), apart));
    }
}

Stability stability_of(const StabilityQuestion &q)
{
  Stability s;
  const auto search = [&](const dynamics::ChatterStandModel &stand) {
    return dynamics::critical_speed(stand, q.leading.bite, q.leading.scheme, q.leading.range);
  };
  s.critical = search(q.leading.stand);
  for (const auto &[name, stand] : q.others)
    s.others.emplace_back(name, search(stand));
  if (s.critical.verdict == Verdict::crossing) {
    s.interval  = dynamics::speed_interval(q.leading, s.critical, q.uncertain);
    s.by_inputs = {s.interval.low, s.interval.high};
    widen_by_models(s.interval, s.critical.speed, s);
  }
  find_working_point(s, q);
  return s;
}

SpeedVerdict failed_search(const StabilityQuestion &q, const std::string &cause)
{
  SpeedVerdict v;
  v.pass   = q.pass;
  v.speed  = q.speed;
  v.range  = {q.leading.range.from, q.leading.range.to};
  v.cause  = cause;
  v.remedy = "Check friction, tensions and thicknesses of the pass.";
  return v;
}

SpeedVerdict verdict_of(const StabilityQuestion &q, const Stability &s)
{
  if (!s.working)
    return failed_search(
        q, fmt::format("the bite of {} has no steady state at {:.4g} m/s ({})", q.pass, q.speed, s.no_bite));
  SpeedVerdict v;
  v.pass    = q.pass;
  v.speed   = q.speed;
  v.range   = {q.leading.range.from, q.leading.range.to};
  v.growth  = s.growth;
  v.damping = s.gap.damping();
  v.gap     = s.critical.gap;
  if (s.critical.verdict == Verdict::crossing) {
    v.critical  = s.critical.speed;
    v.by_inputs = s.by_inputs;
    for (const dynamics::SpeedShare &share : s.interval.shares)
      v.inputs.push_back({share.name, share.error, share.slope});
    v.low       = s.interval.low;
    v.high      = s.interval.high;
    v.frequency = s.critical.frequency;
    v.mode      = text_of_root(q.leading.stand, s.critical.at->by, {0, 2 * M_PI * s.critical.frequency});
  } else if (s.grows || s.least.sentence.empty()) {
    v.frequency = std::abs(s.root.imag()) / (2 * M_PI);
    v.mode      = text_of_root(q.leading.stand, s.working->by, s.root);
  } else {
    v.frequency = s.least.root.imag() / (2 * M_PI);
    v.mode      = s.least.sentence;
  }
  v.finding = s.grows                                                                 ? SpeedFinding::unstable
              : s.critical.verdict == Verdict::crossing && q.speed < s.critical.speed ? SpeedFinding::below
                                                                                      : SpeedFinding::stable;
  if (v.finding == SpeedFinding::unstable)
    v.remedy = "millstand advise lists what raises the critical speed.";
  return v;
}

struct StabilityAdder {
  RunContext &run;
  const StabilityQuestion &question;
  void operator()(const ResultName &name, const double value, const double speed, const double error = not_given,
                  std::vector<Check> checks = {}) const
  {
    if (std::isnan(value))
      return;
    Parameter p;
    p.value  = value;
    p.unit   = name.row().unit;
    p.method = "eigenvalues of stand, bite and strip; " + question.model;
    if (!std::isnan(speed))
      p.at = {"{}", {{speed, "m/s", ".4g"}}};
    p.error_estimate = error;
    p.checks         = std::move(checks);
    p.inputs         = question.inputs;
    run.results.add(name, p);
  }
};

void add_results(RunContext &run, const StabilityQuestion &q, const Stability &s)
{
  const StabilityAdder add{run, q};
  std::vector<Check> speeds, frequencies;
  for (const auto &[name, other] : s.others)
    if (other.verdict == Verdict::crossing) {
      speeds.push_back({"on " + name, other.speed, "another model of the stand"});
      frequencies.push_back({"on " + name, other.frequency, "another model of the stand"});
    }
  if (s.critical.verdict == Verdict::crossing) {
    const double v     = s.critical.speed;
    const double error = 0.5 * std::log(s.interval.high / s.interval.low);
    add(row::chatter::critical_speed.of(q.pass), v, v, error, speeds);
    add(row::chatter::critical_speed_low.of(q.pass), s.interval.low, v);
    add(row::chatter::critical_speed_high.of(q.pass), s.interval.high, v);
    add(row::chatter::frequency.of(q.pass), s.critical.frequency, v, not_given, frequencies);
    for (const dynamics::SpeedShare &share : s.interval.shares)
      if (std::abs(share.move) > least_move)
        add(row::chatter::speed_slope.of(q.pass, share.name), share.slope, v);
  }
  if (!s.working)
    return;
  add(row::chatter::growth_rate.of(q.pass), s.growth, q.speed);
  add(row::chatter::gap_mode_frequency.of(q.pass), std::abs(s.gap.root.imag()) / (2 * M_PI), q.speed);
  add(row::chatter::gap_mode_damping.of(q.pass), s.gap.damping(), q.speed);
}
}  // namespace

dynamics::SpeedRange speed_range(const ChatterAnalysis &analysis)
{
  dynamics::SpeedRange range;
  range.from = analysis.speeds[0];
  range.to   = analysis.speeds[1];
  range.step = std::min(1., (range.to - range.from) / 10);
  return range;
}

SpeedVerdict speed_verdict(const StabilityQuestion &question)
{
  try {
    return verdict_of(question, stability_of(question));
  } catch (const InputError &) {
    return failed_search(question, reason_of(std::current_exception()));
  } catch (const SolverError &) {
    return failed_search(question, reason_of(std::current_exception()));
  }
}

void add_critical_speed(RunContext &run, const StabilityQuestion &question)
{
  StageTimer timer(run, "critical speed, " + question.pass);
  if (run.asked)
    run.asked->add({question.pass, question.speed, question.leading});
  try {
    const Stability s = stability_of(question);
    add_results(run, question, s);
    run.results.speeds.push_back(verdict_of(question, s));
    if (s.critical.verdict == Verdict::crossing && !question.assumed.empty())
      run.assume(question.assumed);
  } catch (const InputError &) {
    run.results.speeds.push_back(failed_search(question, reason_of(std::current_exception())));
  } catch (const SolverError &) {
    run.results.speeds.push_back(failed_search(question, reason_of(std::current_exception())));
  }
}

void search_critical_speed(RunContext &run, const std::string &pass, const double speed,
                           const std::vector<std::string> &missing,
                           const std::function<StabilityQuestion()> &question)
{
  if (!missing.empty()) {
    run.results.speeds.push_back(not_searched(pass, speed, missing));
    return;
  }
  try {
    add_critical_speed(run, question());
  } catch (const InputError &e) {
    run.warn(warning_of(WarningId::critical_speed_not_searched, e));
  } catch (const SolverError &e) {
    run.warn(speed_not_searched(pass, e));
  }
}
}  // namespace mill
