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
// Words that neither language takes as a name.
constexpr std::array reserved{
    "algorithm", "and",       "annotation", "block",   "break",     "case",    "catch",       "class",  "connect",
    "der",       "else",      "elseif",     "end",     "equation",  "each",    "enumeration", "for",    "function",
    "global",    "if",        "import",     "in",      "initial",   "loop",    "model",       "not",    "operator",
    "or",        "otherwise", "output",     "package", "parameter", "partial", "record",      "return", "switch",
    "then",      "time",      "true",       "type",    "false",     "when",    "while",       "within"};

bool is_name(const std::string &name)
{
  return name == fmu::identifier_of(name) && std::find(reserved.begin(), reserved.end(), name) == reserved.end();
}

std::string name_from(const std::string &text)
{
  const std::string name = fmu::identifier_of(text);
  return is_name(name) ? name : name + "_stand";
}

const char *ending_of(const std::string &format)
{
  return format == "modelica" ? ".mo" : ".m";
}

// Does a text name this case, and not only one whose name begins alike?
bool names_case(const std::string &text, const std::string &case_name)
{
  const std::string words = "case " + case_name;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    const std::size_t end = at + words.size();
    if (end == text.size() || std::string(", \n\"").find(text[end]) != std::string::npos)
      return true;
  }
  return false;
}

std::string beside(const std::string &output, const std::string &name)
{
  return (fs::path(output).parent_path() / name).string();
}
}  // namespace

bool is_exchange_format(const std::string &format)
{
  return format != "fmu";
}

std::string usual_output(const std::string &format, const std::string &case_name)
{
  if (format == "statespace")
    return "out/" + case_name + "-statespace";
  return "out/" + name_from(case_name) + ending_of(format);
}

std::string exchange_name(const std::string &format, const std::string &output)
{
  if (format == "statespace")
    return name_from(fs::path(output).filename().string());
  const std::string stem = fs::path(output).stem().string();
  const char *what       = format == "modelica" ? "package of Modelica" : "function of MATLAB";
  if (fs::path(output).extension() != ending_of(format))
    throw InputError(fmt::format("-o {}: the name of a {} ends with {}", output, what, ending_of(format)));
  if (!is_name(stem))
    throw InputError(fmt::format("-o {}: a {} is called as its file, and \"{}\" is no name there; take {}{}",
                                 output, what, stem, name_from(stem), ending_of(format)));
  if (fs::is_directory(output))
    throw InputError(fmt::format("-o {} is a folder; name the file, for example {}/{}", output, output,
                                 fs::path(output).filename().string()));
  return stem;
}

std::vector<ExportedFile> exchange_files(const std::string &format, const dynamics::ExchangedStand &stand,
                                         const std::string &output)
{
  std::vector<ExportedFile> files;
  if (format == "modelica") {
    const std::string series = stand.name + "_force.txt";
    files.push_back({output, dynamics::modelica_package(stand, series)});
    if (stand.series.time.size() > dynamics::longest_series_in_package)
      files.push_back({beside(output, series), dynamics::modelica_series(stand.series)});
  } else if (format == "matlab") {
    files.push_back({output, dynamics::matlab_function(stand)});
    files.push_back({beside(output, stand.name + ".mat"), dynamics::matlab_data(stand)});
  } else
    for (const dynamics::NamedText &file : dynamics::state_space_files(stand))
      files.push_back({output + "/" + file.name, file.text});
  return files;
}

void require_own_companions(const std::string &format, const std::vector<ExportedFile> &files)
{
  const std::string mark =
      format == "matlab" ? "MATLAB 5.0 MAT-file, written by millstand" : "#1\n# time in s, rolling force in N";
  std::error_code error;
  for (std::size_t i = 1; i < files.size() && format != "statespace"; ++i)
    if (fs::exists(files[i].path, error)) {
      const auto text = text_if_readable(files[i].path);
      if (!text || text->rfind(mark, 0) != 0)
        throw InputError("the file " + files[i].path +
                         ", which belongs beside it, exists and is no earlier export; choose another with -o, or "
                         "give --force-overwrite");
    }
}

void require_own(const std::string &format, const std::string &output, const std::string &case_name)
{
  std::error_code error;
  if (!fs::exists(output, error))
    return;
  const bool folder = format == "statespace";
  if (folder && fs::is_directory(output, error) && fs::is_empty(output, error))
    return;
  const auto text = text_if_readable(folder ? output + "/about.txt" : output);
  if (!text || !names_case(*text, case_name))
    throw InputError((folder ? "" : "the file ") + output +
                     " exists and is no earlier export of this case; choose another with -o, or "
                     "give --force-overwrite");
}
}  // namespace mill
