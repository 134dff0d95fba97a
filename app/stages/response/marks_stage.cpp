#include "app/stages/response/marks_stage.h"
#include "core/records/json_archive.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_response.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
std::string result_word(std::string name)
{
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

OperatingPoint operating_point(const MarksQuestion &q)
{
  return {"{} at {}", {{q.spacing, "mm"}, {q.speed, "m/s"}}};
}

// The numbers of the record as results, each with its keys.
void add_results(Results &results, const MarksRecord &record, const dynamics::MarkSources &sources,
                 const std::map<std::string, KeyList> &mode_keys)
{
  const MarksQuestion &q = record.question;
  const auto add = [&](const ResultName &name, const double value, const std::string &method, const double error,
                       const KeyList &inputs) {
    Parameter p;
    p.value          = value;
    p.unit           = name.row().unit;
    p.method         = method;
    p.at             = operating_point(q);
    p.error_estimate = error;
    if (std::isnan(error))
      p.error_lacks = {"its own accuracy is not known"};
    p.inputs = inputs;
    results.add(name, p);
  };
  add(row::marks::frequency.of(), record.frequency, "speed over spacing (40.1)", q.accuracy, {});
  for (const RollMarks &roll : record.rolls) {
    KeyList key;
    for (const dynamics::MarkRoll &source : sources.rolls)
      if (source.name == roll.roll)
        key = {source.diameter_key};
    const std::string word = result_word(roll.roll);
    add(row::marks::per_turn.of(word), roll.per_turn, "circumference over spacing (40.2), " + roll.verdict,
        q.accuracy, key);
    add(row::marks::rotation.of(word), roll.rotation, "speed over circumference (40.1)", not_given, key);
  }
  for (const ModeMarks &mode : record.modes) {
    const auto keys = mode_keys.find(mode.key);
    add(row::marks::speed.of(mode.key), mode.speed, "frequency times spacing (40.1), mode " + record.model,
        std::hypot(q.accuracy, mode.error_estimate), keys == mode_keys.end() ? KeyList() : keys->second);
  }
}
}  // namespace

namespace {
// What a map shows: whole decibels, nil where nothing is magnified; a fifth of the file.
MarksRecord with_short_maps(MarksRecord record)
{
  for (MarkMap &map : record.maps)
    map.gain = map.gain.array().max(0).round();
  return record;
}
}  // namespace

void add_marks(RunContext &run, const MarksRecord &record, const dynamics::MarkSources &sources,
               const std::map<std::string, KeyList> &mode_keys)
{
  add_results(run.results, record, sources, mode_keys);
  for (const std::string &note : record.notes)
    run.warn({WarningId::marks_incomplete, "", note, "", "", {marks_family}});
  run.out.write("curves/marks.json", json_of_record(with_short_maps(record)));
}
}  // namespace mill
