#pragma once
#include "core/base/files.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

// A case of the tree beside the first rows of its force records: what is read and driven anew for every key of a
// case takes most of its time for ten seconds of force, and says nothing more about keys.
class ShortRecords {
public:
  /// @param name  "four-high-1400"
  explicit ShortRecords(const std::string &name)
      : folder_(testing::TempDir() + "short-records-" + std::to_string(::getpid()) + "-" + name),
        file(folder_ + "/" + name + ".toml")
  {
    constexpr int rows = 2001;  // 0.2 s
    std::filesystem::create_directories(folder_ + "/data");
    mill::write_atomically(file, mill::read_text("cases/" + name + ".toml"));
    for (const char *record : {"/data/pass-1.csv", "/data/pass-2.csv"}) {
      const std::string text = mill::read_text(std::string("cases") + record);
      std::size_t end        = 0;
      for (int row = 0; row < rows; ++row)
        end = text.find('\n', end) + 1;
      mill::write_atomically(folder_ + record, text.substr(0, end));
    }
  }
  ~ShortRecords()
  {
    std::filesystem::remove_all(folder_);
  }
  ShortRecords(const ShortRecords &) = delete;

private:
  std::string folder_;

public:
  const std::string file;
};
