#include "report/page/run.h"
#include "core/base/errors.h"
#include "core/base/file_ending.h"
#include "core/base/files.h"
#include "core/records/json_archive.h"
#include "core/records/result_names.h"
#include "core/records/run_identity.h"
#include "report/page/curves.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace mill::report {
namespace {
using Json                  = nlohmann::ordered_json;  // results stay in the order in which they were computed
constexpr double not_stored = std::numeric_limits<double>::quiet_NaN();

Place place_of_byte(const std::string &path, const std::string &text, const std::size_t byte)
{
  Place place{path, 1, 1};
  for (std::size_t i = 0; i + 1 < std::min(byte, text.size()); ++i) {
    place.column = text[i] == '\n' ? 1 : place.column + 1;
    place.line += text[i] == '\n';
  }
  return place;
}

Json parsed(const std::string &path, const std::string &text)
{
  const std::string remedy = "; run the case again, or restore the file as the program wrote it";
  try {
    json::require_flat(text);
    return Json::parse(text);
  } catch (const nlohmann::json::parse_error &error) {
    throw InputError(place_of_byte(path, text, error.byte), "this is not JSON" + remedy);
  } catch (const nlohmann::json::exception &) {
    throw InputError(Place{path, 1, 1}, "this holds a number that no computer stores" + remedy);
  } catch (const InputError &error) {
    throw InputError(Place{path, 1, 1}, error.problems.front().message + remedy);
  }
}

double number_at(const Json &object, const char *key)
{
  const auto match = object.find(key);
  return match != object.end() && match->is_number() ? match->get<double>() : not_stored;
}

std::string text_at(const Json &object, const char *key)
{
  const auto match = object.find(key);
  return match != object.end() && match->is_string() ? match->get<std::string>() : "";
}

bool flag_at(const Json &object, const char *key)
{
  const auto match = object.find(key);
  return match != object.end() && match->is_boolean() && match->get<bool>();
}

Json object_at(const Json &object, const char *key)
{
  const auto match = object.find(key);
  return match != object.end() && match->is_object() ? *match : Json::object();
}

Json list_at(const Json &object, const char *key)
{
  const auto match = object.find(key);
  return match != object.end() && match->is_array() ? *match : Json::array();
}

std::vector<std::string> texts_at(const Json &object, const char *key)
{
  std::vector<std::string> texts;
  for (const Json &entry : list_at(object, key))
    texts.push_back(entry.get<std::string>());
  return texts;
}

Result result_of(const std::string &name, const Json &entry)
{
  entry.at("value");  // an entry without one was not written by this program
  Result result{name,
                number_at(entry, "value"),
                text_at(entry, "unit"),
                text_at(entry, "source"),
                text_at(entry, "at"),
                number_at(entry, "error_estimate"),
                texts_at(entry, "inputs"),
                {},
                texts_at(entry, "error_lacks"),
                texts_at(entry, "estimated")};
  for (const Json &point : list_at(entry, "at_values"))
    result.at_values.push_back({number_at(point, "value"), text_at(point, "unit")});
  for (const Json &check : list_at(entry, "checks"))
    result.checks.push_back({text_at(check, "name"), number_at(check, "value"), text_at(check, "note")});
  return result;
}

EstimateInfo estimate_of(const Json &entry)
{
  EstimateInfo e{text_at(entry, "key"),
                 number_at(entry, "value"),
                 number_at(entry, "low"),
                 number_at(entry, "high"),
                 text_at(entry, "unit"),
                 text_at(entry, "rule"),
                 {}};
  const Json moves = object_at(entry, "moves");
  for (const auto &[name, move] : moves.items())
    if (move.is_number())
      e.moves.emplace_back(name, move.get<double>());
  return e;
}

// A run of an earlier version kept the texts alone.
std::vector<Warning> warnings_of(const Json &json)
{
  std::vector<Warning> stored, once;
  if (const Json records = list_at(json, "warning_records"); !records.empty())
    json::Reader(records).read(stored);
  else
    for (const std::string &text : texts_at(json, "warnings"))
      stored.push_back(warning_of_text(text));
  for (Warning &warning : stored)  // two passes may give the same one
    if (std::find(once.begin(), once.end(), warning) == once.end())
      once.push_back(std::move(warning));
  return once;
}

// Returns the run_id; empty when the file states none.
std::string read_results(const std::string &path, Run &run)
{
  const Json json = parsed(path, read_text(path));
  try {
    run.case_name   = json.at("case").get<std::string>();
    run.status      = json.at("status").get<std::string>();
    run.warnings    = warnings_of(json);
    run.assumptions = texts_at(json, "assumptions");
    for (const Json &entry : list_at(json, "estimates"))
      run.estimates.push_back(estimate_of(entry));
    for (const auto &[name, entry] : json.at("values").items())
      run.results.push_back(result_of(name, entry));
    return text_at(json, "run_id");
  } catch (const nlohmann::json::exception &) {
    throw InputError(Place{path, 1, 1},
                     "this is JSON, but not a results.json of this program: \"case\", \"status\" "
                     "or \"values\" is missing or of the wrong type; run the case again");
  }
}

BearingInfo bearing_of(const Json &json)
{
  BearingInfo bearing;
  for (const auto &[key, value] : json.items())
    if (value.is_number())
      bearing.size[key] = value.get<double>();
  bearing.hands = text_at(json, "arrangement");
  return bearing;
}

Manifest manifest_of(const Json &json)
{
  Manifest m;
  m.program           = text_at(json, "program");
  m.version           = text_at(json, "version");
  m.case_path         = text_at(json, "case_path");
  m.kind              = choice_named<KindOfCase>(text_at(json, "kind"));
  m.title             = text_at(json, "title");
  m.run_id            = text_at(json, "run_id");
  m.date              = text_at(json, "date");
  m.hostname          = text_at(json, "hostname");
  m.blas              = text_at(json, "blas");
  m.threads           = json.value("threads", 0);
  m.peak_memory       = json.value("peak_memory", 0.0);
  const Json versions = object_at(json, "versions"), geometry = object_at(json, "geometry");
  for (const auto &[name, version] : versions.items())
    m.versions.emplace_back(name, version.get<std::string>());
  for (const Json &stage : list_at(json, "timings"))
    m.timings.push_back({text_at(stage, "stage"), number_at(stage, "seconds"), flag_at(stage, "cached")});
  for (const auto &[name, length] : geometry.items())
    if (length.is_number())
      m.geometry[name] = length.get<double>();
  const Json bearings = object_at(json, "bearings");
  for (const auto &[name, bearing] : bearings.items())
    m.bearings[name] = bearing_of(bearing);
  for (const Json &pass : list_at(json, "passes"))
    m.passes.push_back({text_at(pass, "name"), text_at(pass, "slug"), number_at(pass, "load"),
                        flag_at(pass, "synthetic"), choice_named<ForceMeaning>(text_at(pass, "force_meaning"))});
  for (const Json &verdict : list_at(json, "critical_speed"))
    m.speeds.push_back(speed_verdict_of(verdict));
  return m;
}

using Checksums = std::map<std::string, std::string>;

Checksums checksums_of(const Json &manifest)
{
  Checksums sums;
  const Json files = object_at(manifest, "files");
  for (const auto &[name, sum] : files.items())
    sums[name] = sum.get<std::string>();
  return sums;
}

// Returns the checksums of the other files; none where the file states none.
Checksums read_manifest(const std::string &path, Run &run)
{
  // Read outside of what follows: a file that the system refuses is not a missing one, and every page has its
  // run.
  const bool there       = std::filesystem::is_regular_file(path);
  const std::string text = there ? read_text(path) : "";
  try {
    const Json json = parsed(path, text);
    run.manifest    = manifest_of(json);
    return checksums_of(json);
  } catch (const InputError &) {
    run.remarks.push_back(
        "run.json is missing or cannot be read: run id, date, versions, timings and the geometry "
        "of the sketch are left out.");
  } catch (const nlohmann::json::exception &) {
    run.remarks.push_back("run.json holds an entry of the wrong type: run id, date, versions, timings and the "
                          "geometry of the sketch are left out.");
  }
  return {};
}

using Tables = std::map<std::string, Table>;

// A table that its run still has, or else that of the file.
Table table_of(const std::string &name, const std::string &path, Tables &at_hand)
{
  const auto match = at_hand.find(name);
  return match != at_hand.end() && reads_back(match->second) ? std::move(match->second) : read_table(path);
}

void read_tables(const std::string &folder, const Checksums &of_this_run, Tables &at_hand, Run &run)
{
  namespace fs         = std::filesystem;
  const fs::path where = fs::path(run.directory) / folder;
  if (!fs::is_directory(where))
    return;
  for (const std::string &entry : names_in(where.string())) {
    const fs::path file = where / entry;
    if (!has_ending(file, FileEnding::csv))
      continue;
    const std::string name = folder + "/" + file.stem().string();
    if (!of_this_run.empty() && !of_this_run.count(name + ".csv")) {
      run.remarks.push_back(name + ".csv is not of this run and is left out.");
      continue;
    }
    try {
      run.tables[name] = table_of(name, file.string(), at_hand);
    } catch (const InputError &error) {
      run.remarks.push_back(name + ".csv cannot be read and is left out: " + error.what());
    }
  }
}

// A file with the ending of no known curve would be taken as another contact or bearing.
void leave_out_unknown_curves(Run &run)
{
  std::vector<std::string> items;  // curves/contact-upper
  for (const auto &[path, table] : run.tables)
    if (const auto name = curve_name(path); name && !*name->kind->ending)
      items.push_back(path);
  for (const std::string &path : items)
    if (!run.manifest.bearings.count(curve_name(path)->item) &&
        std::any_of(items.begin(), items.end(),
                    [&](const std::string &other) { return path.rfind(other + "-", 0) == 0; })) {
      run.remarks.push_back(path + ".csv is not a curve that this program knows and is not shown.");
      run.tables.erase(path);
    }
}

// A pass whose case states no working load works at the mean of its record.
void fill_loads(Run &run)
{
  for (PassInfo &pass : run.manifest.passes)
    if (const Table *response = run.table("response/" + pass.slug); response && std::isnan(pass.load))
      if (const Eigen::VectorXd force = values_of(*response, {"force", "N"}); force.size() > 0)
        pass.load = force.mean();
}
}  // namespace

