#pragma once
#include "core/records/finding_kind.h"
#include "report/page/run.h"
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

// What analyse, calibrate and advise leave in their folders, as their pages read it.
namespace mill::report {
/// The document of a verb from its text.
/// @param file    "advice.json"
/// @param needed  members without which it is another's
/// @param again   how to get one, "run millstand advise again"
/// @throws InputError  at the file: not JSON, a member is missing
nlohmann::json written_document(const std::string &directory, const std::string &file, const std::string &text,
                                const std::vector<std::string> &needed, const std::string &again);

/// Folder and case of a document, for the frame of its page.
Run run_of(const std::string &directory, const nlohmann::json &document);

/// Of a finding of analyse; nothing where this version does not know its kind.
std::optional<FindingKind> kind_of(const nlohmann::json &finding);

/// NaN where it is not a number.
double number_in(const nlohmann::json &value);

/// Sentences as a list of the page.
std::string list_of(const nlohmann::json &sentences);

/// Those of the tables that are in the folder, by name.
std::map<std::string, Table> written_tables(const std::string &directory, const std::vector<std::string> &names);
}  // namespace mill::report
