#include "app/study/started_program.h"
#include "core/base/errors.h"
#include "core/process/own_library.h"
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mill {
std::string program_path(const std::string &name)
{
  return own_folder() + "/" + name;
}

pid_t start_program(const std::string &file, const std::vector<std::string> &arguments, const std::string &what)
{
  std::vector<std::string> words{file};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char *> pointers;
  for (std::string &word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t process   = 0;
  const int error = posix_spawnp(&process, file.c_str(), nullptr, nullptr, pointers.data(), environ);
  if (error != 0) {
    const std::string name = std::filesystem::path(file).filename().string();
    throw InputError(
        what + " need the program '" + file + "', which cannot be started (" + std::strerror(error) + "); " +
        (name.rfind("millstand", 0) == 0 ? "build it with: cmake --build --preset release --target " + name
                                         : "install it, or use --engine here"));
  }
  return process;
}

int wait_for(const pid_t process)
{
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR)
      return 1;
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

int run_program(const std::string &file, const std::vector<std::string> &arguments, const std::string &what)
{
  return wait_for(start_program(file, arguments, what));
}
}  // namespace mill
