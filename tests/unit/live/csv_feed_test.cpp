#include "core/base/errors.h"
#include "tests/support/came_messages.h"
#include "tests/support/near.h"
#include "twin/live/source/csv_feed.h"
#include "twin/live/source/file_sources.h"
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/fsuid.h>
#include <thread>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
struct Folder {
  fs::path path = fs::temp_directory_path() / ("millstand-tail-" + std::to_string(getpid()));
  Folder()
  {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder()
  {
    fs::remove_all(path);
  }
  std::string file(const std::string &name) const
  {
    return (path / name).string();
  }
};

void append(const std::string &path, const std::string &text)
{
  std::ofstream(path, std::ios::app | std::ios::binary) << text;
}

std::string rows(const int from, const int to)
{
  std::string text;
  for (int k = from; k < to; ++k)
    text += fmt::format("{:.4f},{}\n", k * 1e-3, 900 + k % 100);
  return text;
}

// Follows a file in a thread; what came is taken at the end.
class Follower {
public:
  explicit Follower(const std::string &path, const std::optional<live::ResumedFile> &resumed = {},
                    const std::string &print = "")
      : source{path, {}, 1, resumed, print}
  {
    queue.push(live::SourceHead{1e6, {}, "room", {}, {}});  // room for everything until the file's own head
    queue.pop(0);
    thread = std::thread([this] { live::follow_csv(source, queue, stop); });
  }
  ~Follower()
  {
    if (thread.joinable())
      end();
  }
  // Waits until this many samples came.
  bool has(const std::size_t samples)
  {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (came.numbers.size() < samples && std::chrono::steady_clock::now() < limit)
      if (const auto message = queue.pop(0.02))
        came.add(*message);
    return came.numbers.size() == samples;
  }
  const CameMessages &end()
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop = true;
    while (const auto message = queue.pop(0.1))
      came.add(*message);
    queue.close();
    thread.join();
    return came;
  }
  CameMessages came;

private:
  live::FileSource source;
  live::SampleQueue queue;
  std::atomic<bool> stop{false};
  std::thread thread;
};
}  // namespace

TEST(RateOfTimes, TakesTheFewestDigitsThatFit)
{
  const auto times = [](const double rate, const double digit) {
    std::vector<double> t;
    for (int k = 0; k < 4000; ++k)
      t.push_back(std::round(k / rate / digit) * digit);
    return t;
  };
  EXPECT_EQ(live::rate_of_times(times(20000, 1e-5)), 20000);
  EXPECT_EQ(live::rate_of_times(times(10000, 1e-4)), 10000);
  EXPECT_EQ(live::rate_of_times(times(12800, 1e-6)), 12800) << "78.125 us, printed in whole microseconds";
  EXPECT_EQ(live::rate_of_times(times(51200, 1e-7)), 51200);
  EXPECT_DOUBLE_EQ(live::rate_of_times(times(1 / 3e-5, 1e-9)), 1 / 3e-5) << "a spacing of 30 us";
  EXPECT_TRUE(near(live::rate_of_times(times(20000.37, 1e-12)), 20000.37,
                   within_absolute(1e-4, "times rounded to 1e-12 s over 0.2 s leave 1e-7 of the rate")))
      << "a clock of its own";
  auto with_gap = times(1000, 1e-3);
  for (std::size_t i = 2000; i < with_gap.size(); ++i)
    with_gap[i] += 7.5;
  EXPECT_EQ(live::rate_of_times(with_gap), 1000);
  EXPECT_THROW(live::rate_of_times(std::vector<double>(100, 1.0)), InputError);
}

