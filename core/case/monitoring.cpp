#include "core/case/monitoring.h"
#include "core/base/units.h"
#include "core/case/section_list.h"
#include "core/case/stand_reader.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace mill {
namespace {
bool is_velocity(const std::string &text, double &value)
{
  const ParsedQuantity parsed = parse_quantity(text);
  if (parsed.fault != ParsedQuantity::Fault::none || !(parsed.unit->dimension == unit("m/s").dimension))
    return false;
  value = parsed.value();
  return value > 0;
}

void check_severity(const Monitoring &monitoring, Reading &reading)
{
  const std::string key = "monitoring.severity";
  if (!reading.usable({key}))
    return;
  double before = 0, value = 0;
  for (const std::string &text : monitoring.severity) {
    if (!is_velocity(text, value)) {
      contradict(reading, key,
                 fmt::format("holds '{}'; a velocity above zero is needed, for example \"2.3 mm/s\"", text), {});
      return;
    }
    if (!(value > before)) {
      contradict(reading, key, "does not increase; write the upper end of the lowest zone first", {});
      return;
    }
    before = value;
  }
}

void check_band(const std::string &name, const std::array<double, 2> &band, Reading &reading)
{
  const std::string key = "monitoring." + name;
  if (reading.usable({key}) && !(band[0] < band[1]))
    contradict(reading, key, "does not increase; write the lower frequency first", {});
}

void check_ball_bearings(const std::vector<BallBearing> &bearings, Reading &reading)
{
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const BallBearing &b   = bearings[i];
    const std::string head = fmt::format("monitoring.ball_bearing.{}.", i), ball = head + "ball_diameter",
                      pitch = head + "pitch_diameter", balls = head + "balls", name = head + "name";
    if (reading.usable({ball, pitch}) && !(b.ball_diameter < b.pitch_diameter))
      contradict(reading, ball, "is not below the pitch diameter", {pitch});
    else if (reading.usable({ball, pitch, balls}) &&
             b.ball_diameter > b.pitch_diameter * std::sin(M_PI / b.balls))  // neighbours touch
      contradict(reading, balls, "do not fit on the pitch circle", {ball, pitch});
    for (std::size_t j = 0; j < i; ++j)
      if (const std::string other = fmt::format("monitoring.ball_bearing.{}.name", j);
          reading.usable({name, other}) && b.name == bearings[j].name)
        contradict(reading, name, "names two bearings; give each its own name", {other});
  }
}
}  // namespace

std::map<std::string, std::string> Monitoring::channels() const
{
  std::map<std::string, std::string> channels;
  for (const std::string &pair : channel_pairs)
    channels[pair.substr(0, pair.rfind('='))] = pair.substr(pair.rfind('=') + 1);
  return channels;
}

std::vector<double> Monitoring::zones() const
{
  std::vector<double> values;
  double value = 0;
  for (const std::string &text : severity)
    if (is_velocity(text, value))
      values.push_back(value);
  return values;
}

const std::vector<Field<Monitoring>> &monitoring_rows()
{
  using T                                          = Monitoring;
  static const std::vector<Field<Monitoring>> rows = [] {
    std::vector<Field<T>> all;
    const auto add = [&](const char *key, const Member<T> &member, const char *form, const Range &range,
                         const char *example, const char *meaning) {
      all.push_back(Field<T>{key, member, form, range, absent, example, meaning});
    };
    add("channels", &T::channel_pairs, "names", any,
        R"({ "AI_07" = "upper_work_roll", "AI_08" = "lower_work_roll" })",
        "names of columns in the plant's records and what they are: force, load_cell, speed, exit_speed, or a "
        "place "
        "such as upper_work_roll; other columns are analysed under their own name");
    add("severity", &T::severity, "text", any, R"(["2.3 mm/s", "4.5 mm/s", "7.1 mm/s"])",
        "upper ends of zones A, B, C of the rms velocity, 10 to 1000 Hz; when absent no zone is named, since the "
        "level of a stand is set by the pass");
    const Range hertz{1, 10000};
    add("third_octave", &T::third_octave, "Hz", hertz, R"(["125 Hz", "240 Hz"])",
        "band of third-octave chatter; when absent 125 to 240 Hz");
    add("fifth_octave", &T::fifth_octave, "Hz", hertz, R"(["550 Hz", "650 Hz"])",
        "band of fifth-octave chatter; when absent 550 to 650 Hz");
    add("limit", &T::limit, "m/s2", {1e-3, 1e5}, "20 m/s2",
        "level of a vibration in one band, 0-peak, that this mill shall not exceed: above it live always raises "
        "an alarm, and the time until a growing vibration reaches it is computed; when "
        "absent "
        "there is none");
    add("baseline", &T::baseline, "path", any, "out/first-week-analysis",
        "folder of an earlier analysis of the same mill: changes of the rms velocity are reported, and an "
        "indication "
        "of "
        "a bearing fault is reported only when it grows");
    return all;
  }();
  return rows;
}

