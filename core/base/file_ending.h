#pragma once
#include "core/base/choice.h"
#include <filesystem>

namespace mill {
/// Ends of names of files that decide what is done with a file.
enum class FileEnding { csv, json, toml, html, npy, dat, fmu, cache_entry };
constexpr auto words_of(FileEnding)
{
  return choice_words<FileEnding>(".csv", ".json", ".toml", ".html", ".npy", ".dat", ".fmu", ".bin");
}

inline bool has_ending(const std::filesystem::path &file, const FileEnding ending)
{
  return file.extension() == word_of(ending);
}
}  // namespace mill
