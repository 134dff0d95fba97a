#pragma once
#include <string>
#include <vector>

// Pages of docs/ that are part of the program (cmake/embed_files.cmake), so that help needs no folder of data.
namespace mill::help {
struct EmbeddedFile {
  const char *name;
  const char *begin, *end;
  std::string text() const
  {
    return std::string(begin, end);
  }
};
/// "tutorial", "glossary", "output", "input" and the pages of docs/howto, "crown-study".
const std::vector<EmbeddedFile> &named_files();
/// Empty; of the pattern of cmake/embed_files.cmake.
const std::vector<EmbeddedFile> &source_files();
}  // namespace mill::help