const std::vector<Field<BallBearing>> &ball_bearing_rows()
{
  using T = BallBearing;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", any, required, "axial", "unique; names its lines in an analysis"},
      {"roll", &T::roll, "choice", any, RollKind::work_roll, "work roll",
       "with which its inner ring turns; its outer ring is at rest"},
      {"balls", &T::balls, "count", {3, 200}, required, "14", "of one row"},
      {"ball_diameter", &T::ball_diameter, "mm", {1, 300}, required, "38.1 mm", "of each ball"},
      {"pitch_diameter",
       &T::pitch_diameter,
       "mm",
       {5, 3000},
       required,
       "240 mm",
       "of the circle through the centres of the balls; near the mean of bore and outside diameter"},
      {"contact_angle",
       &T::contact_angle,
       "deg",
       {0, 60},
       0,
       "40 deg",
       "between the line of contact and the plane of the bearing; 0 for a deep-groove bearing"},
  };
  return rows;
}

SectionRows monitoring_section()
{
  return {"monitoring", SectionRows::Repeat::once, false,
          "records of the mill: names of channels, zones, bands, limits", rows_of(monitoring_rows())};
}

SectionRows ball_bearing_section()
{
  return {"monitoring.ball_bearing", SectionRows::Repeat::list, false,
          "a ball bearing at a roll, for the frequencies of its faults in millstand analyse; roller bearings are "
          "those of [bearing.*]",
          rows_of(ball_bearing_rows())};
}

TemplateNote monitoring_note()
{
  return {"monitoring", "", {}, {}, true};
}

TemplateNote ball_bearing_note()
{
  return {"monitoring.ball_bearing", "", {}, {}, true};
}

Monitoring read_monitoring(const Node &root, Reading &reading)
{
  Monitoring monitoring;
  const Section section = section_at(root, "monitoring", reading);
  if (!section.node)
    return monitoring;
  read_and_echo(section, section.header(), monitoring_rows(), monitoring, reading, {"ball_bearing"});
  monitoring.ball_bearings = read_list(section, "ball_bearing", ball_bearing_rows(), reading);
  check_ball_bearings(monitoring.ball_bearings, reading);
  check_severity(monitoring, reading);
  check_band("third_octave", monitoring.third_octave, reading);
  check_band("fifth_octave", monitoring.fifth_octave, reading);
  if (const std::string key = "monitoring.baseline"; reading.usable({key}) && !monitoring.baseline.empty()) {
    std::error_code error;
    if (!std::filesystem::exists(monitoring.baseline + "/analysis.json", error))
      doubt(reading, key, {"holds no analysis.json", "", "name the folder of an earlier millstand analyse"}, {});
  }
  return monitoring;
}

Monitoring monitoring_of(const std::string &path, const std::vector<std::string> &sets)
{
  const Node root                    = read_case_file(path, sets);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  Reading reading;
  reading.file          = path;
  reading.folder        = folder.empty() ? "." : folder.string();
  Monitoring monitoring = read_monitoring(root, reading);
  if (!reading.problems.empty())
    throw InputError(std::move(reading.problems));
  return monitoring;
}
}  // namespace mill
