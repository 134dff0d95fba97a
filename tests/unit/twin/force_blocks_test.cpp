// A record read in blocks is the record read whole.
#include "core/base/errors.h"
#include "twin/records/force_blocks.h"
#include <fstream>
#include <gtest/gtest.h>

using namespace mill;
using twin::ForceBlocks;
using twin::read_force;

namespace {
std::string record_file(const std::string &text)
{
  const std::string path = testing::TempDir() + "force-blocks.csv";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

ForceRecord in_blocks(const std::string &path, const std::size_t bytes)
{
  ForceBlocks blocks(path, bytes);
  ForceRecord all, block;
  while (blocks.next(block)) {
    EXPECT_GT(block.time.size(), 0);
    const auto n = all.time.size();
    all.time.conservativeResize(n + block.time.size());
    all.force.conservativeResize(n + block.time.size());
    all.time.tail(block.time.size())  = block.time;
    all.force.tail(block.time.size()) = block.force;
  }
  EXPECT_EQ(blocks.fraction(), 1);
  EXPECT_EQ(blocks.n_samples(), all.time.size());
  return all;
}

std::string refusal_of(const std::string &text, const std::size_t bytes)
{
  try {
    in_blocks(record_file(text), bytes);
  } catch (const InputError &e) {
    const Problem &p = e.problems.front();
    return std::to_string(p.place.line) + ":" + std::to_string(p.place.column) + ": " + p.message;
  }
  return "read";
}
}  // namespace

TEST(ForceBlocks, BlocksOfAnySizeGiveTheSameRecord)
{
  std::string comma = "# a comment\n\ntime [s],force [kN]\n", semicolon = "\xEF\xBB\xBFtime [ms];force [MN]\r\n";
  for (int i = 0; i < 500; ++i) {
    comma +=
        std::to_string(0.001 * i) + "," + std::to_string(976 + 0.37 * (i % 17)) + (i % 50 ? "\n" : "\n\n# so\n");
    semicolon += std::to_string(i) + "," + std::to_string(i % 10) + ";0,97" + std::to_string(i % 7) + "\r\n";
  }
  for (const std::string &text : {comma, semicolon, comma.substr(0, comma.size() - 1)}) {
    const std::string path  = record_file(text);
    const ForceRecord whole = read_force(path);
    for (const std::size_t bytes : {7u, 40u, 1000u, 5000u, 1u << 20}) {
      const ForceRecord blocks = in_blocks(path, bytes);
      EXPECT_EQ(blocks.time, whole.time) << bytes;
      EXPECT_EQ(blocks.force, whole.force) << bytes;
    }
  }
}

TEST(ForceBlocks, ErrorsNameTheirLine)
{
  std::string text = "time [s],force [kN]\n";
  for (int i = 0; i < 100; ++i)
    text += std::to_string(i) + ",976\n";
  const auto with = [&](const std::string &from, const std::string &to) {
    std::string broken = text;
    broken.replace(broken.find(from), from.size(), to);
    return broken;
  };
  for (const std::size_t bytes : {30u, 1u << 16}) {  // samples of a block
    EXPECT_EQ(refusal_of(with("\n77,976", "\n77,abc"), bytes), refusal_of(with("\n77,976", "\n77,abc"), 1 << 20));
    EXPECT_EQ(refusal_of(with("\n77,976", "\n77,abc"), bytes).find("79:4: "), 0u)
        << refusal_of(with("\n77,976", "\n77,abc"), bytes);
    EXPECT_EQ(
        refusal_of(with("\n77,976", "\n75,976"), bytes),
        "79:1: the time goes backwards here, by 1 s; sort the lines by time, or split the file where the recorder "
        "started again");
    EXPECT_EQ(refusal_of(with("\n77,976", "\n77"), bytes).find("79:"), 0u);
    EXPECT_EQ(refusal_of("time [s],force [kN]\n1,2\n", bytes),
              "1:1: only one sample in this record; at least two are needed");
  }
  EXPECT_THROW(ForceBlocks("/nowhere/force.csv"), InputError);
  EXPECT_THROW(ForceBlocks("/tmp"), InputError);
}

// What the first rows show of a column is not what it is: both readers look at all rows then.
TEST(ForceBlocks, MisleadingFirstRowsAreReadAgain)
{
  std::string text = "time [s];force [kN]\n";
  for (int i = 0; i < 100; ++i)
    text += std::to_string(i) + (i < 80 ? ",5;1,250\n" : ",5;1.250,5\n");
  const std::string path = record_file(text);
  ForceBlocks blocks(path);
  ForceRecord block;
  EXPECT_THROW(blocks.next(block), InputError);
  ASSERT_TRUE(blocks.look_at_all_rows());
  const ForceRecord whole = read_force(path);
  for (int pass = 0; pass < 2; ++pass, blocks.rewind()) {
    ASSERT_TRUE(blocks.next(block));
    EXPECT_EQ(block.force, whole.force);
    EXPECT_EQ(block.time, whole.time);
  }
  EXPECT_EQ(whole.force[0], 1250);
  EXPECT_EQ(whole.force[99], 1250500);
  EXPECT_FALSE(blocks.look_at_all_rows()) << "once is enough";
}
