#include "core/case/advice_rows.h"
#include "core/case/section_list.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// [advice] of a stand and of chatter.
namespace mill {
namespace {
// Bounds are written from the smaller to the larger one.
template <class T> void check_bounds(const std::vector<Field<T>> &rows, const T &advice, Reading &reading)
{
  for (const Field<T> &row : rows) {
    const auto *member    = std::get_if<std::array<double, 2> T::*>(&row.member);
    const std::string key = std::string("advice.") + row.key;
    if (!member || !reading.usable({key}))
      continue;
    const auto &[low, high] = advice.**member;
    const bool factors      = std::string(row.form) == "1";
    if (factors ? low > high : low >= high)  // NaN: not asked
      contradict(reading, key,
                 fmt::format("does not increase; write the smaller {} first", factors ? "factor" : "frequency"),
                 {});
  }
}

void check_dampers(const std::vector<DamperProposal> &dampers, Reading &reading)
{
  for (std::size_t i = 0; i < dampers.size(); ++i) {
    const std::string to = fmt::format("advice.damper.{}.to", i), from = fmt::format("advice.damper.{}.from", i);
    if (reading.usable({to, from}) && dampers[i].from == dampers[i].to)
      contradict(reading, to, "is the place where the damper begins", {from});
  }
}

template <class T> T read_level_advice(const Node &root, const std::vector<Field<T>> &rows, Reading &reading)
{
  T advice;
  const Section section = section_at(root, "advice", reading);
  read_and_echo(section, section.header(), rows, advice, reading, {"damper", "tuned_damper"});
  check_bounds(rows, advice, reading);
  advice.dampers = read_list(section, "damper", damper_proposal_rows(), reading);
  advice.tuned   = read_list(section, "tuned_damper", tuned_proposal_rows(), reading);
  check_dampers(advice.dampers, reading);
  return advice;
}
}  // namespace

StandAdvice read_stand_advice(const Node &root, Reading &reading)
{
  return read_level_advice(root, stand_advice_rows(), reading);
}

FourHighAdvice read_four_high_advice(const Node &root, Reading &reading)
{
  return read_level_advice(root, four_high_advice_rows(), reading);
}

RolledAdvice rolled_advice_of(const std::string &path, const std::vector<std::string> &sets)
{
  Reading reading;
  reading.file = path;
  return read_four_high_advice(read_case_file(path, sets), reading);
}

ChatterAdvice read_chatter_advice(const Node &root, const std::vector<RollingCondition> &conditions,
                                  Reading &reading)
{
  ChatterAdvice advice;
  const Section section = section_at(root, "advice", reading);
  read_and_echo(section, section.header(), chatter_advice_rows(), advice, reading);
  check_bounds(chatter_advice_rows(), advice, reading);
  const auto named = std::find_if(conditions.begin(), conditions.end(),
                                  [&](const RollingCondition &c) { return c.name == advice.condition; });
  const bool known = named != conditions.end();
  if (!advice.condition.empty() && reading.usable({"advice.condition"}) && !known)
    contradict(reading, "advice.condition", "is not the name of a [[condition]]", {});
  return advice;
}
}  // namespace mill
