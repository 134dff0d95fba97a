#pragma once
#include <string>
#include <vector>

// Files that are part of the program (cmake/embed_files.cmake): the runtime for each platform that it was built
// for, and its sources.
namespace mill::fmu {
struct EmbeddedFile {
  const char *name;
  const char *begin, *end;
  std::string bytes() const
  {
    return std::string(begin, end);
  }
};
/// "linux64", "win64": libraries, empty where none was built; "glibc": the version the first one asks for;
/// "licence": of the runtime, which links no library under the GPL, since users give units to others.
const std::vector<EmbeddedFile> &named_files();
/// Sources and headers of dynamics/fmu/runtime.
const std::vector<EmbeddedFile> &source_files();
/// One of the first list.
std::string named_file(const std::string &name);
}  // namespace mill::fmu
