#include "app/twin/calibrate/record_set.h"
#include "core/base/files.h"
#include "core/base/valid_text.h"
#include "core/case/fields.h"
#include "core/case/record_set_rows.h"
#include "twin/records/known_channel.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace fs = std::filesystem;

namespace mill {
namespace {
constexpr double shortest_piece = 1;  // s: in a shorter piece the transients of the low modes explain everything

void read_channels(const Section &section, RecordEntry &entry, Reading &reading)
{
  const Node::Entry *channels = section.node->find("channels");
  if (!channels)
    return;
  if (channels->value.kind != Node::Kind::table) {
    reading.add(channels->value.place,
                section.key("channels") +
                    " must be a table of names, for example { \"AI_07\" = \"upper_work_roll\" }");
    return;
  }
  for (const Node::Entry &pair : channels->value.entries)
    if (pair.value.kind == Node::Kind::text)
      entry.channels[pair.key] = pair.value.text;
    else
      reading.add(pair.value.place, fmt::format("{}.{} = {} must be a place, for example \"upper_work_roll\"",
                                                section.key("channels"), pair.key, shown(pair.value)));
}

/// Calls work(section) for every table of a list [[name]].
template <class Work>
void each_table(const Node &root, const std::string &name, Reading &reading, const Work &work)
{
  const Node::Entry *list = root.find(name);
  if (!list)
    return;
  if (list->value.kind != Node::Kind::array) {
    reading.add(list->value.place, name + " is written [[" + name + "]], once for each");
    return;
  }
  for (std::size_t i = 0; i < list->value.items.size(); ++i)
    work(Section{&list->value.items[i], name + "." + std::to_string(i)});
}

RecordSet described_set(const std::string &folder, const std::string &path)
{
  const Node root = read_case_file(path);
  Reading reading;
  reading.file   = path;
  reading.folder = folder;
  RecordSet set;
  set.folder = folder;
  read(Section{&root, ""}, record_set_rows(), set, reading, {"record", "level"});
  if (!(set.band[1] > set.band[0]))
    reading.add(reading.place("band"), reading.as_written("band") + ": the upper end is above the lower one");
  each_table(root, "record", reading, [&](const Section &section) {
    RecordEntry entry;
    read(section, record_rows(), entry, reading, {"channels"});
    read_channels(section, entry, reading);
    set.entries.push_back(entry);
  });
  each_table(root, "level", reading, [&](const Section &section) {
    MeasuredLevel level;
    read(section, level_rows(), level, reading);
    if (std::isnan(level.rms) == std::isnan(level.peak) &&
        reading.usable({section.key("rms"), section.key("peak")}))
      reading.add(section.node->place,
                  section.name + ": a level is either rms or peak, for example rms = \"0.4 g\"");
    set.levels.push_back(level);
  });
  if (reading.problems.empty() && set.entries.empty() && set.levels.empty())
    reading.add(Place{path}, "neither [[record]] nor [[level]]; a record needs at least file = \"pass-1.csv\"");
  if (!reading.problems.empty())
    throw InputError(std::move(reading.problems));
  return set;
}

/// Samples of a record in which force and all sensors are complete.
std::vector<twin::Span> common_pieces(const twin::CleanRecord &record, const std::vector<std::string> &names)
{
  std::vector<twin::Span> common{{0, record.n}};
  for (const std::string &name : names) {
    std::vector<twin::Span> next;
    for (const twin::Span &a : common)
      for (const twin::Span &b : record.find(name)->pieces) {
        const twin::Span both{std::max(a.begin, b.begin), std::min(a.end, b.end)};
        if (both.end > both.begin)
          next.push_back(both);
      }
    common = std::move(next);
  }
  return common;
}

bool has_force(const twin::CleanRecord &record)
{
  const twin::CleanChannel *force = record.find("force");
  return force && force->quantity == twin::Quantity::force;
}

twin::ForcedSamples samples_of(const twin::CleanRecord &record, const std::vector<std::string> &sensors,
                               const twin::Span &span)
{
  twin::ForcedSamples samples;
  if (has_force(record))
    samples.force = record.find("force")->value.segment(span.begin, span.size());
  samples.acceleration.resize(span.size(), Eigen::Index(sensors.size()));
  for (std::size_t j = 0; j < sensors.size(); ++j)
    samples.acceleration.col(Eigen::Index(j)) = record.find(sensors[j])->value.segment(span.begin, span.size());
  return samples;
}

bool is_sensor(const twin::CleanRecord &record, const std::string &place)
{
  const twin::CleanChannel *channel = record.find(place);
  return channel && channel->quantity == twin::Quantity::acceleration && channel->clipped == 0 &&
         !channel->pieces.empty();
}

/// With force or without: one likelihood for all records.
void require_all_or_none(const std::vector<twin::CleanRecord> &records)
{
  for (const twin::CleanRecord &record : records)
    if (has_force(record) != has_force(records.front())) {
      const bool first = has_force(records.front());
      throw InputError(fmt::format("{}: no channel \"force\" in N or kN, which {} has; name it with --channel "
                                   "AI_01=force, or calibrate records with and without force one after the other",
                                   first ? record.file : records.front().file,
                                   first ? records.front().file : record.file));
    }
}

/// Splits pieces of one record by its role; without roles the last third of the samples is the check.
void divide(const twin::CleanRecord &record, const RecordEntry &entry, const bool roles, MeasuredPieces &into)
{
  std::vector<std::string> names = into.sensors;
  if (into.force_recorded)
    names.push_back("force");
  const auto least  = Eigen::Index(shortest_piece * record.rate);
  const auto pieces = common_pieces(record, names);
  Eigen::Index all  = 0;
  for (const twin::Span &span : pieces)
    all += span.size();
  Eigen::Index seen = 0;
  for (const twin::Span &span : pieces) {
    const auto cut = roles ? (entry.role == RecordRole::check ? span.begin : span.end)
                           : std::clamp(span.begin + 2 * all / 3 - seen, span.begin, span.end);
    seen += span.size();
    for (const twin::Span &part : {twin::Span{span.begin, cut}, twin::Span{cut, span.end}}) {
      if (part.size() == 0)
        continue;
      if (part.size() < least) {
        into.notes.emplace_back(
            NoteId::record_left_out, record.file,
            fmt::format("a piece of {:.2f} s is too short and left out", double(part.size()) / record.rate));
        continue;
      }
      (part.begin == span.begin && cut > span.begin ? into.fit : into.check)
          .push_back(samples_of(record, into.sensors, part));
    }
  }
}
}  // namespace

RecordSet read_record_set(const std::string &folder)
{
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw InputError("--measured " + folder +
                     ": no such folder; it holds the records, and records.toml where they have roles");
  if (fs::exists(folder + "/records.toml", ignored))
    return described_set(folder, folder + "/records.toml");
  RecordSet set;
  set.folder = folder;
  for (const std::string &name : names_in(folder))
    if (const std::string file = (fs::path(folder) / name).string();
        fs::is_regular_file(file, ignored) && twin::is_record_file(file))
      set.entries.emplace_back().file = file;
  std::sort(set.entries.begin(), set.entries.end(),
            [](const RecordEntry &a, const RecordEntry &b) { return a.file < b.file; });
  if (set.entries.empty())
    throw InputError("--measured " + folder + ": no record in it; .csv, .npy, .uff and .mat are read");
  return set;
}

MeasuredPieces measured_pieces(const RecordSet &set, const std::vector<std::string> &places,
                               const twin::ReadOptions &options, const std::map<std::string, std::string> &of_case)
{
  // Two clocks of the same make differ by some 1e-5, and a frequency by as much: far below every interval of a
  // calibration, the narrowest of which is about 1e-3.
  constexpr double same_rate = 1e-4;
  MeasuredPieces result;
  std::vector<twin::CleanRecord> records;
  for (const RecordEntry &entry : set.entries) {
    twin::ReadOptions sheet_options = options;
    for (const auto *less_near : {&entry.channels, &of_case})
      sheet_options.channels.insert(less_near->begin(), less_near->end());  // a name that is there stays
    records.push_back(twin::clean_record(twin::read_record(entry.file, sheet_options)));
    const twin::CleanRecord &record = records.back();
    for (const twin::CleanChannel &channel : record.channels)
      if (channel.clipped > 0 && (twin::is_driving_force(channel.name) ||
                                  std::find(places.begin(), places.end(), channel.name) != places.end()))
        result.clipped.push_back(valid_text(fs::path(entry.file).filename().string()) + ": " + channel.name);
    if (std::abs(record.rate / records.front().rate - 1) > same_rate)
      throw InputError(fmt::format("{} has {:.8g} samples per second, {} {:.8g}; calibrate them one after the "
                                   "other, or bring them to one rate",
                                   record.file, record.rate, records.front().file, records.front().rate));
    if (entry.between != set.entries.front().between)
      throw InputError(set.folder +
                       "/records.toml: between = \"lines\" is for all records of a folder or for none");
    result.files.push_back(valid_text(fs::path(entry.file).filename().string()));
    for (const std::string &note : record.notes)
      result.notes.push_back(Warning{WarningId::record_repaired, result.files.back(), note});
  }
  require_all_or_none(records);
  result.force_recorded = has_force(records.front());
  for (const std::string &place : places) {
    const auto shown = std::count_if(records.begin(), records.end(),
                                     [&](const twin::CleanRecord &r) { return is_sensor(r, place); });
    if (shown == long(records.size()))
      result.sensors.push_back(place);
    else if (shown > 0)
      result.notes.emplace_back(NoteId::record_left_out, "",
                                place + " is not a whole channel of every record and is left out");
  }
  if (result.sensors.empty()) {
    std::string list;
    for (const std::string &place : places)
      list += (list.empty() ? "" : ", ") + place;
    throw InputError("--measured " + set.folder + ": no acceleration of " + list +
                     " in every record; name the channels with --channel AI_07=upper_work_roll");
  }
  bool roles = false;
  for (const RecordEntry &entry : set.entries)
    roles = roles || entry.role;
  double load = 0;
  int loads   = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    divide(records[i], set.entries[i], roles, result);
    const bool given = !std::isnan(set.entries[i].load);
    if (set.entries[i].role != RecordRole::check && (given || result.force_recorded)) {
      load += given ? set.entries[i].load : records[i].find("force")->offset;
      ++loads;
    }
  }
  result.rate    = records.front().rate;
  result.load    = load / std::max(1, loads);
  result.between = set.entries.front().between;
  for (const auto &[pieces, what] : {std::pair{&result.fit, "fit"}, std::pair{&result.check, "check"}})
    if (pieces->empty())
      throw InputError(fmt::format("--measured {}: nothing is left for the {}; a piece without gaps has to last "
                                   "{:.0f} s at least",
                                   set.folder, what, shortest_piece));
  return result;
}
}  // namespace mill
