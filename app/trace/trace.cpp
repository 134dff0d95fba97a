#include "app/trace/trace.h"
#include "app/trace/stored_run.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/case/kinds.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/model/material.h"
#include "core/records/contact_name.h"
#include "core/records/result_folder.h"
#include "core/records/rows_of_bearing.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_contact.h"
#include "core/records/run_identity.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
using ClosedFormResults = std::vector<ClosedFormResult>;

// A result that moves by less than this has not moved: eigenvalues of an unchanged block round differently.
constexpr double rounding = 1e-11;

// No lists of keys as long as it lives.
class NumbersAlone {
public:
  explicit NumbersAlone(ClosedFormMemory &of_trace) : memory(of_trace), before(of_trace.with_inputs)
  {
    memory.with_inputs = false;
  }
  ~NumbersAlone()
  {
    memory.with_inputs = before;
  }
  NumbersAlone(const NumbersAlone &)            = delete;
  NumbersAlone &operator=(const NumbersAlone &) = delete;

private:
  ClosedFormMemory &memory;
  bool before;
};

struct Evaluation {
  const TraceOptions &options;
  ClosedFormMemory &memory;
  const SpringFactors &factors;
  ClosedFormResults at(const std::string &path, const std::string &toml) const
  {
    auto sets = options.sets;
    sets.push_back(path + "=" + toml);
    return closed_form_chain(read_case(options.case_file, sets), memory, factors);
  }
  // Nothing where the case refuses the value; `why` then says so.
  std::optional<ClosedFormResults> tried(const std::string &path, const std::string &toml, std::string &why) const
  {
    try {
      return at(path, toml);
    } catch (const InputError &e) {
      why = e.problems.front().message;
    } catch (const SolverError &e) {
      why = e.report.what;
    }
    return {};
  }
};

// Values of the key below and above, with the results there.
struct Sides {
  double x = 0, x_down = 0, x_up = 0;  // numbers as written
  std::optional<ClosedFormResults> down, up;
  std::optional<ClosedFormResults>
      middle;  // where giving the value of the key is another case than leaving it out
};

bool is_version(const Row &row)
{
  return row.key == "schema";
}

bool is_size(const Row &row)
{
  return row.kind == Kind::quantity || row.kind == Kind::number || row.kind == Kind::pair ||
         row.kind == Kind::six ||
         (row.kind == Kind::count && !is_version(row) && row.key.find("seed") == std::string::npos);
}

Sides evaluate_sides(const TraceKey &key, const Evaluation &evaluation, std::string &why)
{
  const double x   = first_number(*key.value);
  const auto sides = [&](const std::function<double(double)> &less, const std::function<double(double)> &more) {
    Sides s{x, less(x), more(x), {}, {}};
    s.down = evaluation.tried(key.path, changed_toml(*key.value, less), why);
    s.up   = evaluation.tried(key.path, changed_toml(*key.value, more), why);  // the last reason is kept
    return s;
  };
  if (key.row.kind == Kind::count)
    return sides([](double n) { return n - 1; }, [](double n) { return n + 1; });
  if (x == 0)
    return sides([](double v) { return v - 0.01; }, [](double v) { return v + 0.01; });
  Sides first;
  for (const double step : {1e-2, 1e-3, 1e-4}) {
    Sides s = sides([step](double v) { return v * (1 - step); }, [step](double v) { return v * (1 + step); });
    if (s.up && s.down)
      return s;
    if (!first.up && !first.down)
      first = std::move(s);
  }
  return first;
}

double value_of(const ClosedFormResults &results, const std::string &name)
{
  const ClosedFormResult *r = find(results, name);
  return r ? r->parameter.value : not_given;
}

// ln(b/a), or its first order where one of them has another sign.
double relative(const double a, const double b)
{
  return a * b > 0 ? std::log(b / a) : (b - a) / std::max(std::abs(a), std::abs(b));
}

bool differs(const double a, const double b)
{
  return std::isnan(a) != std::isnan(b) || std::abs(a - b) > rounding * std::max(std::abs(a), std::abs(b));
}

// Slope of ln y over ln x; over x itself, in percent, where x is zero.  Not given where a value is missing, or
// where a count changes from 1 to 0.
double slope(const double y_a, const double y_b, const double x_a, const double x_b, const bool from_zero)
{
  const double rise = y_a == y_b ? 0 : relative(y_a, y_b);
  const double step = from_zero ? (x_b - x_a) / 100 : std::log(x_b / x_a);
  return std::isfinite(step) && std::isfinite(rise) ? rise / step : not_given;
}

