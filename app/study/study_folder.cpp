#include "app/study/study_folder.h"
#include "app/process/version.h"
#include "app/study/store/database.h"
#include "app/verbs/checked_case.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/case/case_file.h"
#include "core/model/case.h"
#include "core/records/search_goal.h"
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace mill {
namespace {
constexpr int format_version = 1;

std::string list_toml(const std::vector<std::string> &texts)
{
  std::string list;
  for (const std::string &text : texts)
    list += (list.empty() ? "" : ", ") + quoted(text);
  return "[" + list + "]";
}

std::string kind_name(const Spread::Kind kind)
{
  switch (kind) {
  case Spread::Kind::uniform:
    return "uniform";
  case Spread::Kind::normal:
    return "normal";
  case Spread::Kind::truncated:
    return "truncated";
  case Spread::Kind::triangular:
    return "triangular";
  case Spread::Kind::tolerance:
    return "tolerance";
  case Spread::Kind::none:
    break;
  }
  return "none";
}

Spread::Kind kind_named(const std::string &name)
{
  for (const Spread::Kind kind : {Spread::Kind::uniform, Spread::Kind::normal, Spread::Kind::truncated,
                                  Spread::Kind::triangular, Spread::Kind::tolerance})
    if (kind_name(kind) == name)
      return kind;
  return Spread::Kind::none;
}

std::string number_line(const char *name, const double value)
{
  return std::isfinite(value) ? fmt::format("{} = {}\n", name, number_text(value)) : "";
}

std::string numbers_line(const char *name, const std::vector<double> &values)
{
  std::string list;
  for (const double value : values) {
    if (!std::isfinite(value))
      return "";
    list += (list.empty() ? "" : ", ") + number_text(value);
  }
  return list.empty() ? "" : fmt::format("{} = [{}]\n", name, list);
}

std::string key_toml(const UncertainKey &uncertain)
{
  const Spread &s = uncertain.spread;
  std::string text =
      fmt::format("\n[[key]]\nname = {}\npath = {}\nmeaning = {}\nunit = {}\nwritten = {}\nspread = {}\n",
                  quoted(uncertain.key.name), quoted(uncertain.key.path), quoted(uncertain.key.meaning),
                  quoted(uncertain.key.unit), quoted(uncertain.written), quoted(kind_name(s.kind)));
  text += number_line("mean", s.mean) + number_line("sd", s.sd) + number_line("low", s.low) +
          number_line("high", s.high);
  const bool words = !uncertain.key.numbers.empty() && std::isnan(uncertain.key.numbers.front());
  text += uncertain.key.pair ? "pair = true\n" : "";
  return text + (words ? "words = " + list_toml(uncertain.key.values) + "\n" : "");
}

std::string text_of(const Node &table, const std::string &key)
{
  const Node::Entry *entry = table.find(key);
  return entry ? entry->value.text : "";
}

double number_of(const Node &table, const std::string &key)
{
  const Node::Entry *entry = table.find(key);
  return entry ? entry->value.number : not_given;
}

std::vector<std::string> texts_of(const Node &table, const std::string &key)
{
  std::vector<std::string> texts;
  if (const Node::Entry *entry = table.find(key))
    for (const Node &item : entry->value.items)
      texts.push_back(item.text);
  return texts;
}

std::vector<double> numbers_of(const Node &table, const std::string &key)
{
  std::vector<double> numbers;
  if (const Node::Entry *entry = table.find(key))
    for (const Node &item : entry->value.items)
      numbers.push_back(item.number);
  return numbers;
}

UncertainKey key_of(const Node &table)
{
  UncertainKey uncertain;
  uncertain.key     = {text_of(table, "name"),  text_of(table, "path"),   text_of(table, "meaning"),
                       text_of(table, "unit"),  texts_of(table, "words"), {},
                       bool(table.find("pair"))};
  uncertain.written = text_of(table, "written");
  uncertain.key.numbers.assign(uncertain.key.values.size(), not_given);
  uncertain.spread = {kind_named(text_of(table, "spread")), number_of(table, "mean"), number_of(table, "sd"),
                      number_of(table, "low"), number_of(table, "high")};
  return uncertain;
}

// Lines of resolved.toml that one case has and the other has not.
std::string differing_lines(const std::string &before, const std::string &now)
{
  const auto lines = [](const std::string &text) {
    std::set<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      all.insert(line);
    return all;
  };
  const auto old_lines = lines(before), new_lines = lines(now);
  std::string text;
  int shown_lines = 0;
  for (const std::string &line : new_lines)
    if (!old_lines.count(line) && ++shown_lines <= 3)
      text += "\n  now     " + line;
  shown_lines = 0;
  for (const std::string &line : old_lines)
    if (!new_lines.count(line) && ++shown_lines <= 3)
      text += "\n  before  " + line;
  return text;
}

std::string design_file(const std::string &folder)
{
  return folder + "/study.db";
}

DesignRow row_of(const Statement &rows)
{
  return {rows.integer(0), rows.integer(1), rows.integer(2), rows.numbers(3)};
}
}  // namespace

long held_out_rows(const Study &study)
{
  return study.method == StudyMethod::chaos ? std::max(20L, study.samples / 4) : 0;
}

std::string study_toml(const Study &study)
{
  std::string text = fmt::format(
      "# A study of millstand; written by 'millstand study new' and not changed afterwards.\n"
      "schema = {}\ncase = {}\ncase_name = {}\ntitle = {}\nsets = {}\nmethod = {}\nsamples = {}\nseed = {}\nmodel "
      "= {}\n"
      "work = {}\nversion = {}\nbase = {}\nrows = {}\ncorrelations = {}\n",
      format_version, quoted(study.case_path), quoted(study.case_name), quoted(study.title), list_toml(study.sets),
      quoted(word_of(study.method)), study.samples, study.seed, quoted(word_of(study.model)), quoted(study.work),
      quoted(study.version), quoted(study.base), study.rows, list_toml(study.correlations));
  text += number_line("seconds", study.seconds);
  if (!study.objective.empty())
    text += fmt::format("objective = {}\nsearched = {}\n", quoted(study.objective),
                        quoted(word_of(study.greatest ? SearchGoal::greatest : SearchGoal::least)));
  for (const UncertainKey &key : study.keys)
    text += key_toml(key);
  for (const WatchedResult &result : study.watched)
    text += fmt::format("\n[[result]]\nname = {}\nunit = {}\nmeaning = {}\n", quoted(result.name),
                        quoted(result.unit), quoted(result.meaning)) +
            number_line("base", result.base) + number_line("error_estimate", result.error_estimate) +
            numbers_line("slopes", result.slopes);
  return text;
}

std::string differences(const Study &before, const Study &now)
{
  const auto asked = [](Study study) {
    study.seconds = not_given;  // measured
    return study_toml(study);
  };
  return differing_lines(asked(before), asked(now));
}

Study read_study(const std::string &folder)
{
  const std::string path = folder + "/study.toml";
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw InputError("the folder " + folder + " holds no study; 'millstand study new CASE .. -o " + folder +
                     "' makes one");
  const Node root = read_case_file(path);
  if (const double format = number_of(root, "schema"); format != format_version)
    throw InputError(path + " was written by another version of millstand (format " + number_text(format) +
                     "); make the study again with 'millstand study new'");
  Study s;
  s.folder          = folder;
  s.case_path       = text_of(root, "case");
  s.case_name       = text_of(root, "case_name");
  s.title           = text_of(root, "title");
  s.sets            = texts_of(root, "sets");
  const auto method = choice_named<StudyMethod>(text_of(root, "method"));
  if (!method)
    throw InputError(path + ": method = " + quoted(text_of(root, "method")) + " is not known");
  s.method       = *method;
  s.samples      = long(number_of(root, "samples"));
  s.seed         = int(number_of(root, "seed"));
  s.model        = choice_named<ModelKind>(text_of(root, "model")).value_or(ModelKind::full);
  s.work         = text_of(root, "work");
  s.version      = text_of(root, "version");
  s.base         = text_of(root, "base");
  s.rows         = long(number_of(root, "rows"));
  s.seconds      = number_of(root, "seconds");
  s.correlations = texts_of(root, "correlations");
  s.objective    = text_of(root, "objective");
  s.greatest     = choice_named<SearchGoal>(text_of(root, "searched")) == SearchGoal::greatest;
  if (const Node::Entry *keys = root.find("key"))
    for (const Node &table : keys->value.items)
      s.keys.push_back(key_of(table));
  if (const Node::Entry *results = root.find("result"))
    for (const Node &table : results->value.items)
      s.watched.push_back({text_of(table, "name"), text_of(table, "unit"), text_of(table, "meaning"),
                           number_of(table, "base"), number_of(table, "error_estimate"),
                           numbers_of(table, "slopes")});
  return s;
}

void write_study(const Study &study, const std::vector<DesignRow> &rows)
{
  const std::string path = design_file(study.folder);
  std::error_code ignored;
  fs::remove(path, ignored);
  {
    Database file(path, Database::Open::write);
    Transaction all(file);
    file.execute(
        "CREATE TABLE design(place INTEGER PRIMARY KEY, row INTEGER NOT NULL, key INTEGER NOT NULL, numbers "
        "BLOB); CREATE TABLE base(resolved TEXT)");
    file.prepare("INSERT INTO base VALUES(?)").bind(0, read_case(study.case_path, study.sets).resolved).run();
    Statement row = file.prepare("INSERT INTO design VALUES(?, ?, ?, ?)");
    for (const DesignRow &one : rows)
      row.bind(0, one.place).bind(1, one.row).bind(2, one.key).bind(3, one.numbers).run();
    file.execute("CREATE INDEX by_row ON design(row)");
    all.commit();
  }
  write_atomically(study.folder + "/study.toml", study_toml(study));
}

void read_design(const Study &study, const std::int64_t from, const std::int64_t to,
                 const std::function<void(DesignRow &&)> &take)
{
  Database file(design_file(study.folder), Database::Open::read);
  Statement rows =
      file.prepare("SELECT place, row, key, numbers FROM design WHERE place >= ? AND place < ? ORDER BY place");
  rows.bind(0, from).bind(1, to);
  while (rows.step())
    take(row_of(rows));
}

void read_design_by_row(const Study &study, const std::function<void(DesignRow &&)> &take)
{
  Database file(design_file(study.folder), Database::Open::read);
  Statement rows = file.prepare("SELECT place, row, key, numbers FROM design ORDER BY row");
  while (rows.step())
    take(row_of(rows));
}

Case base_case(const Study &study)
{
  if (study.version != version())
    throw InputError("the study in " + study.folder + " was made by millstand " + study.version + ", this is " +
                     version() + "; their rows do not mix: make the study again with 'millstand study new'");
  Case base = read_case(study.case_path, study.sets);
  if (hash_of(base.resolved) == study.base)
    return base;
  Database file(design_file(study.folder), Database::Open::read);
  Statement stored = file.prepare("SELECT resolved FROM base");
  throw InputError("the case " + study.case_path + " has changed since the study in " + study.folder +
                   " was made; make the study again with 'millstand study new', or change it back" +
                   (stored.step() ? differing_lines(stored.text(0), base.resolved) : ""));
}

std::vector<std::string> sets_of(const Study &study, const std::vector<double> &numbers)
{
  std::vector<std::string> sets = study.sets;
  for (std::size_t k = 0; k < study.keys.size(); ++k)
    sets.push_back(study.keys[k].key.path + "=" + set_value(study.keys[k], numbers[k]));
  return sets;
}

std::int64_t row_key(const Case &row)
{
  return std::int64_t(std::strtoull(hash_of(row.resolved).c_str(), nullptr, 16));
}

std::int64_t row_key_of(const Study &study, const std::vector<double> &inputs)
{
  return row_key(checked_row(study.case_path, sets_of(study, inputs)));
}

std::string row_name(const Study &study, const DesignRow &row)
{
  std::string values;
  for (std::size_t k = 0; k < study.keys.size(); ++k)
    values += (k > 0 ? ", " : "") + study.keys[k].key.name + " = " + set_value(study.keys[k], row.numbers[k]);
  return fmt::format("row {} ({})", row.row, values);
}

std::pair<std::int64_t, std::int64_t> shard_places(const Study &study, const long shard, const long of)
{
  const auto begin = [&](const long i) { return std::int64_t(study.rows) * (i - 1) / of; };
  return {begin(shard), begin(shard + 1)};
}
}  // namespace mill
