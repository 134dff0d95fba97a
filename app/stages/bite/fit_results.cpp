#include "app/stages/bite/fit_results.h"
#include "app/run/curve_files.h"
#include "core/base/short_number.h"
#include "core/records/csv.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bite.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace mill {
namespace {
using bite::FitAnswer;
using bite::FitDatum;
using bite::FitUnknown;
using Eigen::Index;
using UnknownRole = FitUnknown::Role;

/// A fitted number as results call it.
struct FittedNumber {
  std::string name, unit;
  double base = 1;  // what the factor of the fit multiplies
  double at(const double log_factor) const
  {
    return base * std::exp(log_factor);
  }
};

FittedNumber number_of(const FitUnknown &unknown, const Strip &start)
{
  const Friction &law = start.friction;
  if (unknown.role == UnknownRole::flow_stress)
    return {"flow_stress_factor", "1", 1};
  if (unknown.role == UnknownRole::friction)
    return is_a_number(law) ? FittedNumber{"friction", "1", friction_value(law, law.coefficient)}
                            : FittedNumber{"friction_factor", "1", 1};
  for (const FrictionConstant &constant : friction_constants())
    if (constant.member == unknown.constant)
      return {unknown.name, constant.si_unit, law.*constant.member};
  return {unknown.name, "1", 1};
}

const Strip &start_of(const FitAnswer &answer)
{
  return answer.problem.passes.front().bite.strip;
}

std::optional<std::size_t> place_of(const FitAnswer &answer, const UnknownRole role)
{
  const auto &unknowns = answer.problem.unknowns;
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].role == role)
      return i;
  return std::nullopt;
}

std::string models_text(const StripFit &fit)
{
  if (fit.models.empty())
    return "Karman slab";
  std::string text;
  for (const std::string &model : fit.models)
    if (!model.empty() && text.find(model) == std::string::npos)
      text += (text.empty() ? "" : " and ") + model;
  return text;
}

/// "6 measured values of 3 passes"
std::string data_text(const FitAnswer &answer)
{
  const auto data = data_of(answer.problem);
  std::vector<std::size_t> passes;
  for (const FitDatum &datum : data)
    if (passes.empty() || passes.back() != datum.pass)
      passes.push_back(datum.pass);
  return fmt::format("{} measured value{} of {} pass{}", data.size(), data.size() == 1 ? "" : "s", passes.size(),
                     passes.size() == 1 ? "" : "es");
}

/// "friction +10 % with flow_stress -4.1 %"
std::string direction_text(const bite::FitDirection &direction, const std::vector<FitUnknown> &unknowns)
{
  const double scale = std::log(1.1) / direction.unit.cwiseAbs().maxCoeff();
  std::string text;
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    text += fmt::format("{}{} {:+.2g} %", text.empty() ? "" : " with ", unknowns[i].name,
                        100 * std::expm1(scale * direction.unit[Index(i)]));
  return text;
}

Parameter plain(const StripFit &fit, const std::string &unit, const double value, const std::string &method)
{
  Parameter p;
  p.unit   = unit;
  p.value  = value;
  p.method = method;
  p.at     = data_text(fit.answer);
  p.inputs = fit.inputs;
  return p;
}

void add_numbers(RunContext &run, const StripFit &fit)
{
  const FitAnswer &answer = fit.answer;
  const std::string by    = "least squares of the measured values by " + models_text(fit);
  for (std::size_t i = 0; i < answer.problem.unknowns.size(); ++i) {
    const FittedNumber number   = number_of(answer.problem.unknowns[i], start_of(answer));
    const bite::FitInterval &in = answer.intervals[i];
    const double value = number.at(answer.best.x[Index(i)]), low = number.at(in.low), high = number.at(in.high);
    Parameter p           = plain(fit, number.unit, value, by);
    p.error_estimate      = std::max(value - low, high - value) / value;
    const FitAnswer &slab = fit.slab;
    if (!fit.models.empty() && slab.problem.unknowns.size() == answer.problem.unknowns.size())
      p.checks.push_back(
          {"by Karman's slab alone", number.at(slab.best.x[Index(i)]), "without the model of the run"});
    run.results.add(row::bite_fit::number.of(number.name), p);
    const std::string interval = "end of the 95 % interval, other numbers following";
    const std::string open     = "; no such pass exists beyond";
    run.results.add(row::bite_fit::number_low.of(number.name),
                    plain(fit, number.unit, low, interval + (in.low_open ? open : "")));
    run.results.add(row::bite_fit::number_high.of(number.name),
                    plain(fit, number.unit, high, interval + (in.high_open ? open : "")));
  }
  for (const bite::KeptUnknown &kept : answer.kept) {
    const FittedNumber number = number_of(kept.unknown, start_of(answer));
    Parameter p = plain(fit, number.unit, number.base, "kept, for the measured values do not tell it");
    p.source    = Source::given;
    run.results.add(row::bite_fit::number.of(number.name), p);
  }
}

