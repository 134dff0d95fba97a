#pragma once
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <vector>

/// What may stand where a file is expected: names, and a function that puts it there.
inline const std::vector<std::string> obstacles{"nothing in it", "a folder",        "a pipe",
                                                "a device",      "a loop of links", "a file that gives EIO"};

/// Puts one of them at the path, in the place of what is there.
inline void put_obstacle(const std::string &path, const std::string &which)
{
  namespace fs = std::filesystem;
  fs::remove_all(path);
  if (which == "a folder")
    fs::create_directories(path + "/inside");
  else if (which == "a pipe")
    ::mkfifo(path.c_str(), 0600);
  else if (which == "a device")
    fs::create_symlink("/dev/zero", path);
  else if (which == "a loop of links")
    fs::create_symlink(path, path);
  else if (which == "a file that gives EIO")
    fs::create_symlink("/proc/self/mem", path);  // a regular file by its kind; its first page is never mapped
  else if (FILE *file = std::fopen(path.c_str(), "w"))
    std::fclose(file);
}
