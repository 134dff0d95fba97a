#include "core/base/units.h"
#include "core/case/stand_reader.h"
#include <fmt/format.h>

namespace mill {
namespace {
std::array<double, 2> in_g(const std::array<double, 2> &acceleration)
{
  return {from_si(acceleration[0], unit("g")), from_si(acceleration[1], unit("g"))};
}

Pass read_pass(const Node &node, const std::string &name, const std::vector<Field<PassInput>> &rows,
               Reading &reading)
{
  PassInput pass;
  read(Section{&node, name}, rows, pass, reading);
  // A pass without a file is driven by made noise, and must say so wherever it appears.
  if (pass.force_file.empty() && reading.places.count(name + ".synthetic_range"))
    pass.synthetic = true;
  reading.echo += "\n[[pass]]\n" + resolved_lines(name, rows, pass, reading);
  pass.published_peak_g = in_g(pass.published_peak);
  pass.measured_peak_g  = in_g(pass.measured_peak);
  pass.place            = node.place;
  pass.force_place      = reading.place(name + ".force");
  pass.measured_place   = reading.place(name + ".measured");
  return pass;
}
}  // namespace

std::vector<Pass> read_passes(const Node &root, const std::vector<Field<PassInput>> &rows, Reading &reading)
{
  std::vector<Pass> passes;
  const Node::Entry *entry = root.find("pass");
  if (!entry)
    return passes;
  if (entry->value.kind != Node::Kind::array) {
    reading.bad.insert("pass");
    reading.add(entry->key_place, "a pass is written under [[pass]], in double brackets, one for each pass");
    return passes;
  }
  for (std::size_t i = 0; i < entry->value.items.size(); ++i) {
    const Node &node = entry->value.items[i];
    if (node.kind == Node::Kind::table)
      passes.push_back(read_pass(node, fmt::format("pass.{}", i), rows, reading));
    else
      reading.add(node.place,
                  fmt::format("pass.{} = {} is a value; a section [[pass]] is needed", i, shown(node)));
  }
  return passes;
}

DynamicsSettings read_dynamics(const Node &root, const std::vector<Field<DynamicsSettings>> &rows,
                               Reading &reading)
{
  DynamicsSettings dynamics;
  const Section section = section_at(root, "dynamics", reading);
  read_and_echo(section, section.header(), rows, dynamics, reading);
  dynamics.force_meaning_place = reading.place("dynamics.force_meaning");
  return dynamics;
}
}  // namespace mill
