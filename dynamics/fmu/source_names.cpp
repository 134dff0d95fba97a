#include "dynamics/fmu/source_names.h"
#include "core/base/text.h"
#include "dynamics/fmu/embedded.h"
#include <cctype>
#include <fmt/format.h>
#include <set>

namespace mill::fmu {
namespace {
// Names that follow the mark of an exported function in the headers of the interfaces.
std::set<std::string> exported_names(const std::string &version)
{
  const std::string mark = "MILL_FMU_EXPORT", begin = "fmi" + version;
  std::set<std::string> names;
  for (const EmbeddedFile &file : source_files()) {
    if (std::string(file.name) != begin + "_interface.h")
      continue;
    const std::string text = file.bytes();
    for (std::size_t position = text.find(mark); position != std::string::npos;
         position             = text.find(mark, position + 1)) {
      const std::size_t bracket = text.find('(', position);
      std::size_t first         = bracket;
      while (first > position &&
             (std::isalnum(static_cast<unsigned char>(text[first - 1])) || text[first - 1] == '_'))
        --first;
      names.insert(text.substr(first, bracket - first));
    }
  }
  return names;
}
}  // namespace

std::string source_names(const std::string &identifier)
{
  std::string text =
      fmt::format("// Names of the unit {0}, so that several units can be linked into one program.\n"
                  "#define mill {0}_mill\n",
                  identifier);
  for (const char *version : {"2", "3"}) {
    text += fmt::format("#ifndef FMI{}_OVERRIDE_FUNCTION_PREFIX  // define it for a shared library\n", version);
    for (const std::string &name : exported_names(version))
      text += fmt::format("#define {1} {0}_{1}\n", identifier, name);
    text += "#endif\n";
  }
  return text;
}

bool is_compiled(const std::string &file)
{
  return text_ends_with(file, ".cpp");
}

std::string travelling_source(const std::string &name, const std::string &text)
{
  return is_compiled(name) ? fmt::format("#include \"{}\"\n{}", names_header, text) : text;
}
}  // namespace mill::fmu
