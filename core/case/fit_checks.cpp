#include "core/case/stand_reader.h"
#include "core/laws/scaled_friction.h"
#include "core/records/result_names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// bite.fit: measured values to which friction and flow stress are fitted.
namespace mill {
namespace {
template <class Word> bool has(const std::vector<Word> &words, const Word &word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string without(const std::vector<PassMeasure> &all, const PassMeasure one)
{
  std::string list;
  for (const PassMeasure other : all)
    if (other != one)
      list += (list.empty() ? "" : ", ") + quoted(word_of(other));
  return "[" + list + "]";
}

/// One kind of measured value as a case gives it.
struct MeasuredKind {
  PassMeasure kind;
  const char *name, *example;
  bool (*given)(const Pass &pass);
};

// A stand without a load takes the mean of its force record.
const MeasuredKind measured_kinds[] = {
    {PassMeasure::force, "rolling force", "load = \"976.2 kN\"",
     [](const Pass &p) {
       return !std::isnan(p.load) || !p.force_file.empty() || !std::isnan(p.synthetic_range[0]);
     }},
    {PassMeasure::slip, "forward slip", "forward_slip = \"4.2 %\"",
     [](const Pass &p) { return !std::isnan(p.forward_slip); }},
    {PassMeasure::torque, "torque of a roll", "torque = \"17 kN m\"",
     [](const Pass &p) { return !std::isnan(p.torque); }},
};

// How many values are measured; what is asked and not there becomes a problem.
std::size_t count_measured(const BiteSetup &setup, const std::vector<Pass> &passes, Reading &reading)
{
  std::size_t values = 0;
  for (const MeasuredKind &kind : measured_kinds) {
    if (!has(setup.fit, kind.kind))
      continue;
    const auto n = std::size_t(std::count_if(passes.begin(), passes.end(), kind.given));
    values += n;
    if (n > 0)
      continue;
    const std::string rest = without(setup.fit, kind.kind);
    contradict(reading, "bite.fit",
               fmt::format("asks for the {}, which no pass gives; add for example {} to a [[pass]]{}", kind.name,
                           kind.example, rest == "[]" ? "" : ", or take " + rest),
               {});
  }
  return values;
}

// Constants that are fitted belong to the friction law and have a value to start from.
void check_fitted_constants(const BiteSetup &setup, const Friction &friction, Reading &reading)
{
  for (const std::string &word : setup.fit_for)
    for (const FrictionConstant &constant : friction_constants()) {
      if (word != constant.key)
        continue;
      if (!reads(friction, constant.member))
        contradict(
            reading, "bite.fit_for",
            fmt::format("asks for '{}', which the friction law \"{}\" does not have", word, name_of(friction.law)),
            {"strip.friction", "strip.friction.law"});
      else if (friction.*constant.member == 0)
        contradict(
            reading, "bite.fit_for",
            fmt::format("asks for '{}', whose value in [strip.friction] is zero; give one to start from", word),
            {"strip.friction." + word});
    }
}

// Friction that is fitted as a factor on that of [strip].
void check_start(const BiteSetup &setup, const Friction &friction, Reading &reading)
{
  const bool wanted = setup.fit_for.empty() ? has(setup.fit, PassMeasure::slip) || setup.fit.size() > 1
                                            : has<std::string>(setup.fit_for, "friction");
  if (!wanted || !is_zero(friction))
    return;
  const std::string key = reading.places.count("strip.friction") ? "strip.friction" : "strip.friction.law";
  contradict(reading, key, "is not a friction coefficient to start the fit from; give a guess, for example 0.1",
             {"bite.fit"});
}
}  // namespace

void check_fit(const BiteSetup &setup, const Strip &strip, const std::vector<Pass> &passes, Reading &reading)
{
  if (!reading.usable({"bite.fit", "bite.fit_for", "pass", "strip.friction", "strip.friction.law"}))
    return;
  if (setup.fit.empty()) {
    if (!setup.fit_for.empty())
      contradict(reading, "bite.fit_for",
                 "is given without measured values; add fit = [\"force\", \"slip\"], and load and forward_slip to "
                 "each [[pass]]",
                 {});
    return;
  }
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const auto key = [&](const char *k) { return fmt::format("pass.{}.{}", i, k); };
    if (!reading.usable({key("load"), key("forward_slip"), key("torque")}))
      return;
    if (passes[i].name == bite_fit)
      contradict(reading, key("name"), "is the name under which bite.fit writes its results; take another",
                 {"bite.fit"});
    if (passes[i].torque == 0 && has(setup.fit, PassMeasure::torque))
      contradict(reading, key("torque"), "has no standard deviation as a share of it; leave it out", {"bite.fit"});
  }
  const std::size_t values = count_measured(setup, passes, reading);
  if (setup.fit_for.size() > values && values > 0)
    contradict(reading, "bite.fit_for",
               fmt::format("asks for {} numbers, and the passes give {} measured value{}; ask for fewer, or add "
                           "forward_slip, torque or another [[pass]]",
                           setup.fit_for.size(), values, values == 1 ? "" : "s"),
               {"bite.fit"});
  if (reading.usable({"bite.theory", "bite.method"}) && setup.method == BiteMethod::slab &&
      setup.theory == SlabTheory::sims)
    contradict(reading, "bite.theory", "has no coefficient of friction that bite.fit could fit", {"bite.fit"});
  check_fitted_constants(setup, strip.friction, reading);
  check_start(setup, strip.friction, reading);
}
}  // namespace mill