TEST(CsvFeed, NumbersSamplesByTheirTimes)
{
  live::CsvFeed feed("force.csv", {});
  int number = 0;
  for (const char *line :
       {"time [s],force [kN]", "0,900", "0.001,901", "0.002,902", "0.005,905", "0.006,", "0.004,904", "0.007,907"})
    feed.line(line, ++number);
  feed.settle();
  CameMessages came;
  for (const auto &message : feed.take())
    came.add(message);
  ASSERT_EQ(came.heads.size(), 1u);
  EXPECT_EQ(came.heads[0].rate, 1000);
  EXPECT_EQ(came.numbers, (std::vector<std::int64_t>{0, 1, 2, 5, 6, 4, 7}));
  EXPECT_EQ(came.force[3], 905e3);
  EXPECT_TRUE(std::isnan(came.force[4]));
  EXPECT_EQ(came.notes.back(), "loss: force.csv: the time goes back by 0.003 s; samples of the same time are not "
                               "used");
}

namespace {
// A thousand rows a second with dates, from 2026-01-05 10:00:`second` UTC.
CameMessages dated_rows_of(const int second, const int n, const live::ResumedFile &from)
{
  live::CsvFeed feed("force.csv", {});
  feed.resume(from);
  feed.line("time,force [kN]", 1);
  for (int k = 0; k < n; ++k)
    feed.line(fmt::format("2026-01-05T10:00:{:02}.{:03}Z,{}", second + k / 1000, k % 1000, 900 + k % 100), k + 2);
  feed.finish();
  CameMessages came;
  for (const auto &message : feed.take())
    came.add(message);
  return came;
}
constexpr double ten_o_clock = 1767607200;  // s since 1970, 2026-01-05 10:00:00 UTC
}  // namespace

// After a restart the file may be another one: by dates its own numbers are those of the source before, less what
// lies between the first rows of both.
TEST(CsvFeed, LeavesOutByDatesWhatWasProcessedBeforeARestart)
{
  const live::ResumedFile from{5500, 1000, ten_o_clock, 0, true};  // up to 10:00:05.5
  const CameMessages same = dated_rows_of(0, 6000, from), later = dated_rows_of(5, 1000, from),
                     next = dated_rows_of(7, 1000, from);
  ASSERT_EQ(same.heads.at(0).start, ten_o_clock);
  ASSERT_EQ(same.numbers.size(), 500u);
  EXPECT_EQ(same.numbers.front(), 5500);
  ASSERT_EQ(later.numbers.size(), 500u) << "the half of the second that was not processed";
  EXPECT_EQ(later.numbers.front(), 500);
  ASSERT_EQ(next.numbers.size(), 1000u) << "all of it is new";
  EXPECT_EQ(next.numbers.front(), 0);
  live::ResumedFile of_half_the_rate = from;
  of_half_the_rate.next              = 2750;
  of_half_the_rate.rate              = 500;
  EXPECT_EQ(dated_rows_of(5, 1000, of_half_the_rate).numbers.at(0), 500);
}

TEST(CsvFeed, FiveBadLinesInARowCloseIt)
{
  live::CsvFeed feed("force.csv", {});
  int number = 0;
  feed.line("time [s],force [kN]", ++number);
  for (int k = 0; k < 100; ++k)
    feed.line(fmt::format("{:.3f},{}", k * 1e-3, 900 + k), ++number);
  feed.line("0.100,9x0", ++number);
  feed.line("0.101", ++number);
  feed.line("0.102,902", ++number);
  for (int k = 0; k < 5; ++k)
    feed.line("<html>", ++number);
  EXPECT_TRUE(feed.closed());
  CameMessages came;
  for (const auto &message : feed.take())
    came.add(message);
  ASSERT_EQ(came.refused.size(), 7u);
  EXPECT_EQ(
      came.refused[0],
      "force.csv:102:7: '9x0' in column 'force' is not a number; leave the cell empty where there is no value");
  EXPECT_EQ(came.refused[1],
            "force.csv:103:1: this line has 1 cells, the columns are 2; a decimal comma needs ';' or "
            "tab between the columns");
  EXPECT_EQ(came.numbers.size(), 101u);
}

