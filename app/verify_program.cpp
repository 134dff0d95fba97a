#include "app/verify_command.h"
#include "core/case/errors.h"
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

// The verification manual is a program of its own beside this one (verify/CMakeLists.txt), which takes over here.
namespace mill {
namespace {
std::vector<std::string> words_of(const VerifyOptions &options)
{
  std::vector<std::string> words{"millstand-verify", "verify"};
  if (options.list)
    words.push_back("--list");
  if (options.quiet)
    words.push_back("--quiet");
  if (!options.markdown.empty())
    words.insert(words.end(), {"--markdown", options.markdown});
  if (options.threads > 0)
    words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  words.push_back("--");  // no name is taken for a flag
  words.insert(words.end(), options.names.begin(), options.names.end());
  return words;
}
}  // namespace

int verify_command(const VerifyOptions &options)
{
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "millstand-verify";
  auto words         = words_of(options);
  std::vector<char *> arguments;
  for (std::string &word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());  // returns only when it fails
  throw InputError("the verification manual is a program of its own, '" + program.string() +
                   "', which cannot be started; build it with: cmake --build --preset release --target "
                   "millstand-verify");
}
}  // namespace mill
