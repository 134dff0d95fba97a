#include "report/compare/certainty.h"
#include "core/base/choice.h"
#include "core/base/units.h"
#include "report/results/tables.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mill::report {
namespace {
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

// Words that name a part of the mill; every other word of a case chooses a model.
constexpr std::array parts{"arrangement", "row_hands", "bearing",   "type",    "designation",
                           "catalogue",   "material",  "roll_name", "profile", "file"};
// Numbers that set a mesh or how far a series of modes goes.
constexpr std::array mesh_sizes{"samples", "slices", "frequency_limit"};

std::string last_part(const std::string &key)
{
  return key.substr(key.rfind('.') + 1);
}

bool is_physical_word(const std::string &key)
{
  const std::string last = last_part(key);
  return std::find(parts.begin(), parts.end(), last) != parts.end();
}

bool is_mesh_size(const std::string &key)
{
  const std::string last = last_part(key);
  return last.rfind("elements_", 0) == 0 ||
         std::find(mesh_sizes.begin(), mesh_sizes.end(), last) != mesh_sizes.end();
}

// A result is made from a key, or from a part of it: "strip.flow_stress.k" of "strip.flow_stress".
bool is_made_from(const Result &result, const std::string &key)
{
  return std::any_of(result.inputs.begin(), result.inputs.end(), [&](const std::string &input) {
    return input == key || input.rfind(key + ".", 0) == 0 || key.rfind(input + ".", 0) == 0;
  });
}

std::vector<const DifferentInput *> inputs_behind(const Result &first, const Result &other,
                                                  const std::vector<DifferentInput> &inputs)
{
  std::vector<const DifferentInput *> behind;
  const bool listed = !first.inputs.empty() || !other.inputs.empty();
  for (const DifferentInput &input : inputs)
    if (!listed || is_made_from(first, input.key) || is_made_from(other, input.key))
      behind.push_back(&input);
  return behind;
}

// The value in [given] replaces a computed one: with it in one run only, this run has another model there.
bool replaces_computed(const DifferentInput &input)
{
  return input.key.rfind("given.", 0) == 0 && (input.first.empty() || input.other.empty());
}

bool models_differ(const Run &first, const Run &other, const Result &in_first, const Result &in_other,
                   const std::vector<const DifferentInput *> &behind)
{
  if (first.manifest.version != other.manifest.version ||
      short_source(in_first.source) != short_source(in_other.source))
    return true;
  return std::any_of(behind.begin(), behind.end(), [](const DifferentInput *input) {
    return replaces_computed(*input) || chooses_model(input->key, input->first) ||
           chooses_model(input->key, input->other);
  });
}

// -, what the interval of an estimate moves a result by; NaN: the run does not state it.
double moved_by_estimate(const Run &run, const std::string &key, const std::string &result)
{
  for (const EstimateInfo &estimate : run.estimates)
    if (estimate.key == key)
      for (const auto &[name, moves] : estimate.moves)
        if (name == result)
          return moves;
  return not_known;
}

// -, over the value of the first run; NaN: not stated
double error_of_estimates(const Run &first, const Run &other, const Result &in_first, const Result &in_other,
                          const std::vector<const DifferentInput *> &behind)
{
  double square     = 0;
  const double size = std::abs(in_other.value / in_first.value);
  for (const DifferentInput *input : behind)
    if (input->estimated_once) {
      const double in_one = moved_by_estimate(first, input->key, in_first.name);
      square +=
          std::pow(std::isfinite(in_one) ? in_one : size * moved_by_estimate(other, input->key, in_other.name), 2);
    }
  return std::sqrt(square);
}

double error_of_both(const Result &in_first, const Result &in_other)
{
  const double size = in_first.value != 0 ? std::abs(in_other.value / in_first.value) : 1;
  return std::hypot(in_first.error_estimate, size * in_other.error_estimate);
}
}  // namespace

namespace {
// A choice of two in TOML.
enum class YesOrNo { no, yes };
constexpr auto words_of(YesOrNo)
{
  return choice_words<YesOrNo>("false", "true");
}
}  // namespace

bool chooses_model(const std::string &key, const std::string &value)
{
  if (is_mesh_size(key))
    return true;
  if (choice_named<YesOrNo>(value))
    return true;
  const bool quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
  if (!quoted || is_physical_word(key))
    return false;
  return parse_quantity(value.substr(1, value.size() - 2)).fault != ParsedQuantity::Fault::none;
}

DifferenceError error_of_difference(const Run &first, const Run &other, const Result &in_first,
                                    const Result &in_other, const double change,
                                    const std::vector<DifferentInput> &inputs)
{
  DifferenceError difference;
  const auto behind = inputs_behind(in_first, in_other, inputs);
  for (const DifferentInput *input : behind)
    difference.behind.push_back(input->key);
  const bool estimated =
      std::any_of(behind.begin(), behind.end(), [](const DifferentInput *input) { return input->estimated_once; });
  const bool own_errors =
      behind.size() > 1 &&
      std::any_of(behind.begin(), behind.end(), [](const DifferentInput *input) { return input->own_error; });
  double error = 0;
  if (behind.empty() || own_errors || models_differ(first, other, in_first, in_other, behind))
    error = error_of_both(in_first, in_other);
  else if (estimated) {
    error = error_of_estimates(first, other, in_first, in_other, behind);
    if (!std::isfinite(error))
      error = error_of_both(in_first, in_other);
  }
  difference.error = error;
  if (error == 0)
    difference.certainty = Certainty::certain;
  else if (std::isfinite(error))
    difference.certainty = std::abs(change) > error ? Certainty::beyond : Certainty::within;
  return difference;
}
}  // namespace mill::report
