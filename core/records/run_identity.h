#pragma once
#include <map>
#include <string>

// Which run a stored file is of.  run_id is the hash of all that decides the results (version, verb, resolved
// case, bytes of the files it names), so that two runs of the same inputs have the same one: their results are the
// same (to the bit but for component modes, see docs/decisions/28-stages-side-by-side.md).  results.json,
// run.json, report.html and the first line of every TOML file of a run contain it; tables, fields and JSON below
// the folder keep the form that other programs read, and run.json lists their checksums.
namespace mill {
/// "# run_id 0123456789abcdef\n", the first line of resolved.toml and lumped_model*.toml.
std::string run_id_line(const std::string &run_id);

/// The run_id in the first line of such a file; empty for a file without that line.
std::string run_id_of_toml(const std::string &text);

/// @throws InputError  two files of one folder are of two runs; a file without run_id (empty: earlier version)
///                     agrees with every run
void require_one_run(const std::string &file, const std::string &run_id, const std::string &other_file,
                     const std::string &other_run_id);

/// Text of a TOML file.  Where it is one of the files of a result folder, the run of that folder is complete
/// (WholeRun) and the file is of this run.  A copy elsewhere, or one that was edited, is a case like any other.
/// @throws InputError  as read_text and WholeRun, or run.json in that folder is of another run
std::string read_toml_text(const std::string &path);

/// Is a file of this name, as "curves/modes.csv", one of those that checksums_below() lists?
bool is_summed(const std::string &name);

/// Checksums of the files in curves/, response/, fields/ and models/ below a folder: "curves/modes.csv" -> hash.
/// @param known  checksums of files whose text was in memory when they were written; these files are not read
std::map<std::string, std::string> checksums_below(const std::string &directory,
                                                   const std::map<std::string, std::string> &known = {});

/// @throws InputError  a file of the list has another checksum; a file that was removed is not an error
void require_unchanged(const std::string &directory, const std::map<std::string, std::string> &checksums,
                       const std::string &run_id);
}  // namespace mill
