#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

/// Folder of this process for the inputs of readers that open files; removed when the process ends.
inline const std::string &fuzz_folder()
{
  struct Folder {
    std::string path;
    Folder()
    {
      std::string name = (std::filesystem::temp_directory_path() / "millstand-fuzz-XXXXXX").string();
      path             = ::mkdtemp(name.data()) ? name : std::string();
    }
    ~Folder()
    {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

/// Writes a text as a file of that folder and returns its path.
inline std::string fuzz_file(const std::string &name, const std::string &text)
{
  const std::string path = fuzz_folder() + "/" + name;
  std::ofstream(path, std::ios::binary).write(text.data(), std::streamsize(text.size()));
  return path;
}

inline std::string text_of(const std::uint8_t *data, const std::size_t size)
{
  return {reinterpret_cast<const char *>(data), size};
}

/// Cuts an input that stands for several files: the first part ends at the first line that is "----".
inline std::string next_part(std::string &rest)
{
  const std::string mark = "\n----\n";
  const auto end         = rest.find(mark);
  std::string part       = rest.substr(0, end);
  rest                   = end == std::string::npos ? "" : rest.substr(end + mark.size());
  return part;
}
