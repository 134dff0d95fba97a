#include "meshes/common/write_mesh.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/process/parallel.h"
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <mutex>

namespace mill::meshes {
namespace {
// Lines between "$name" and "$Endname", or less than zero where the section is not there or not closed.
long lines_of(const std::string &text, const std::string &name, std::size_t &begin)
{
  begin          = text.find("$" + name + "\n");
  const auto end = begin == std::string::npos ? begin : text.find("\n$End" + name + "\n", begin);
  if (end == std::string::npos)
    return -1;
  begin += name.size() + 2;
  return 1 + std::count(text.begin() + std::ptrdiff_t(begin), text.begin() + std::ptrdiff_t(end), '\n');
}

// A section opens with the number of its blocks and of its members; a block has one line of its own, and a member
// one line (elements) or two (nodes: tag, coordinates).
std::string missing_of(const std::string &text, const std::string &name, const int lines_each)
{
  std::size_t begin = 0;
  const long lines  = lines_of(text, name, begin);
  long blocks = 0, members = 0;
  if (lines < 1 || std::sscanf(text.c_str() + begin, "%ld %ld", &blocks, &members) != 2)
    return "its " + name + " are not all there";
  const long wanted = 1 + blocks + lines_each * members;
  return lines == wanted
             ? ""
             : "its " + name + " take " + std::to_string(lines) + " lines instead of " + std::to_string(wanted);
}
}  // namespace

std::string missing_of_mesh(const std::string &text)
{
  const std::string nodes = missing_of(text, "Nodes", 2);
  return nodes.empty() ? missing_of(text, "Elements", 1) : nodes;
}

void write_mesh(const std::string &path, const std::function<std::string(const std::string &aside)> &write)
{
  const std::string aside = name_aside(path, ".msh");  // Gmsh goes by the ending
  std::string missing;
  {
    const std::lock_guard alone(rand_access());
    missing = write(aside);
  }
  try {
    if (missing.empty())
      missing = missing_of_mesh(read_text(aside));
  } catch (const std::exception &e) {
    missing = e.what();
  }
  std::error_code error;
  if (missing.empty())
    std::filesystem::rename(aside, path, error);
  if (missing.empty() && !error)
    return;
  std::filesystem::remove(aside, error);
  throw SystemError(Place{path}, "the mesh cannot be written" +
                                     (missing.empty() ? std::string() : ": " + missing) +
                                     "; is the disk full, or the folder not writable?");
}
}  // namespace mill::meshes
