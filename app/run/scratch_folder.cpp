#include "app/run/scratch_folder.h"
#include "core/base/files.h"
#include <filesystem>

namespace mill {
ScratchFolder::ScratchFolder(const std::string &prefix)
    : path_((std::filesystem::temp_directory_path() / (prefix + "-" + random_name())).string())
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
