#include "app/command/verify_options.h"
#include "app/process/hand_over.h"
#include <string>
#include <vector>

// The verification manual is a separate program in the same folder (tests/manual/CMakeLists.txt), which takes over
// here.
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
  auto words = words_of(options);
  std::vector<char *> arguments;
  for (std::string &word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  hand_over("millstand-verify", arguments.data(), "the verification manual");
}
}  // namespace mill
