#include "app/run/scratch_folder.h"
#include "core/base/files.h"
#include <cstdlib>
#include <filesystem>
#include <unistd.h>

namespace mill {
namespace {
// Of Linux: files in memory.  TMPDIR names another place.
std::filesystem::path memory_folder()
{
  const char *const folder = "/dev/shm";
  return ::access(folder, W_OK) == 0 && !std::getenv("TMPDIR") ? std::filesystem::path(folder)
                                                               : std::filesystem::temp_directory_path();
}
}  // namespace

ScratchFolder::ScratchFolder(const std::string &prefix, const bool in_memory)
    : path_(
          ((in_memory ? memory_folder() : std::filesystem::temp_directory_path()) / (prefix + "-" + random_name()))
              .string())
{
}

ScratchFolder::~ScratchFolder()
{
  remove_folder(path_);
}

const std::string &ScratchFolder::path() const
{
  return path_;
}
}  // namespace mill
