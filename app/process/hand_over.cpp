#include "app/process/hand_over.h"
#include "core/base/errors.h"
#include <filesystem>
#include <unistd.h>

namespace mill {
void hand_over(const std::string &program, char **arguments, const std::string &what)
{
  const auto file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
  execv(file.c_str(), arguments);  // returns only when it fails
  throw InputError(what + " is carried out by a separate program, '" + file.string() +
                   "', which cannot be started; build it with: cmake --build --preset release --target " +
                   program);
}
}  // namespace mill
