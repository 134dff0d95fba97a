#include "tests/support/program.h"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {
struct Scratch {
  fs::path path = fs::temp_directory_path() / ("millstand-test-" + std::to_string(getpid()));
  Scratch()
  {
    fs::create_directories(path);
  }
  ~Scratch()
  {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

const fs::path &base()
{
  static const Scratch made;
  return made.path;
}

std::string text_of(const fs::path &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}
}  // namespace

std::string scratch(const std::string &name)
{
  fs::create_directories(base() / name);
  return (base() / name).string();
}

std::string shared_cache()
{
  const char *given = std::getenv("MILLSTAND_TEST_CACHE");
  return given ? given : scratch("cache");
}

Outcome shell(const std::string &command, const std::string &folder)
{
  const fs::path out = base() / "stdout", err = base() / "stderr";
  const std::string whole =
      "cd '" + folder + "' && " + command + " >'" + out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int status = std::system(whole.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(out), text_of(err)};
}

Outcome millstand(const std::string &arguments, const std::string &folder, const std::string &before)
{
  return shell(before + " && '" MILLSTAND_PROGRAM "' " + arguments, folder);
}
