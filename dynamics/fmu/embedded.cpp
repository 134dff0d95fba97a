#include "dynamics/fmu/embedded.h"
#include "core/base/require.h"

namespace mill::fmu {
std::string named_file(const std::string &name)
{
  for (const EmbeddedFile &file : named_files())
    if (name == file.name)
      return file.bytes();
  require(false, "a file that is part of the program is missing");
  return "";
}
}  // namespace mill::fmu