void add_slopes(TraceLine &line, const Sides &s, const bool from_zero)
{
  const double y      = s.middle ? value_of(*s.middle, line.result.name) : line.result.parameter.value;
  const double y_up   = s.up ? value_of(*s.up, line.result.name) : not_given;
  const double y_down = s.down ? value_of(*s.down, line.result.name) : not_given;
  line.slope_up       = slope(y, y_up, s.x, s.x_up, from_zero);
  line.slope_down     = slope(y_down, y, s.x_down, s.x, from_zero);
  line.slope          = std::isnan(line.slope_up)     ? line.slope_down
                        : std::isnan(line.slope_down) ? line.slope_up
                                                      : slope(y_down, y_up, s.x_down, s.x_up, from_zero);
  line.moves          = differs(y, std::isnan(y_up) ? y : y_up) || differs(y, std::isnan(y_down) ? y : y_down);
}

// Springs and masses of later passes belong to a trace of a key of that pass only: "pass 2.K3" in addition to
// "K3".
bool is_of_later_pass(const ClosedFormResults &all, const ClosedFormResult &result)
{
  return !result.symbol.empty() && find(all, result.symbol);
}

void keep_reached(Trace &trace, std::vector<TraceLine> lines)
{
  const std::string &key = trace.key.name;
  std::vector<std::string> reached;
  for (TraceLine &line : lines) {
    const bool by_elements = holds(line.result.parameter.inputs, key) && !holds(line.result.closed, key);
    // About zero a result may be even in the key, so that it is reached without a slope.
    const bool even = !is_relative(trace.per) && !trace.per.empty() && holds(line.result.closed, key);
    if (!line.moves && !by_elements && !even)
      continue;
    line.moves = line.moves || even;
    for (const std::string &part : line.result.from)
      if (holds(reached, part))
        line.through.push_back(part);
    line.direct = line.through.empty() || holds(line.result.own_keys, key);
    reached.push_back(line.result.name);
    const bool own_pass = key.rfind("pass.", 0) == 0 && key.rfind("pass.0.", 0) != 0;
    if (own_pass || !is_of_later_pass(trace.base, line.result))
      trace.lines.push_back(std::move(line));
  }
}

// Words and switches: every other one is tried, and a result that changes is reached.
void try_words(const TraceKey &key, const Evaluation &evaluation, std::vector<TraceLine> &lines)
{
  std::vector<std::string> words;
  if (key.row.kind == Kind::flag)
    words = {key.value->flag ? "false" : "true"};
  else
    words = split(key.row.form, " | ");
  for (const std::string &word : words) {
    if (key.value && key.value->text == word)
      continue;
    std::string why;
    const auto results = evaluation.tried(key.path, key.row.kind == Kind::flag ? word : quoted(word), why);
    if (!results)
      continue;
    for (TraceLine &line : lines) {
      const double y = line.result.parameter.value, other = value_of(*results, line.result.name);
      if (!differs(y, other))
        continue;
      line.moves = true;
      line.words.emplace_back(word, 100 * (other / y - 1));
    }
  }
}

std::string without_elasticity(const TraceKey &key)
{
  if (!key.value)
    return "it is not given";
  switch (key.row.kind) {
  case Kind::table:
    return "a table has no single size";
  case Kind::path:
    return "a file has no size";
  case Kind::text:
    return "a name has no size";
  case Kind::words:
    return "a list of words has no size";
  case Kind::list:
  case Kind::triples:
    return "a list has no single size";
  case Kind::choice:
  case Kind::flag:
    return "a word has no size; every other one is tried";
  default:
    return is_version(key.row) ? "a version has no size" : "a number that only names a record has no size";
  }
}

// Springs of the run over those of the closed forms.
SpringFactors run_factors(const StoredRun &run, const ClosedFormResults &base)
{
  SpringFactors factors;
  for (const ClosedFormResult &r : base) {
    const auto stored = run.values.find(r.name);
    const bool spring = !r.stands_for.empty() && stored != run.values.end();
    if (spring && stored->second > 0 && r.parameter.value > 0)
      factors[r.name] = stored->second / r.parameter.value;
  }
  return factors;
}
// Stiffness of the solid backup roll in the last run over that of its beam; with the inputs of that run, so that
// it fits a case that has moved on from there.  Nothing where the run bent a beam too.
SpringFactors bending_factor(const StoredRun &run)
{
  const auto stored          = run.values.find("K_ZW");
  const std::string resolved = run.folder + "/resolved.toml";
  if (stored == run.values.end() || !std::filesystem::exists(resolved))
    return {};
  try {
    const Case of_run = read_case(resolved);
    const auto *stand = std::get_if<FourHigh>(&of_run.spec);
    if (!stand || stand->backup_roll.bending_model != BendingModel::solid || stand->given.count("K_ZW"))
      return {};
    return {{"K_ZW", stored->second / beam_stiffness(*stand)}};
  } catch (const InputError &) {  // another version's, or its records are gone
    return {};
  }
}

// Of the case as it stands, to which every key of it comes back.
const ClosedFormResults &remembered_chain(const TraceOptions &options, const Case &the_case,
                                          ClosedFormMemory &memory)
{
  const std::string name = fmt::format("{} {}", options.case_file, fmt::join(options.sets, " "));
  const auto known       = memory.cases.find(name);
  return known != memory.cases.end()
             ? known->second
             : memory.cases.emplace(name, closed_form_chain(the_case, memory)).first->second;
}

