#include "report/twin/analysis/written_document.h"
#include "core/base/errors.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace mill::report {
using nlohmann::json;

json written_document(const std::string &directory, const std::string &file, const std::string &text,
                      const std::vector<std::string> &needed, const std::string &again)
{
  json document = json::parse(text, nullptr, false);
  if (!document.is_object() || !std::all_of(needed.begin(), needed.end(),
                                            [&](const std::string &member) { return document.contains(member); }))
    throw InputError(Place{directory + "/" + file, 1, 1},
                     "this is not a file " + file + " of this program; " + again);
  return document;
}

Run run_of(const std::string &directory, const json &document)
{
  Run run;
  run.directory = directory;
  run.case_name = document["case"].get<std::string>();
  run.status    = "ok";
  return run;
}

std::optional<FindingKind> kind_of(const json &finding)
{
  return choice_named<FindingKind>(finding["kind"].get<std::string>());
}

double number_in(const json &value)
{
  return value.is_number() ? value.get<double>() : std::nan("");
}

std::string list_of(const json &sentences)
{
  std::string list;
  for (const json &sentence : sentences)
    list += "<li>" + escaped(sentence.get<std::string>()) + "</li>\n";
  return "<ul>\n" + list + "</ul>";
}

std::map<std::string, Table> written_tables(const std::string &directory, const std::vector<std::string> &names)
{
  std::map<std::string, Table> tables;
  for (const std::string &name : names)
    if (const std::string path = directory + "/" + name + ".csv"; std::filesystem::exists(path))
      tables.emplace(name, read_table(path));
  return tables;
}
}  // namespace mill::report
