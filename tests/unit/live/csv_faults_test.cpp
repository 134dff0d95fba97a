#include "tests/support/came_messages.h"
#include "tests/support/published_stand.h"
#include "twin/live/engine/engine.h"
#include "twin/live/source/csv_feed.h"
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

using namespace mill;

// What a recorder does wrong in the middle of a file: said in a sentence, counted, and the twin goes on with what
// is sound.
namespace {
const std::string two_columns = "time [s],force [kN]";

// Lines of a file, one after the other, and what a feed makes of them.
class Lines {
public:
  explicit Lines(const std::string &head, live::SourceRules rules = {}) : feed("mill.csv", std::move(rules))
  {
    line(head);
  }
  void line(const std::string &text)
  {
    feed.line(text, ++number);
  }
  // Rows of time and force (its number), `step` s apart.
  void rows(const int n, const double from, const double step)
  {
    for (int k = 0; k < n; ++k)
      line(fmt::format("{:.4f},{}", from + k * step, 900 + count++));
  }
  CameMessages end()
  {
    feed.finish();
    CameMessages came;
    for (const live::Message &message : feed.take()) {
      came.add(message);
      messages.push_back(message);
    }
    return came;
  }
  live::CsvFeed feed;
  std::vector<live::Message> messages;
  int number = 0, count = 0;
};

// The account that the engine keeps of these messages.
live::ChannelAccount account_of(const std::vector<live::Message> &messages)
{
  const ParameterSet set = parameter_set("R3");
  live::Engine engine({"test", "as published", set.stand, set.dynamics, "hash"}, {});
  for (const live::Message &message : messages) {
    engine.take(message);
    EXPECT_TRUE(!engine.book() || engine.book()->balanced());
  }
  engine.flush();
  return engine.book()->channels().front();
}

bool in_a_row(const std::vector<std::int64_t> &numbers)
{
  for (std::size_t k = 1; k < numbers.size(); ++k)
    if (numbers[k] != numbers[k - 1] + 1)
      return false;
  return true;
}
}  // namespace

TEST(CsvFaults, LettersInANumberCostOneSample)
{
  Lines lines(two_columns);
  lines.rows(500, 0, 1e-3);
  lines.line("0.5000,9O1");
  lines.rows(500, 0.501, 1e-3);
  const CameMessages came = lines.end();
  EXPECT_EQ(came.refused, std::vector<std::string>{
                              "mill.csv:502:8: '9O1' in column 'force' is not a number; leave the cell empty "
                              "where there is no value"});
  EXPECT_EQ(came.numbers.size(), 1000u);
  EXPECT_EQ(came.numbers.back(), 1000);
  const auto account = account_of(lines.messages);
  EXPECT_EQ(account.offered, 1001);
  EXPECT_EQ(account.processed, 1000);
  EXPECT_EQ(account.missing, 1);
}

// Where the rate was given a line is a sample, and a bad line too: what comes later keeps its time.
TEST(CsvFaults, ABadLineKeepsItsPlaceWithoutATimeColumn)
{
  live::SourceRules rules;
  rules.reading.rate = 1000;
  Lines lines("force [kN]", rules);
  for (int k = 0; k < 1000; ++k)
    lines.line(k == 700 ? "9x0" : std::to_string(900 + k % 50));
  const CameMessages came = lines.end();
  EXPECT_EQ(came.refused, std::vector<std::string>{
                              "mill.csv:702:1: '9x0' in column 'force' is not a number; leave the cell empty "
                              "where there is no value"});
  ASSERT_EQ(came.numbers.size(), 999u);
  EXPECT_EQ(came.numbers[699], 699);
  EXPECT_EQ(came.numbers[700], 701);
  const auto account = account_of(lines.messages);
  EXPECT_EQ(account.offered, 1000);
  EXPECT_EQ(account.rejected, 1);
}

TEST(CsvFaults, ReportsAMissingColumnLineByLine)
{
  Lines lines("time [s],force [kN],upper_work_roll [g]");
  for (int k = 0; k < 300; ++k)
    lines.line(fmt::format(k == 100 || k == 101 ? "{:.3f},{}" : "{:.3f},{},0.1", k * 1e-3, 900 + k));
  const CameMessages came = lines.end();
  ASSERT_EQ(came.refused.size(), 2u);
  EXPECT_EQ(came.refused[1],
            "mill.csv:103:1: this line has 2 cells, the columns are 3; a decimal comma needs ';' or "
            "tab between the columns");
  EXPECT_EQ(came.numbers.size(), 298u);
  EXPECT_EQ(account_of(lines.messages).missing, 2);
}

