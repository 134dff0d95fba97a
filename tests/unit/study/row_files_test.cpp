#include "app/study/earlier_ends.h"
#include "app/study/store/row_files.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <map>

namespace {
using namespace mill;
namespace fs = std::filesystem;

std::map<std::int64_t, FinishedRow> rows_in(const std::string &path)
{
  std::map<std::int64_t, FinishedRow> rows;
  read_rows(path, 0, [&](FinishedRow &&row) { rows[row.key] = std::move(row); });
  return rows;
}

TEST(RowFiles, GiveBackEveryBit)
{
  const std::string folder = scratch("row-files");
  const std::string path   = new_row_file(folder, "1-of-1");
  const double odd         = 0.1 + 0.2;
  {
    RowFile file(path);
    file.commit({}, {{-5, 1}, {7, 1}});
    file.commit({{-5, {odd, 1e308}, ""}, {9, {}, "no convergence, \"quoted\""}}, {});
  }
  const auto rows = rows_in(path);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows.at(-5).results, (std::vector<double>{odd, 1e308}));
  EXPECT_EQ(rows.at(9).failure, "no convergence, \"quoted\"");
  EXPECT_EQ(begun_rows(path), std::vector<std::int64_t>{7}) << "begun and not finished";
  EXPECT_EQ(row_files(folder, "1-of-1"), std::vector<std::string>{path});
  EXPECT_TRUE(row_files(folder, "1-of-11").empty());
}

TEST(RowFiles, MergingTakesEachKeyOnceAndMayBeRepeated)
{
  const std::string folder = scratch("merged-rows");
  {
    RowFile first(new_row_file(folder, "1-of-2")), second(new_row_file(folder, "2-of-2"));
    first.commit({{1, {1.5}, ""}, {2, {2.5}, ""}}, {});
    second.commit({{2, {2.5}, ""}, {3, {3.5}, ""}}, {});
  }
  EXPECT_TRUE(merge_rows(folder).empty());
  EXPECT_EQ(rows_in(merged_file(folder)).size(), 3u);
  {
    RowFile third(new_row_file(folder, "1-of-2"));
    third.commit({{4, {4.5}, ""}}, {});
  }
  EXPECT_TRUE(merge_rows(folder).empty());
  const auto rows = rows_in(merged_file(folder));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows.at(3).results, std::vector<double>{3.5});
  EXPECT_TRUE(merge_rows(folder).empty());
}

TEST(RowFiles, ARowWithAWrongChecksumIsLeftOutAndNamed)
{
  const std::string folder = scratch("wrong-checksum");
  const std::string path   = new_row_file(folder, "1-of-1");
  {
    RowFile file(path);
    file.commit({{1, {1.5}, ""}, {2, {123.456}, ""}}, {});
  }
  std::string bytes    = read_text(path);
  const double damaged = 123.456;
  const auto place     = bytes.find(std::string(reinterpret_cast<const char *>(&damaged), sizeof damaged));
  ASSERT_NE(place, std::string::npos);
  bytes[place] ^= 1;
  write_atomically(path, bytes);
  const auto notes = merge_rows(folder);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("1 row with a wrong checksum, computed again"), std::string::npos) << notes[0];
  EXPECT_EQ(rows_in(merged_file(folder)).size(), 1u);
}

// A full disk of whoever takes the row is not a fault of the file: a merge that went on would pass the row over.
TEST(RowFiles, WhatTheTakerThrowsIsNotAFaultOfTheFile)
{
  const std::string path = new_row_file(scratch("thrown-by-the-taker"), "1-of-1");
  RowFile file(path);
  file.commit({{1, {1.5}, ""}, {2, {2.5}, ""}}, {});
  const auto take = [](FinishedRow &&row) {
    if (row.key == 2)
      throw SystemError("database or disk is full");
  };
  EXPECT_THROW(read_rows(path, 0, take), SystemError);
}

TEST(RowFiles, ADamagedMergedRowIsReplacedByThatOfItsFile)
{
  const std::string folder = scratch("damaged-merged-row");
  {
    RowFile file(new_row_file(folder, "1-of-1"));
    file.commit({{1, {1.5}, ""}, {2, {123.456}, ""}}, {});
  }
  merge_rows(folder);
  std::string bytes    = read_text(merged_file(folder));
  const double damaged = 123.456;
  const auto place     = bytes.find(std::string(reinterpret_cast<const char *>(&damaged), sizeof damaged));
  ASSERT_NE(place, std::string::npos);
  bytes[place] ^= 1;
  write_atomically(merged_file(folder), bytes);
  const auto notes = merge_rows(folder);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("finished.db"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("1 row with a wrong checksum removed"), std::string::npos) << notes[0];
  EXPECT_EQ(rows_in(merged_file(folder)).at(2).results, std::vector<double>{123.456});
  EXPECT_TRUE(merge_rows(folder).empty());
}

TEST(RowFiles, AMergedFileThatIsNoDatabaseIsMadeAgain)
{
  const std::string folder = scratch("damaged-merged-file");
  {
    RowFile file(new_row_file(folder, "1-of-1"));
    file.commit({{1, {1.5}, ""}}, {});
  }
  write_atomically(merged_file(folder), std::string(5000, 'x'));
  EXPECT_EQ(merge_rows(folder).size(), 1u);
  EXPECT_EQ(rows_in(merged_file(folder)).at(1).results, std::vector<double>{1.5});
}

TEST(EarlierEnds, SixKillsGiveARowUpUntilTheFilesOfRowsAreRemoved)
{
  const std::string folder = scratch("six-kills");
  const auto kill_in_row   = [&] { RowFile(new_row_file(folder, "1-of-1")).commit({}, {{7, 1}}); };
  for (int i = 0; i < 5; ++i)
    kill_in_row();
  EXPECT_FALSE(gives_up(earlier_ends(folder, "1-of-1").at(7)));
  kill_in_row();
  EXPECT_TRUE(gives_up(earlier_ends(folder, "1-of-1").at(7)));
  fs::remove_all(folder + "/rows");  // as the how-to of studies says
  EXPECT_TRUE(earlier_ends(folder, "1-of-1").empty());
}

// A copy of file and journal in the middle of a transaction is what a kill leaves.
TEST(RowFiles, ACutTransactionIsUndoneWithoutWritingIntoTheFile)
{
  const std::string folder = scratch("cut-transaction");
  const std::string path = new_row_file(folder, "1-of-1"), cut = folder + "/rows/1-of-1-cut.db";
  {
    RowFile file(path);
    file.commit({{1, {1.5}, ""}}, {});
  }
  Database writer(path, Database::Open::write);
  writer.execute("PRAGMA cache_size=1; PRAGMA cache_spill=1; BEGIN");
  for (int i = 0; i < 2000; ++i)  // more than the cache holds, so that pages are written before the commit
    writer.execute("INSERT INTO attempt VALUES(" + std::to_string(1000 + i) + ", 1)");
  ASSERT_TRUE(fs::exists(path + "-journal")) << "the transaction is open";
  fs::copy_file(path, cut);
  fs::copy_file(path + "-journal", cut + "-journal");
  writer.execute("ROLLBACK");
  const std::string before = read_text(cut);
  EXPECT_EQ(rows_in(cut).size(), 1u);
  EXPECT_TRUE(begun_rows(cut).empty()) << "what was not committed did not happen";
  EXPECT_EQ(read_text(cut), before);
  EXPECT_TRUE(fs::exists(cut + "-journal"));
}
}  // namespace