TEST(CsvFeed, SaysWhatAHeadLacks)
{
  live::SourceRules rules;
  rules.places = {"upper_work_roll"};
  live::CsvFeed feed("rolls.csv", rules);
  feed.line("time [s],torque [Nm]", 1);
  feed.line("0,0.1", 2);
  feed.line("0.001,0.1", 3);
  try {
    feed.settle();
    FAIL() << "a record without a force and without an acceleration was taken";
  } catch (const InputError &error) {
    EXPECT_EQ(
        error.problems.front().message,
        "no channel \"force\", which drives the twin, and no acceleration; name the column of the rolling force "
        "with --channel NAME=force, or give the unit of an acceleration with --unit NAME=g");
    EXPECT_EQ(error.problems.front().place.file, "rolls.csv");
    EXPECT_EQ(error.problems.front().place.line, 1);
  }
}

// TW-34: renamed with half a line in its end, reopened by name.
TEST(GrowingFile, IsFollowedThroughARename)
{
  const Folder folder;
  const std::string file = folder.file("force.csv");
  append(file, "time [s],force [kN]\n" + rows(0, 1000));
  Follower follower(file);
  ASSERT_TRUE(follower.has(1000));
  append(file, "1.0000,9");  // half a line waits
  std::this_thread::sleep_for(std::chrono::milliseconds(80));
  EXPECT_TRUE(follower.has(1000));
  append(file, "00\n" + rows(1001, 1100));
  ASSERT_TRUE(follower.has(1100));
  fs::rename(file, folder.file("force.csv.1"));
  append(folder.file("force.csv.1"), rows(1100, 1300));  // the writer has not noticed
  append(file, "time [s],force [kN]\n" + rows(1300, 2000));
  ASSERT_TRUE(follower.has(2000));
  const CameMessages &came = follower.end();
  for (std::size_t k = 0; k < came.numbers.size(); ++k) {
    ASSERT_EQ(came.numbers[k], std::int64_t(k));
    ASSERT_EQ(came.force[k], 1e3 * double(900 + k % 100));
  }
  EXPECT_TRUE(came.refused.empty());
  EXPECT_EQ(came.notes.back(), "note: " + file + " was renamed; it was read to its end, the new file goes on");
}