// A recorder was started again with other columns, in the same file.
TEST(CsvFaults, StartsANewRecordAtAnotherHead)
{
  for (const int n : {20, 100}) {  // within the lines that tell the columns, and behind them
    Lines lines("time [s],upper_work_roll [g],force [kN]");
    for (int k = 0; k < n; ++k)
      lines.line(fmt::format("{:.3f},0.1,{}", k * 1e-3, 900 + k));
    lines.line("time [s],upper_work_roll [g],force [kN]");  // the same again is none
    lines.line(fmt::format("{:.3f},0.1,1000", n * 1e-3));
    lines.line(two_columns);
    lines.rows(100, 7, 1e-3);
    const CameMessages came = lines.end();
    EXPECT_TRUE(came.refused.empty()) << came.refused.front();
    ASSERT_EQ(came.heads.size(), 2u);
    EXPECT_EQ(came.heads[0].channels.size(), 2u);
    EXPECT_EQ(came.heads[1].channels.size(), 1u);
    EXPECT_EQ(came.notes,
              std::vector<std::string>{fmt::format(
                  "note: mill.csv:{}: other columns from here on; it is read as a new record", n + 4)});
    ASSERT_EQ(came.numbers.size(), std::size_t(n + 101));
    EXPECT_EQ(came.numbers.back(), 99);
    EXPECT_EQ(came.force[std::size_t(n + 1)], 900e3) << "the force of the new columns";
  }
}

TEST(CsvFaults, ContinuesWithAnotherRate)
{
  Lines lines(two_columns);
  lines.rows(5000, 0, 1e-3);
  lines.rows(3000, 5, 5e-4);
  const CameMessages came = lines.end();
  ASSERT_EQ(came.heads.size(), 2u);
  EXPECT_EQ(came.heads[0].rate, 1000);
  EXPECT_EQ(came.heads[1].rate, 2000);
  ASSERT_EQ(came.notes.size(), 1u);
  EXPECT_EQ(came.notes[0].substr(came.notes[0].find(": ", 6) + 2),
            "2000 samples per second, 1000 before; the twin goes on with the new rate");
  const std::vector<std::int64_t> last(came.numbers.end() - 2000, came.numbers.end());
  EXPECT_TRUE(in_a_row(last));
  EXPECT_EQ(last.back(), 12999) << "6.4995 s";
  EXPECT_TRUE(came.refused.empty());
}

TEST(CsvFaults, RefusesTimesThatDoNotDetermineARate)
{
  Lines lines(two_columns);
  for (int k = 0; k < 100; ++k)
    lines.line(fmt::format("{:.3f},{}", std::floor(k * 0.75) * 1e-3, 900 + k));
  try {
    lines.end();
    FAIL() << "a rate was reported";
  } catch (const InputError &error) {
    EXPECT_EQ(error.problems.front().message,
              "25 of 99 times stand still: the time column is too coarse, give the samples per second with --rate "
              "20000");
    EXPECT_EQ(error.problems.front().place.file, "mill.csv");
    EXPECT_EQ(error.problems.front().place.column, 1);
  }
}

TEST(CsvFaults, RefusesTimesThatRunBackwards)
{
  Lines lines(two_columns);
  lines.rows(100, 9, -1e-3);
  try {
    lines.end();
    FAIL() << "a rate was reported";
  } catch (const InputError &error) {
    EXPECT_EQ(error.problems.front().message,
              "the times do not increase; give the samples per second with --rate 20000");
  }
}

TEST(CsvFaults, OneTimeThatJumpsIsRefused)
{
  Lines lines(two_columns);
  lines.rows(500, 0, 1e-3);
  lines.line("7200.5000,900");
  lines.rows(500, 0.501, 1e-3);
  lines.line("-3600.0,900");
  lines.rows(100, 1.002, 1e-3);
  const CameMessages came = lines.end();
  EXPECT_EQ(came.refused,
            (std::vector<std::string>{"mill.csv:502: the time is 7200 s ahead of that of the line before, and the "
                                      "next line does not follow it",
                                      "mill.csv:1003: the time is 3601 s behind that of the line before, and the "
                                      "next line does not follow it"}));
  EXPECT_TRUE(came.notes.empty());
  EXPECT_EQ(came.numbers.size(), 1100u);
  const auto account = account_of(lines.messages);
  EXPECT_EQ(account.offered, 1102);
  EXPECT_EQ(account.processed, 1100);
}

TEST(CsvFaults, AClockThatJumpsAheadIsFollowed)
{
  Lines lines(two_columns);
  lines.rows(500, 0, 1e-3);
  lines.rows(500, 7200.5, 1e-3);
  const CameMessages came = lines.end();
  EXPECT_EQ(came.notes,
            std::vector<std::string>{"loss: mill.csv:502: the clock jumps ahead by 7200 s and goes on from "
                                     "there: what is between is missing"});
  EXPECT_EQ(came.numbers.size(), 1000u);
  const auto account = account_of(lines.messages);
  EXPECT_EQ(account.missing, 7200000);
  EXPECT_EQ(account.processed, 1000);
}

