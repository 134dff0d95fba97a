#pragma once
#include <map>
#include <string>

// Which run a stored file is of.  run_id is the hash of all that decides the results (version, verb, resolved
// case, bytes of the files it names), so that two runs of the same inputs have the same one: their results are the
// same (to the bit but for component modes, see docs/decisions/28-stages-side-by-side.md).  It stands in
// results.json, run.json, report.html and the first line of every TOML file of a run; tables, fields and JSON
// below the folder keep the form their readers know and stand with their checksums in run.json.
namespace mill {
/// "# run_id 0123456789abcdef\n", the first line of resolved.toml and lumped_model*.toml.
std::string run_id_line(const std::string &run_id);

/// What such a file begins with; empty for a file without that line.
std::string run_id_of_toml(const std::string &text);

/// @throws InputError  two files of one folder are of two runs; a file without run_id (empty: earlier version)
/// fits all
void require_one_run(const std::string &file, const std::string &run_id, const std::string &other_file,
                     const std::string &other_run_id);

/// For a TOML file about to be read: where it lies in a result folder, it must be of the run that the folder
/// shows. A copy elsewhere, or one that was edited, is a case like any other.
/// @throws InputError  publishing was interrupted there, or run.json beside it is of another run
void require_unmixed(const std::string &path, const std::string &text);

/// Is a file of this name, as "curves/modes.csv", one of those that checksums_below() lists?
bool is_summed(const std::string &name);

/// Checksums of the files in curves/, response/, fields/ and models/ below a folder: "curves/modes.csv" -> hash.
/// @param known  of files whose text was at hand when they were written; they are not read
std::map<std::string, std::string> checksums_below(const std::string &directory,
                                                   const std::map<std::string, std::string> &known = {});

/// @throws InputError  a file of the list that is there has another checksum; one that is gone is no error
void require_unchanged(const std::string &directory, const std::map<std::string, std::string> &checksums,
                       const std::string &run_id);
}  // namespace mill