void add_quality(RunContext &run, const StripFit &fit)
{
  const FitAnswer &answer = fit.answer;
  const auto data         = data_of(answer.problem);
  const Index n           = Index(answer.problem.unknowns.size());
  const auto friction     = place_of(answer, UnknownRole::friction),
             stress       = place_of(answer, UnknownRole::flow_stress);
  if (friction && stress) {
    const Eigen::MatrixXd c = covariance_of(answer.best);
    const auto i = Index(*friction), j = Index(*stress);
    run.results.add(row::bite_fit::correlation.of(), plain(fit, "1", c(i, j) / std::sqrt(c(i, i) * c(j, j)),
                                                           "of friction and flow stress, at the fitted point"));
  }
  run.results.add(row::bite_fit::misfit.of(),
                  plain(fit, "1", answer.best.misfit, "sum of squares of model less measured over deviation"));
  run.results.add(row::bite_fit::freedom.of(),
                  plain(fit, "1", double(Index(data.size()) - n), "data less unknowns"));
  const bite::FitDirection worst = directions_of(answer.best).front();
  run.results.add(row::bite_fit::worst_deviation.of(),
                  plain(fit, "1", worst.deviation,
                        "standard deviation of logarithms along the direction known worst: " +
                            direction_text(worst, answer.problem.unknowns)));
  for (Index i = 0; i < n; ++i)
    run.results.add(row::bite_fit::worst.of(answer.problem.unknowns[std::size_t(i)].name),
                    plain(fit, "1", worst.unit[i], "share in the direction known worst, of logarithms"));
  for (std::size_t i = 0; i < data.size(); ++i)
    run.results.add(
        row::bite_fit::residual.of(answer.problem.passes[data[i].pass].name, word_of(data[i].kind)),
        plain(fit, "1", answer.best.residual[Index(i)], "model less measured, in standard deviations"));
}

/// "friction 0.0843 (0.079 to 0.0899)"
std::string numbers_text(const FitAnswer &answer)
{
  std::string text;
  for (std::size_t i = 0; i < answer.problem.unknowns.size(); ++i) {
    const FittedNumber number = number_of(answer.problem.unknowns[i], start_of(answer));
    text += fmt::format("{}{} {} ({} to {})", text.empty() ? "" : ", ", number.name,
                        short_number(number.at(answer.best.x[Index(i)])),
                        short_number(number.at(answer.intervals[i].low)),
                        short_number(number.at(answer.intervals[i].high)));
  }
  return text;
}

const std::string about = "fit of the bite";

std::vector<std::string> concerned_by_fit()
{
  return {result_name({family::bite, bite_fit}), family::bite_spring};
}

void note_kept(RunContext &run, const StripFit &fit)
{
  const BiteSetup &setup = fit.question.setup;
  const bool alone       = setup.fit.size() == 1;
  for (const bite::KeptUnknown &kept : fit.answer.kept) {
    const FittedNumber number = number_of(kept.unknown, start_of(fit.answer));
    const std::string remedy  = !alone ? "measure another reduction, or fix one number by bite.fit_for"
                                : setup.fit.front() == PassMeasure::slip
                                    ? "add \"force\" to bite.fit"
                                    : "add \"slip\" to bite.fit and forward_slip to the passes";
    run.warn({WarningId::fit_one_number, about,
              fmt::format("{} one number",
                          alone ? std::string("the ") + word_of(setup.fit.front()) + " alone gives"
                                : data_text(fit.answer) + " determine, as far as they are distinguishable,"),
              fmt::format(
                  "{} stays {}, for {} leaves the measured values where they are{}", number.name,
                  short_number(number.base), direction_text(kept.direction, kept.among),
                  std::isfinite(kept.direction.deviation)
                      ? fmt::format(" (a standard deviation of {:.2g} % along it)", 100 * kept.direction.deviation)
                      : ""),
              remedy, concerned_by_fit(), "bite.fit"});
  }
}

