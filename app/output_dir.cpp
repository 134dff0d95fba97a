#include "app/output_dir.h"
#include "core/errors.h"
#include "core/files.h"
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace mill {
namespace {
// Name of the case a folder belongs to; empty when it is no folder of a run.
std::string owner_of(const std::string &directory)
{
  const std::string manifest = directory + "/run.json";
  if (!fs::exists(manifest))
    return "";
  const auto json = nlohmann::json::parse(read_text(manifest), nullptr, false);
  return json.is_object() ? json.value("case", "") : "";
}
}  // namespace

OutputDir::OutputDir(std::string path, const Case &of, const bool overwrite) : directory(std::move(path))
{
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    throw InputError(directory + " is a file, not a folder; choose another with -o");
  if (fs::exists(directory, error) && !fs::is_empty(directory, error) && !overwrite) {
    const std::string owner = owner_of(directory);
    if (owner.empty())
      throw InputError("the folder " + directory +
                       " holds files that no run wrote; choose another with -o, or give --force-overwrite");
    if (owner != of.name)
      throw InputError("the folder " + directory + " holds the results of the case '" + owner +
                       "'; choose another with -o, or give --force-overwrite");
  }
  for (const char *part : {"", "/curves", "/response", "/fields"}) {
    fs::create_directories(directory + part, error);
    if (error)
      throw InputError("the folder " + directory + part + " cannot be made: " + error.message() +
                       "; choose another with -o");
  }
}

const std::string &OutputDir::path() const
{
  return directory;
}

std::string OutputDir::file(const std::string &name) const
{
  return directory + "/" + name;
}

void OutputDir::write(const std::string &name, const std::string &text) const
{
  write_atomically(file(name), text);
}

std::string slug(const std::string &name)
{
  std::string out;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += char(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  while (!out.empty() && out.back() == '-')
    out.pop_back();
  return out.empty() ? "pass" : out;
}
}  // namespace mill