// A program that changes files makes the new one before its rights: it is waited for, where another start would be
// refused.
TEST(GrowingFile, ANewFileThatMayNotBeReadYetIsWaitedFor)
{
  const Folder folder;
  const std::string file = folder.file("force.csv"), next = folder.file("next.csv"),
                    text = "time [s],force [kN]\n";
  append(file, text + rows(0, 1000));
  append(next, text + rows(1000, 2000));
  fs::permissions(next, fs::perms::none);
  const bool root = geteuid() == 0;
  if (root)
    setfsuid(65534);  // of this thread and of those that it starts: root may read everything
  {
    Follower follower(file);
    EXPECT_TRUE(follower.has(1000));
    if (root)
      setfsuid(0);
    fs::rename(next, file);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_TRUE(follower.has(1000));
    fs::permissions(file, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
    EXPECT_TRUE(follower.has(2000));
    const CameMessages &came = follower.end();
    ASSERT_GE(came.notes.size(), 2u);
    EXPECT_EQ(came.notes[0], "note: " + file + " was renamed; it was read to its end, the new file goes on");
    EXPECT_EQ(came.notes[1], "note: " + file + " cannot be read: Permission denied; it is waited for");
  }
}

// TW-34: truncated in place, by size and by what it begins with.
TEST(GrowingFile, SaysThatItWasTruncated)
{
  for (const bool refilled : {false, true}) {
    const Folder folder;
    const std::string file = folder.file("force.csv");
    append(file, "time [s],force [kN]\n" + rows(0, 1000));
    Follower follower(file);
    ASSERT_TRUE(follower.has(1000));
    const std::string more = rows(1000, refilled ? 3000 : 1010);  // longer, or shorter than before
    std::ofstream(file, std::ios::trunc | std::ios::binary) << more;
    ASSERT_TRUE(follower.has(refilled ? 3000u : 1010u));
    const CameMessages &came = follower.end();
    EXPECT_EQ(came.numbers.back(), refilled ? 2999 : 1009);
    ASSERT_EQ(came.notes.size(), 1u);
    EXPECT_EQ(came.notes[0].rfind("loss: " + file + " was truncated in place at byte ", 0), 0u) << came.notes[0];
  }
}

// Without dates the beginning of a file says whether it is the one that was read before a restart.
TEST(GrowingFile, IsRecognisedAfterARestart)
{
  const Folder folder;
  const std::string file = folder.file("force.csv"), head = "time [s],force [kN]\n";
  append(file, head + rows(0, 1000));
  Follower first(file);
  ASSERT_TRUE(first.has(1000));
  fs::rename(file, folder.file("force.csv.1"));
  append(file, head + rows(0, 500));  // a clock that begins again: its rows are 1000 to 1499
  ASSERT_TRUE(first.has(1500));
  const CameMessages before = first.end();
  ASSERT_EQ(before.files.size(), 2u);
  EXPECT_EQ(before.files[0].first, 0);
  EXPECT_EQ(before.files[1].first, 1000);
  EXPECT_EQ(before.numbers.back(), 1499);

  append(file, rows(500, 700));
  Follower again(file, live::ResumedFile{1500, 1000, {}, 1000, false}, before.files[1].print);
  ASSERT_TRUE(again.has(200)) << "what came since, and nothing twice";
  EXPECT_EQ(again.end().numbers.front(), 1500);

  fs::rename(file, folder.file("force.csv.2"));
  append(file, head + rows(0, 40));  // begins as the one before did
  for (int k = 40; k < 300; ++k)
    append(file, fmt::format("{:.4f},700\n", k * 1e-3));
  Follower other(file, live::ResumedFile{1700, 1000, {}, 1000, false}, before.files[1].print);
  ASSERT_TRUE(other.has(300)) << "all rows of a file that was never read";
  const CameMessages &came = other.end();
  EXPECT_EQ(came.numbers.front(), 1700);
  EXPECT_EQ(came.numbers.back(), 1999);
  EXPECT_EQ(came.notes.at(0),
            "loss: " + file +
                ": another file than before the restart, and its times have no "
                "date: taken to go on behind the sample before; what was lost between them is not "
                "known");
}

TEST(GrowingFile, IsWaitedForAndMayBeginWithFewLines)
{
  const Folder folder;
  const std::string file = folder.file("force.csv");
  Follower follower(file);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  append(file, "time [s],force [kN]\n0,900\n0.001,901\n");
  EXPECT_TRUE(follower.has(2));
  append(file, "0.002,902\n");
  EXPECT_TRUE(follower.has(3));
  EXPECT_EQ(follower.end().notes.front(), "note: " + file + " is not there yet; it is waited for");
}

// Two records of 0.6 s in one file, played twice as fast: 0.6 s for both, since no block is given away before its
// last sample is due.  The times of the second begin again.
TEST(Replay, ARecordBehindAnotherIsPlayedAtItsPaceToo)
{
  const Folder folder;
  const std::string file = folder.file("two.csv");
  append(file, "time [s],force [kN]\n" + rows(0, 600) + "time [s],force [kN],note\n");
  for (int k = 0; k < 600; ++k)
    append(file, fmt::format("{:.4f},900,1\n", k * 1e-3));
  live::SampleQueue queue;
  const std::atomic<bool> stop{false};
  const auto begin = std::chrono::steady_clock::now();
  live::replay_csv({file, {}, 2, {}, ""}, queue, stop);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  CameMessages came;
  while (const auto message = queue.pop(0))
    came.add(*message);
  ASSERT_EQ(came.heads.size(), 2u);
  EXPECT_EQ(came.numbers.size(), 1200u);
  EXPECT_GE(seconds, 0.6);
}
