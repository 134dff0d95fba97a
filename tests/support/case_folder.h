#pragma once
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

/// A folder for the case files of one test, gone with it.
class CaseFolder : public testing::Test {
protected:
  std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("millstand_cases-" + std::to_string(getpid()));
  void SetUp() override
  {
    std::filesystem::create_directories(folder);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }
  /// Path of a new file with this text.
  std::string file(const std::string &name, const std::string &text) const
  {
    const std::string path = (folder / name).string();
    std::filesystem::remove(path);  // a new file needs no wait for the disk
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
};
