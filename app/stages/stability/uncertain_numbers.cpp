#include "app/stages/stability/uncertain_numbers.h"
#include "app/run/run_context.h"
#include "core/base/short_number.h"
#include "core/model/four_high.h"
#include "core/records/chain_number.h"
#include "core/records/result_names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using bite::PassNumber;
using dynamics::UncertainNumber;

bool is_estimated(const FourHigh &stand, const std::string &key)
{
  return std::any_of(stand.estimates.begin(), stand.estimates.end(),
                     [&](const Estimate &e) { return e.key == key; });
}

// What inputs that come from one number have in common; an input of its own has its own name.
std::string number_behind(const FourHigh &stand, const std::string &input)
{
  const auto computed = [&](const char *upper, const char *lower) {
    return !stand.given.count(upper) && !stand.given.count(lower);
  };
  for (const auto &[upper, lower] :
       {std::pair("K3", "K5"), std::pair("K1", "K7"), std::pair("M1", "M6"), std::pair("Kzc2", "Kzc3")})
    if ((input == upper || input == lower) && computed(upper, lower))
      return std::string(upper) + "_and_" + lower;
  if (input == word_of(ChainNumber::K_Zy) ||
      input == word_of(ChainNumber::K_Zy_lower))  // one bearing, or one given value
    return "K_Zy";
  if (input.rfind("frame.", 0) != 0 || !is_estimated(stand, input))
    return input;
  std::string twin = input;
  for (const char *half : {"upper_", "lower_"})
    if (const auto place = twin.find(half); place != std::string::npos)
      twin.erase(place, 6);
  return twin;
}

void add_structure(UncertainNumbers &all, const FourHigh &stand,
                   const std::vector<reduce::ModalSensitivity> &inputs, const Eigen::Index n)
{
  std::string without;
  for (const reduce::ModalSensitivity &input : inputs) {
    const bool stated  = !std::isnan(input.error);
    const double error = stated ? input.error : usual_error::spring_or_mass;
    if (error == 0)  // a tolerance of 0 %: the number is exact
      continue;
    const std::string name  = number_behind(stand, input.name);
    const Eigen::MatrixXd K = input.dK.topLeftCorner(n, n), M = input.dM.topLeftCorner(n, n);
    if (!stated)
      without += (without.empty() ? "" : ", ") + input.name;
    const auto same = std::find_if(all.numbers.begin(), all.numbers.end(),
                                   [&](const UncertainNumber &one) { return one.name == name; });
    if (same == all.numbers.end()) {
      UncertainNumber number{name, error};
      number.structure = {K, M};
      all.numbers.push_back(std::move(number));
      continue;
    }
    UncertainNumber &number = *same;
    // Of two errors the larger one is that of the number; the other input moves by its part of it.
    const double larger = std::max(number.error, error);
    number.structure.dK = (number.error * number.structure.dK + error * K) / larger;
    number.structure.dM = (number.error * number.structure.dM + error * M) / larger;
    number.error        = larger;
  }
  if (!without.empty())
    all.assumed += fmt::format("{} for {}", percent_text(usual_error::spring_or_mass), without);
}

// Constants of a friction law that are a factor on the friction.
std::vector<PassNumber> friction_numbers(const bite::RollBite &bite)
{
  std::vector<PassNumber> factors;
  for (const PassNumber number : numbers_of(bite))
    if (number == PassNumber::friction || number == PassNumber::friction_scale || number == PassNumber::mu0 ||
        number == PassNumber::mu1)
      factors.push_back(number);
  return factors;
}

}  // namespace

FittedErrors fitted_errors(const RunContext &run)
{
  const auto error_of = [&](const char *number) {
    const Parameter *fitted = run.find(result_name({family::bite, bite_fit, number}));
    return fitted ? fitted->error_estimate : not_given;
  };
  return {error_of("friction"), error_of("flow_stress")};
}

void add_pass_numbers(UncertainNumbers &all, const FittedErrors &fitted, const bite::RollBite &bite,
                      const StandSpan &span, const double damping_tolerance)
{
  const auto assume = [&](const std::string &name, const double error) {
    all.assumed += fmt::format("{}{} for {}", all.assumed.empty() ? "" : ", ", percent_text(error), name);
  };
  const auto add = [&](const std::string &name, const double error, std::vector<PassNumber> numbers,
                       const bool usual = true) -> UncertainNumber & {
    UncertainNumber number{name, error};
    number.bite = std::move(numbers);
    if (usual)
      assume(name, error);
    return all.numbers.emplace_back(std::move(number));
  };
  const double friction = std::isnan(fitted.friction) ? usual_error::friction : fitted.friction,
               stress   = std::isnan(fitted.flow_stress) ? usual_error::flow_stress : fitted.flow_stress;
  add("friction", friction, friction_numbers(bite), friction == usual_error::friction);
  add("flow_stress", stress, {PassNumber::stress_factor}, stress == usual_error::flow_stress);
  add("entry_thickness", usual_error::entry_thickness, {PassNumber::entry_thickness});
  add("exit_thickness", usual_error::exit_thickness, {PassNumber::exit_thickness});
  add("entry_tension", usual_error::tension, {PassNumber::entry_tension});
  add("exit_tension", usual_error::tension, {PassNumber::exit_tension});
  const bool no_entry = std::isnan(span.entry_distance), no_exit = std::isnan(span.exit_distance);
  const auto distance = [](const bool assumed) {
    return assumed ? usual_error::assumed_distance : usual_error::distance;
  };
  add("entry_distance", distance(no_entry), {}).entry_distance = true;
  add("exit_distance", distance(no_exit), {}).exit_distance    = true;
  add("modal_damping", std::isnan(damping_tolerance) ? usual_error::modal_damping : damping_tolerance, {},
      std::isnan(damping_tolerance))
      .damping = true;
  all.assumed  = "the interval of the critical speed takes, where the case states no error: " + all.assumed;
}

UncertainNumbers uncertain_numbers(const FittedErrors &fitted, const FourHigh &stand, const bite::RollBite &bite,
                                   const std::vector<reduce::ModalSensitivity> &inputs, const Eigen::Index n)
{
  UncertainNumbers all;
  add_structure(all, stand, inputs, n);
  add_pass_numbers(all, fitted, bite, stand.span, stand.frequency_response.damping_tolerance);
  return all;
}
}  // namespace mill
