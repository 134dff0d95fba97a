#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include <cmath>
#include <fmt/format.h>

// [frequency_response], [campbell] and [[drive.order]].
namespace mill {
namespace {
void require_increasing(const std::string &key, const std::array<double, 2> &range, const char *what,
                        Reading &reading)
{
  if (reading.usable({key}) && !std::isnan(range[0]) && !(range[0] < range[1]))
    contradict(reading, key, fmt::format("does not increase; write the smaller {} first", what), {});
}

void check_drive_names(const std::vector<DriveOrder> &orders, Reading &reading)
{
  for (std::size_t i = 0; i < orders.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::string key = fmt::format("drive.order.{}.name", i), other = fmt::format("drive.order.{}.name", j);
      if (reading.usable({key, other}) && orders[i].name == orders[j].name)
        contradict(reading, key, "names two orders; give each its own name", {other});
    }
}
}  // namespace

FrequencyResponseSettings read_frequency_response(const Node &root, Reading &reading)
{
  FrequencyResponseSettings settings;
  const std::string name = "frequency_response";
  const Section section  = section_at(root, name, reading);
  read_and_echo(section, section.header(), frequency_response_rows(), settings, reading);
  const std::string range = name + ".range", resolution = name + ".resolution";
  require_increasing(range, settings.range, "frequency", reading);
  if (!reading.usable({range, resolution}))
    return settings;
  const double points = (settings.range[1] - settings.range[0]) / settings.resolution;  // NaN: not asked
  if (points > most_frequencies)
    contradict(reading, resolution,
               fmt::format("asks for {:.0f} frequencies in the range; at most {:.0f} are computed", points,
                           most_frequencies),
               {range});
  return settings;
}

CampbellSettings read_campbell(const Node &root, const std::vector<Field<CampbellSettings>> &rows,
                               Reading &reading)
{
  CampbellSettings settings;
  const Section section = section_at(root, "campbell", reading);
  read_and_echo(section, section.header(), rows, settings, reading);
  require_increasing("campbell.speeds", settings.speeds, "speed", reading);
  if (const std::string key = "campbell.working_speeds";
      reading.usable({key}) && settings.working_speeds[0] > settings.working_speeds[1])
    contradict(reading, key, "does not increase; write the smaller speed first", {});
  return settings;
}

std::vector<DriveOrder> read_drive_orders(const Node &root, Reading &reading)
{
  std::vector<DriveOrder> orders;
  const Section drive = section_at(root, "drive", reading);
  if (!drive.node)
    return orders;
  refuse_unknown_keys(drive, {}, {"order"}, reading);
  const Node::Entry *entry = drive.node->find("order");
  if (!entry)
    return orders;
  if (entry->value.kind != Node::Kind::array) {
    reading.bad.insert("drive.order");
    reading.add(entry->key_place,
                "an order of the drive is written under [[drive.order]], in double brackets, one for each order");
    return orders;
  }
  for (std::size_t i = 0; i < entry->value.items.size(); ++i) {
    const Node &node       = entry->value.items[i];
    const std::string name = fmt::format("drive.order.{}", i);
    if (node.kind != Node::Kind::table) {
      reading.add(node.place,
                  fmt::format("{} = {} is a value; a section [[drive.order]] is needed", name, shown(node)));
      continue;
    }
    DriveOrder order;
    read_and_echo(Section{&node, name}, "[[drive.order]]", drive_order_rows(), order, reading);
    orders.push_back(order);
  }
  check_drive_names(orders, reading);
  return orders;
}

void check_turning_shafts(const CampbellSettings &campbell, const std::vector<DriveOrder> &orders,
                          Reading &reading)
{
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const bool backup          = orders[i].per_turn_of == RollKind::backup_roll;
    const std::string diameter = backup ? "campbell.backup_roll_diameter" : "campbell.work_roll_diameter";
    const std::string key      = fmt::format("drive.order.{}.per_turn_of", i);
    if (reading.usable({key, diameter}) &&
        std::isnan(backup ? campbell.backup_roll_diameter : campbell.work_roll_diameter))
      reading.add(reading.places.count(key) ? reading.place(key)
                                            : reading.place(fmt::format("drive.order.{}.name", i)),
                  fmt::format("drive.order.{} is per turn of the {}, whose size is not known; give {}", i,
                              word_of(orders[i].per_turn_of), diameter));
  }
}
}  // namespace mill
