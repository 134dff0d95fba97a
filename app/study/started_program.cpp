#include "app/study/started_program.h"
#include "core/base/errors.h"
#include "core/process/own_library.h"
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mill {
std::string program_path(const std::string &name)
{
  return own_folder() + "/" + name;
}

namespace {
// In the child: nothing but calls that are safe after fork().
[[noreturn]] void become(const char *file, char *const *words, const pid_t parent, const int pipe)
{
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent)  // which ended before this line
    ::_exit(1);
  ::execvp(file, words);
  const int error = errno;
  if (::write(pipe, &error, sizeof error) < 0)
    ::_exit(126);
  ::_exit(127);
}
}  // namespace

pid_t start_program(const std::string &file, const std::vector<std::string> &arguments, const std::string &what)
{
  std::vector<std::string> words{file};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char *> pointers;
  for (std::string &word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int ends[2] = {-1, -1}, error = 0;
  const pid_t parent = ::getpid(), process = ::pipe2(ends, O_CLOEXEC) == 0 ? ::fork() : -1;
  if (process == 0)
    become(file.c_str(), pointers.data(), parent, ends[1]);
  if (process < 0)
    error = errno;
  ::close(ends[1]);
  if (process > 0 && ::read(ends[0], &error, sizeof error) > 0)
    wait_for(process);
  ::close(ends[0]);
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