// Results that a run adds to those of a trace and that state this key; they are not in the chain of springs and
// masses: "K3.friction_tangent" of "contact.upper.friction".
std::vector<std::string> results_outside_the_chain(const Case &the_case, const std::string &key)
{
  MovingKeys keys(the_case.spec);
  std::vector<std::string> reached;
  const auto add = [&](const std::string &name, const KeyList &inputs) {
    if (holds(inputs, key))
      reached.push_back(name);
  };
  const bool stand = std::holds_alternative<FourHigh>(the_case.spec);
  if (stand)
    for (const ContactName contact : {ContactName::upper, ContactName::lower}) {
      const char *K = word_of(contact == ContactName::upper ? ChainNumber::K3 : ChainNumber::K5);
      add(row::roll_contact::friction_tangent.of(K),
          contact_keys(keys, word_of(contact), 0, ContactReading::friction));
      add(row::roll_contact::path_plateau.of(K), contact_keys(keys, word_of(contact), 0, ContactReading::path));
    }
  if (stand || std::holds_alternative<BiteCase>(the_case.spec)) {
    BiteReading path;
    path.path_trim = true;
    add(row::bite_spring::path_plateau.of(), bite_keys(keys, 0, path));
  }
  if (std::holds_alternative<BearingCase>(the_case.spec))
    add(row::motion::frequency.of(), bearing_case_keys(keys, {BearingAsks::motion}));
  if (stand || std::holds_alternative<Lumped>(the_case.spec)) {
    add("frf.bite.upper_work_roll.peak", frequency_response_keys(keys));
    add("campbell.gap_first_kind.speed", campbell_keys(keys));
  }
  return reached;
}
}  // namespace

Trace trace(const TraceOptions &options)
{
  ClosedFormMemory memory;
  return trace(options, memory);
}

Trace trace(const TraceOptions &options, ClosedFormMemory &memory)
{
  const Case the_case = read_case(options.case_file, options.sets);
  Trace trace;
  trace.base            = remembered_chain(options, the_case, memory);
  const auto run        = stored_run(folder_of_run(options.folder, the_case), the_case);
  trace.key             = find_key(the_case, options.sets, options.key, trace.base);
  SpringFactors factors = run ? bending_factor(*run) : SpringFactors{};
  if (options.from_run) {
    if (!run)
      throw InputError(fmt::format("--full takes the springs of the last run, and there is none in {}; run "
                                   "millstand run {} first, or leave --full out",
                                   folder_of_run(options.folder, the_case), options.case_file));
    factors.merge(run_factors(*run, trace.base));
    trace.from_run = true;
  }
  if (!factors.empty())
    trace.base = closed_form_chain(the_case, memory, factors);
  const NumbersAlone neighbours(memory);  // they have the keys of the case
  const Evaluation evaluation{options, memory, factors};
  std::vector<TraceLine> lines;
  for (const ClosedFormResult &result : trace.base) {
    TraceLine line;
    line.result = result;
    line.moves  = false;
    lines.push_back(line);
  }
  const TraceKey &key = trace.key;
  if (key.value && is_size(key.row)) {
    std::string why;
    Sides s = evaluate_sides(key, evaluation, why);
    if (key.stands_in)
      s.middle = evaluation.tried(key.path, changed_toml(*key.value, [](const double v) { return v; }), why);
    const bool from_zero = s.x == 0;
    const std::string u = unit_written(*key.value), space = u.empty() ? "" : " " + u;
    if (s.up || s.down) {
      trace.per = from_zero ? (u.empty() ? "unit" : u) : "%";
      trace.steps =
          fmt::format("{:.6g}{} .. {:.6g}{}{}", s.down ? s.x_down : s.x, space, s.up ? s.x_up : s.x, space,
                      key.row.kind == Kind::pair  ? ", both numbers of the pair alike"
                      : key.row.kind == Kind::six ? ", all six numbers alike"
                                                  : "");
      for (TraceLine &line : lines)
        add_slopes(line, s, from_zero);
    } else {
      trace.reason = "no other value near it is accepted: " + why;
    }
  } else {
    trace.reason = without_elasticity(key);
    if (key.row.kind == Kind::choice || key.row.kind == Kind::flag)
      try_words(key, evaluation, lines);
    else
      for (TraceLine &line : lines)
        line.moves = holds(line.result.closed, key.name);
  }
  keep_reached(trace, std::move(lines));
  if (trace.lines.empty())
    trace.only_in_a_run = results_outside_the_chain(the_case, key.name);
  if (run) {
    trace.run_folder  = run->folder;
    trace.same_inputs = run->same_inputs;
    for (const ClosedFormResult &r : trace.base)
      if (const auto stored = run->values.find(r.name); stored != run->values.end())
        trace.run.emplace_back(r.name, stored->second);
  }
  return trace;
}
}  // namespace mill
