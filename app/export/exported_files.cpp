#include "app/export/exported_files.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "dynamics/exchange/matlab.h"
#include "dynamics/exchange/modelica.h"
#include "dynamics/exchange/state_space_files.h"
#include "dynamics/fmu/unit_archive.h"
#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
// Words that one of the languages does not take as a name.
constexpr std::array reserved{
    "algorithm", "and",          "annotation", "block",       "break",    "case",       "catch",     "class",
    "connect",   "constant",     "continue",   "der",         "discrete", "each",       "else",      "elseif",
    "elsewhen",  "encapsulated", "end",        "enumeration", "equation", "expandable", "extends",   "external",
    "false",     "final",        "flow",       "for",         "function", "global",     "if",        "import",
    "impure",    "in",           "initial",    "inner",       "input",    "loop",       "model",     "not",
    "operator",  "or",           "otherwise",  "outer",       "output",   "package",    "parameter", "parfor",
    "partial",   "persistent",   "protected",  "public",      "pure",     "record",     "redeclare", "replaceable",
    "return",    "spmd",         "stream",     "switch",      "then",     "time",       "true",      "try",
    "type",      "when",         "while",      "within"};

// Libraries and built-in names that a package of the same name would hide; compared without regard to case, since
// a file system may not distinguish it.
constexpr std::array packages{"abs",
                              "assertionlevel",
                              "boolean",
                              "clock",
                              "complex",
                              "connections",
                              "externalobject",
                              "integer",
                              "max",
                              "modelica",
                              "modelica_linearsystems2",
                              "modelica_synchronous",
                              "modelicareference",
                              "modelicaservices",
                              "modelicatest",
                              "modelicatestoverdetermined",
                              "objectstab",
                              "pre",
                              "real",
                              "sample",
                              "stateselect",
                              "string",
                              "zeros"};

// Functions that the function of MATLAB uses itself.
constexpr std::array functions{"abs",       "any",      "diag", "diff", "error",     "expm",   "eye",
                               "fileparts", "fullfile", "load", "max",  "mfilename", "nargin", "numel",
                               "ones",      "size",     "sqrt", "sum",  "zeros"};

std::string lower_case(std::string text)
{
  for (char &c : text)
    c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return text;
}

template <std::size_t n> bool is_one_of(const std::array<const char *, n> &words, const std::string &word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Does a package or function of this name hide what its own text uses?
bool hides(const std::string &name)
{
  return is_one_of(packages, lower_case(name)) || is_one_of(functions, name);
}

bool is_name(const std::string &name)
{
  return name == fmu::identifier_of(name) && !is_one_of(reserved, name) && !hides(name);
}

std::string name_from(const std::string &text)
{
  const std::string name = fmu::identifier_of(text);
  return is_name(name) ? name : name + "_stand";
}

const char *ending_of(const ExportFormat format)
{
  return format == ExportFormat::modelica ? ".mo" : ".m";
}

// Does a text name this case, and not one whose name only begins with the same letters?
bool names_case(const std::string &text, const std::string &case_name)
{
  const std::string words = "case " + case_name;
  for (std::size_t position = text.find(words); position != std::string::npos;
       position             = text.find(words, position + 1)) {
    const std::size_t end = position + words.size();
    if (end == text.size() || std::string(", \n\"").find(text[end]) != std::string::npos)
      return true;
  }
  return false;
}

std::string next_to(const std::string &output, const std::string &name)
{
  return (fs::path(output).parent_path() / name).string();
}
}  // namespace

std::string usual_output(const ExportFormat format, const std::string &case_name)
{
  if (format == ExportFormat::statespace)
    return "out/" + case_name + "-statespace";
  return "out/" + name_from(case_name) + ending_of(format);
}

std::string exchange_name(const ExportFormat format, const std::string &output)
{
  if (format == ExportFormat::statespace)
    return name_from(fs::path(output).filename().string());
  const std::string stem = fs::path(output).stem().string();
  const char *what       = format == ExportFormat::modelica ? "package of Modelica" : "function of MATLAB";
  if (fs::path(output).extension() != ending_of(format))
    throw InputError(fmt::format("-o {}: the name of a {} ends with {}", output, what, ending_of(format)));
  if (hides(stem))
    throw InputError(fmt::format("-o {}: a {} that is called \"{}\" hides what has this name there; take {}{}",
                                 output, what, stem, name_from(stem), ending_of(format)));
  if (!is_name(stem))
    throw InputError(fmt::format("-o {}: a {} has the name of its file, and \"{}\" cannot be a name; take {}{}",
                                 output, what, stem, name_from(stem), ending_of(format)));
  if (fs::is_directory(output))
    throw InputError(fmt::format("-o {} is a folder; name the file, for example {}/{}", output, output,
                                 fs::path(output).filename().string()));
  return stem;
}

