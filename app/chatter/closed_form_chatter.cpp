#include "app/chatter/chatter_question.h"
#include "app/trace/closed_form_parts.h"

// Bite and critical speed of every condition: the same functions as a run, without curves and maps.
namespace mill {
std::vector<ClosedFormResult> closed_form_chatter(const ChatterCase &spec, MovingKeys *const keys)
{
  std::vector<ClosedFormResult> all;
  for (std::size_t i = 0; i < spec.conditions.size(); ++i) {
    const ChatterQuestion q = chatter_question(spec, i, keys);
    const std::string name  = q.condition.name;
    const auto add = [&](const std::string &result, const char *unit, const double value, const KeyList &keys,
                         const char *relation, const char *file, const char *equation) {
      ClosedFormResult r;
      r.name             = result;
      r.parameter.unit   = unit;
      r.parameter.value  = value;
      r.parameter.method = std::string(file) + " " + equation;
      r.parameter.inputs = keys;
      r.closed           = keys;
      r.relation         = relation;
      r.file             = file;
      r.equation         = equation;
      all.push_back(r);
    };
    const ChatterSearch search = search_chatter(q);
    const auto &state          = search.working ? search.working->state : bite::BiteState{};
    const auto there           = [&](const double value) { return search.working ? value : not_given; };
    const auto read            = [&](const ChatterReading reading) {
      return keys ? chatter_keys(*keys, i, reading) : KeyList();
    };
    for (const auto &[quantity, unit, value] :
         {std::tuple<const char *, const char *, double>{"force", "N", state.force},
          {"friction", "1", state.friction},
          {"flattened_radius", "m", state.flattened_radius},
          {"forward_slip", "1", state.forward_slip}})
      add("bite." + name + "." + quantity, unit, there(value), read(ChatterReading::bite), "steady bite",
          "reduce/bite/slab/bland_ford", "(8.8)");
    add("chatter." + name + ".growth_rate", "1/s", search.growth, read(ChatterReading::growth),
        "stand, bite and strip", "dynamics/chatter/chatter", "(25.4)");
    const KeyList searched = read(ChatterReading::search);
    add("chatter." + name + ".critical_speed", "m/s", search.found.speed, searched, "search over the speed",
        "dynamics/chatter/speed", "(25.4)");
    add("chatter." + name + ".frequency", "Hz", search.found.frequency, searched, "search over the speed",
        "dynamics/chatter/speed", "(25.4)");
    for (std::size_t v = 0; v < q.variants.size(); ++v) {
      const std::string variant = spec.variants[v].name;
      add("chatter." + name + ".variant." + variant + ".critical_speed", "m/s",
          dynamics::critical_speed(q.variants[v].stand, q.bite, q.scheme, chatter_range(q)).speed,
          q.variants[v].inputs, "search over the speed", "dynamics/chatter/speed", "(25.4)");
    }
  }
  return all;
}
}  // namespace mill