const Result *Run::find(const std::string &name) const
{
  for (const Result &result : results)
    if (result.name == name)
      return &result;
  return nullptr;
}

const Table *Run::table(const std::string &path) const
{
  const auto match = tables.find(path);
  return match == tables.end() ? nullptr : &match->second;
}

double BearingInfo::operator()(const std::string &key) const
{
  const auto match = size.find(key);
  return match == size.end() ? not_stored : match->second;
}

BearingInfo Run::bearing(const std::string &name) const
{
  const auto match = manifest.bearings.find(name);
  return match == manifest.bearings.end() ? BearingInfo{} : match->second;
}

namespace {
// @param at_hand  tables of the run that has just written the folder; null: somebody else reads it
Run read_folder(const std::string &directory, Tables *at_hand)
{
  namespace fs = std::filesystem;
  Run run;
  run.directory         = directory;
  const fs::path folder = directory;
  if (!fs::exists(folder / "results.json"))
    throw InputError(Place{(folder / "results.json").string(), 0, 0},
                     "no results.json in " + directory +
                         "; name the folder that `millstand run` has written, or run the case first");
  const std::string results = (folder / "results.json").string(), manifest = (folder / "run.json").string();
  const std::string run_id  = read_results(results, run);
  const Checksums checksums = read_manifest(manifest, run);
  require_one_run(results, run_id, manifest, run.manifest.run_id);
  Tables none;
  if (!at_hand)
    require_unchanged(directory, checksums, run.manifest.run_id);
  for (const char *folder_of_tables : {"curves", "response"})
    read_tables(folder_of_tables, checksums, at_hand ? *at_hand : none, run);
  leave_out_unknown_curves(run);
  fill_loads(run);
  std::sort(run.remarks.begin(), run.remarks.end());  // the order of a directory is not defined
  return run;
}
}  // namespace

Run read_run(const std::string &directory)
{
  return read_folder(directory, nullptr);
}

Run read_own_run(const std::string &directory, Tables at_hand)
{
  return read_folder(directory, &at_hand);
}
}  // namespace mill::report