void note_quality(RunContext &run, const StripFit &fit)
{
  const FitAnswer &answer = fit.answer;
  const auto data         = data_of(answer.problem);
  const int freedom       = int(data.size()) - int(answer.problem.unknowns.size());
  if (freedom > 0 && answer.best.misfit > bite::largest_likely_misfit(freedom)) {
    Index worst;
    answer.best.residual.cwiseAbs().maxCoeff(&worst);
    const FitDatum &datum = data[std::size_t(worst)];
    run.warn(
        {WarningId::fit_scatter, about, "the measured values do not fit together",
         fmt::format("sum of squares {} with {} degrees of freedom, which chance exceeds beyond {} in one of a "
                     "hundred cases; farthest off is the {} of {}, by {:.1f} standard deviations; the "
                     "intervals are too narrow",
                     short_number(answer.best.misfit), freedom, short_number(bite::largest_likely_misfit(freedom)),
                     word_of(datum.kind), answer.problem.passes[datum.pass].name,
                     std::abs(answer.best.residual[worst])),
         "", concerned_by_fit()});
  }
  if (answer.best.at_edge)
    run.warn({WarningId::fit_at_edge, about,
              "the best friction and flow stress lie where the rolls no longer take a pass, next to skidding "
              "or to rolls that flatten without limit",
              "the values are those of the edge", "", concerned_by_fit()});
  for (std::size_t i = 0; i < answer.intervals.size(); ++i)
    if (answer.intervals[i].low_open || answer.intervals[i].high_open)
      run.warn({WarningId::fit_interval_open, about,
                fmt::format("the measured values do not bound {} {}", answer.problem.unknowns[i].name,
                            answer.intervals[i].low_open ? "from below" : "from above"),
                "its interval ends where no such pass exists or the factor on the case's value is 20", "",
                concerned_by_fit()});
  if (!fit.uncorrected.empty())
    run.warn({WarningId::fit_by_slab, about,
              "by Karman's slab, since the model of the run has no answer for the fitted strip", fit.uncorrected,
              "", concerned_by_fit()});
}
}  // namespace

void add_fit_results(RunContext &run, const StripFit &fit)
{
  add_numbers(run, fit);
  add_quality(run, fit);
}

void note_fit(RunContext &run, const StripFit &fit)
{
  const FitAnswer &answer = fit.answer;
  run.assume(
      fmt::format("{}{} with 95 %, from {} by {}; bite and K4 are those of the fitted strip. The intervals hold "
                  "the deviations of the measured values and not the error of the model",
                  about, numbers_text(answer), data_text(answer), models_text(fit)));
  if (answer.problem.unknowns.size() > 1) {
    const bite::FitDirection worst = directions_of(answer.best).front();
    run.assume(fmt::format("{}known worst is {}: a standard deviation of {:.2g} % along it", about,
                           direction_text(worst, answer.problem.unknowns), 100 * worst.deviation));
  }
  note_kept(run, fit);
  note_quality(run, fit);
}

namespace {
// Where one measured value alone is met: the straight line of logarithms through its slopes at the fitted point.
void add_line(Table &table, const StripFit &fit, const std::size_t datum, const Index i, const Index j,
              const FittedNumber &friction)
{
  constexpr int points    = 21;
  const FitAnswer &answer = fit.answer;
  const FitDatum fitted   = data_of(answer.problem)[datum];
  const Eigen::Vector2d by(answer.best.slope(Index(datum), i), answer.best.slope(Index(datum), j));
  const Eigen::Vector2d foot = -answer.best.residual[Index(datum)] * by / by.squaredNorm();
  const Eigen::Vector2d along(-by[1] / by.norm(), by[0] / by.norm());
  Eigen::VectorXd x(points), y(points);
  for (int k = 0; k < points; ++k) {
    const Eigen::Vector2d point = foot + (k - points / 2) * (0.5 / (points / 2)) * along;
    x[k]                        = friction.at(answer.best.x[i] + point[0]);
    y[k]                        = std::exp(answer.best.x[j] + point[1]);
  }
  const std::string name = fmt::format("{} of {}", word_of(fitted.kind), answer.problem.passes[fitted.pass].name);
  table.add("friction, " + name, "", x).add("flow_stress_factor, " + name, "", y);
}
}  // namespace

void write_fit(RunContext &run, const StripFit &fit)
{
  const FitAnswer &answer = fit.answer;
  const auto friction     = place_of(answer, UnknownRole::friction),
             stress       = place_of(answer, UnknownRole::flow_stress);
  if (!friction || !stress)
    return;
  constexpr int around       = 49;
  const Eigen::MatrixXd edge = confidence_region(answer.problem, answer.best, *friction, *stress, around);
  const FittedNumber number  = number_of(answer.problem.unknowns[*friction], start_of(answer));
  Table region;
  region.add("friction", "", number.base * edge.col(0).array().exp());
  region.add("flow_stress_factor", "", edge.col(1).array().exp());
  write_curve(run, curve::bite_fit, "", region);
  constexpr std::size_t most_lines = 6;
  Table lines;
  for (std::size_t d = 0; d < std::min(most_lines, data_of(answer.problem).size()); ++d)
    add_line(lines, fit, d, Index(*friction), Index(*stress), number);
  write_curve(run, curve::bite_fit_lines, "", lines);
}
}  // namespace mill