TEST(CsvFaults, AClockWithoutADateThatBeginsAgainGoesOn)
{
  Lines lines(two_columns);
  lines.rows(100, 0, 1e-3);
  lines.rows(400, 100, 1e-3);
  lines.rows(500, 0, 1e-3);
  const CameMessages came = lines.end();
  EXPECT_EQ(came.notes, std::vector<std::string>{
                            "loss: mill.csv:502: the time goes back by 100.4 s and has no date: taken to go on "
                            "behind the line before; what was lost between them is not known"});
  EXPECT_EQ(came.numbers.back(), 100899);
  EXPECT_EQ(account_of(lines.messages).processed, 1000);
}

// Of a date the same instant is not believed a second time.
TEST(CsvFaults, AClockWithADateThatGoesBackIsWaitedFor)
{
  Lines lines("time,force [kN]");
  const auto row_of = [](const int millisecond) {
    return fmt::format("2026-01-05T10:{:02}:{:02}.{:03}Z,900", millisecond / 60000, millisecond / 1000 % 60,
                       millisecond % 1000);
  };
  for (int k = 0; k < 400; ++k)
    lines.line(row_of(600000 + k));
  for (int k = 0; k < 300; ++k)
    lines.line(row_of(k));
  for (int k = 400; k < 500; ++k)
    lines.line(row_of(600000 + k));
  const CameMessages came = lines.end();
  ASSERT_EQ(came.notes.size(), 1u);
  EXPECT_EQ(came.notes[0],
            "loss: mill.csv:402: the clock goes back by 600.4 s: samples of the same time are not used");
  const auto account = account_of(lines.messages);
  EXPECT_EQ(account.processed, 500);
  EXPECT_EQ(account.offered, 500);
}

TEST(CsvFaults, ANewFileWhoseTimesBeginAgainGoesOn)
{
  Lines lines(two_columns);
  lines.rows(500, 0, 1e-3);
  lines.feed.new_file();
  lines.number = 0;
  lines.line(two_columns);
  lines.rows(500, 0, 1e-3);
  const CameMessages came = lines.end();
  EXPECT_TRUE(in_a_row(came.numbers));
  EXPECT_EQ(came.numbers.back(), 999);
  EXPECT_EQ(came.notes, std::vector<std::string>{
                            "loss: mill.csv:2: the time goes back by 0.5 s and has no date: taken to go on "
                            "behind the line before; what was lost between them is not known"});
}

TEST(CsvFaults, AHeadWithoutRowsIsWaitedFor)
{
  Lines lines(two_columns);
  lines.feed.settle();
  EXPECT_FALSE(lines.feed.has_head());
  lines.rows(10, 0, 1e-3);
  EXPECT_EQ(lines.end().numbers.size(), 10u);
}

// TW-31, short form of the fuzz run (MILLSTAND_PASSES times as many files): bytes that change, lines that are cut,
// sent twice or exchanged, times that jump.  Nothing but a sentence may come of it, and the account holds.
TEST(CsvFaults, AnyFileIsReadOrRefused)
{
  const char *const passes = std::getenv("MILLSTAND_PASSES");
  std::mt19937 random(31);
  const std::string letters = "0123456789.,;-+eE \t\"[]#xT:Z/\r\x80\xff";
  int read = 0, refused = 0;
  for (int file = 0; file < 300 * (passes ? std::max(1, std::atoi(passes)) : 1); ++file) {
    std::vector<std::string> text{two_columns};
    const double step = file % 3 ? 1e-3 : 5e-4;
    for (int k = 0; k < 20 + int(random() % 400); ++k)
      text.push_back(fmt::format("{:.4f},{}", k * step + (random() % 100 ? 0 : double(random() % 9000)), 900 + k));
    for (unsigned faults = random() % 12; faults > 0; --faults) {
      const std::size_t position = random() % text.size(), other = random() % text.size();
      std::string &line = text[position];
      switch (random() % 5) {
      case 0:
        line = line.substr(0, random() % (line.size() + 1));
        break;
      case 1:
        line = text[other];
        break;
      case 2:
        std::swap(line, text[other]);
        break;
      case 3:
        line.insert(random() % (line.size() + 1), 1, letters[random() % letters.size()]);
        break;
      default:
        if (!line.empty())
          line[random() % line.size()] = letters[random() % letters.size()];
      }
    }
    live::SourceRules rules;
    rules.closes = file % 2 == 0;
    if (file % 5 == 0)
      rules.reading.rate = 1000;
    try {
      Lines lines(text[0], rules);
      for (std::size_t i = 1; i < text.size(); ++i) {
        lines.line(text[i]);
        if (random() % 50 == 0)
          lines.feed.settle();
        if (random() % 200 == 0)
          lines.feed.new_file();
      }
      const CameMessages came = lines.end();
      if (!came.heads.empty())
        account_of(lines.messages);
      ++read;
    } catch (const InputError &) {
      ++refused;
    }
  }
  EXPECT_GT(read, refused);
}
