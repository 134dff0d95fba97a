#pragma once
#include "twin/records/raw_record.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace mill {
/// A folder of its own for the files of a test.
class RecordTest : public testing::Test {
protected:
  std::string folder =
      testing::TempDir() + "millstand_" + testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override
  {
    std::filesystem::create_directories(folder);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }
  std::string file(const std::string &name, const std::string &bytes)
  {
    std::ofstream(folder + "/" + name, std::ios::binary) << bytes;
    return folder + "/" + name;
  }
  twin::RawRecord read(const std::string &name, const std::string &bytes, const twin::ReadOptions &options = {})
  {
    return twin::read_record(file(name, bytes), options);
  }
  /// The message of the refusal, the folder left out; "accepted" where there is none.
  std::string refusal(const std::string &name, const std::string &bytes, const twin::ReadOptions &options = {})
  {
    try {
      read(name, bytes, options);
    } catch (const InputError &error) {
      std::string message = error.problems.at(0).message;
      for (auto position = message.find(folder + "/"); position != std::string::npos;
           position      = message.find(folder + "/"))
        message.erase(position, folder.size() + 1);
      return message;
    }
    return "accepted";
  }
  static bool has_note(const twin::RawRecord &record, const std::string &words)
  {
    for (const std::string &note : record.notes)
      if (note.find(words) != std::string::npos)
        return true;
    return false;
  }
};
}  // namespace mill