std::vector<ExportedFile> exchange_files(const ExportFormat format, const dynamics::ExchangedStand &stand,
                                         const std::string &output)
{
  std::vector<ExportedFile> files;
  if (format == ExportFormat::modelica) {
    const std::string series = stand.name + "_force.txt";
    files.push_back({output, dynamics::modelica_package(stand, series)});
    if (stand.series.time.size() > dynamics::longest_series_in_package)
      files.push_back({next_to(output, series), dynamics::modelica_series(stand.series)});
  } else if (format == ExportFormat::matlab) {
    files.push_back({output, dynamics::matlab_function(stand)});
    files.push_back({next_to(output, stand.name + ".mat"), dynamics::matlab_data(stand)});
  } else
    for (const dynamics::NamedText &file : dynamics::state_space_files(stand))
      files.push_back({output + "/" + file.name, file.text});
  return files;
}

void require_own_companions(const ExportFormat format, const std::vector<ExportedFile> &files)
{
  const std::string mark = format == ExportFormat::matlab ? "MATLAB 5.0 MAT-file, written by millstand"
                                                          : "#1\n# time in s, rolling force in N";
  std::error_code error;
  for (std::size_t i = 1; i < files.size() && format != ExportFormat::statespace; ++i)
    if (fs::exists(files[i].path, error)) {
      const auto text = text_if_readable(files[i].path);
      if (!text || text->rfind(mark, 0) != 0)
        throw InputError("the file " + files[i].path +
                         ", which belongs to it, exists and is not an earlier export; choose another with -o, or "
                         "give --force-overwrite");
    }
}

void require_own(const ExportFormat format, const std::string &output, const std::string &case_name)
{
  std::error_code error;
  if (!fs::exists(output, error))
    return;
  const bool folder = format == ExportFormat::statespace;
  if (folder && fs::is_directory(output, error) && fs::is_empty(output, error))
    return;
  const auto text = text_if_readable(folder ? output + "/about.txt" : output);
  if (!text || !names_case(*text, case_name))
    throw InputError((folder ? "" : "the file ") + output +
                     " exists and is not an earlier export of this case; choose another with -o, or "
                     "give --force-overwrite");
}

namespace {
// What exists only while the files of an export are written.
class Aside {
public:
  ~Aside()
  {
    std::error_code ignored;
    for (const std::string &name : names_)
      fs::remove(name, ignored);
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder)
      fs::remove(*folder, ignored);  // those that are empty
  }
  void make_folder(const fs::path &folder)
  {
    std::error_code error;
    if (folder.empty() || fs::exists(folder, error))
      return;
    make_folder(folder.parent_path());
    if (!fs::create_directory(folder, error) && error)
      refuse_file(error.value(), Place{folder.string()}, "cannot be made: " + error.message());
    made_.push_back(folder);
  }
  void write(const ExportedFile &file)
  {
    const std::string name = name_aside(file.path, ".new");
    try {
      write_atomically(name, file.text);
    } catch (const SystemError &e) {  // with the name that the user knows
      throw SystemError(Place{file.path}, e.problems.at(0).message);
    } catch (const InputError &e) {
      throw InputError(Place{file.path}, e.problems.at(0).message);
    }
    names_.push_back(name);
    targets_.push_back(file.path);
  }
  void rename_all()
  {
    std::error_code error;
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (fs::rename(names_[i], targets_[i], error); error)
        refuse_file(error.value(), Place{targets_[i]}, "cannot be written: " + error.message());
    names_.clear();
    made_.clear();
  }

private:
  std::vector<std::string> names_, targets_;
  std::vector<fs::path> made_;
};
}  // namespace

void write_together(const std::vector<ExportedFile> &files, const std::string &folder)
{
  std::error_code error;
  for (const ExportedFile &file : files)
    if (const auto status = fs::symlink_status(file.path, error); fs::exists(status) && fs::is_other(status))
      throw InputError(Place{file.path}, "cannot be written: it is not a regular file; name another");
  Aside aside;
  aside.make_folder(folder);
  for (const ExportedFile &file : files)
    aside.write(file);
  aside.rename_all();
}
}  // namespace mill
