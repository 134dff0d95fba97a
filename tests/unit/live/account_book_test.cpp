#include "tests/support/live_samples.h"
#include "tests/support/published_stand.h"
#include "twin/live/account_book.h"
#include "twin/live/source/line_session.h"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

using namespace mill;

namespace {
enum State : char { lost, null, processed, rejected };

// The account kept sample by sample.
struct Truth {
  std::vector<State> of[2];
  std::int64_t next = -1, doubled = 0, first = 0;

  void offer_up_to(const std::int64_t s)
  {
    if (next < 0)
      next = first = s;
    for (; next < s; ++next)
      for (auto &channel : of)
        channel.push_back(lost);
  }
  void arrive(const std::int64_t s, const bool good, const bool null_0, const bool null_1)
  {
    offer_up_to(s);
    if (s >= next) {
      of[0].push_back(!good ? rejected : null_0 ? null : processed);
      of[1].push_back(!good ? rejected : null_1 ? null : processed);
      ++next;
      return;
    }
    const auto index = std::size_t(s - first);
    if (s < first || of[0][index] != lost) {
      ++doubled;
      return;
    }
    of[0][index] = of[1][index] = rejected;
  }
  live::ChannelAccount account(const int channel) const
  {
    live::ChannelAccount a;
    a.offered = std::int64_t(of[channel].size());
    for (const State state : of[channel])
      ++(state == processed ? a.processed : state == rejected ? a.rejected : a.missing);
    return a;
  }
};

void expect_same(const live::ChannelAccount &a, const live::ChannelAccount &b)
{
  EXPECT_EQ(a.offered, b.offered);
  EXPECT_EQ(a.processed, b.processed);
  EXPECT_EQ(a.missing, b.missing);
  EXPECT_EQ(a.rejected, b.rejected);
  EXPECT_EQ(a.overrun, b.overrun);
}

std::string line_of(const std::int64_t s, const std::string &force, const std::string &roll)
{
  return fmt::format("{{\"s\":{},\"force\":[{}],\"upper_work_roll\":[{}]}}", s, force, roll);
}
}  // namespace

// TW-28: 100000 blocks lost, doubled, out of order, cut, with nulls and garbage; the identity holds after each.
TEST(Account, BalancesAtEveryStepForAnyOrderOfArrival)
{
  const ParameterSet set = parameter_set("R1");
  LiveSamples run({"test", "as published", set.stand, set.dynamics, "hash"}, 1000);
  live::SourceRules rules;
  rules.places = {"upper_work_roll"};
  rules.closes = false;
  live::LineSession session(rules);
  auto head = session.take(R"({"millstand":1,"rate":1000,"units":{"force":"kN","upper_work_roll":"g"}})");
  ASSERT_TRUE(head.message);
  run.engine().take(*head.message);
  std::mt19937 random(20260105);
  const auto chance = [&](const int percent) { return int(random() % 100) < percent; };
  struct Sent {
    std::int64_t s;
    std::vector<bool> null_0, null_1;
    bool good;
    std::string line;
  };
  Truth truth;
  std::vector<Sent> held;
  std::int64_t s = 500, refused = 0;
  for (int block = 0; block < 100000; ++block) {
    Sent sent{s, {}, {}, true, ""};
    std::string force, roll;
    const int n = 1 + int(random() % 8);
    for (int i = 0; i < n; ++i) {
      sent.null_0.push_back(chance(1));
      sent.null_1.push_back(chance(5));
      force += (i ? "," : "") + std::string(sent.null_0.back() ? "null" : "976.2");
      roll += (i ? "," : "") + std::string(sent.null_1.back() ? "null" : "0.1");
    }
    sent.line = line_of(s, force, roll);
    s += n;
    std::vector<Sent> now;
    if (chance(3))
      continue;  // lost
    if (chance(2)) {
      held.push_back(sent);  // comes later
      continue;
    }
    if (chance(2)) {  // cut: the owner of these samples cannot be identified
      run.engine().take(*session.take(sent.line.substr(0, random() % sent.line.size() * 9 / 10 + 1)).message);
      ++refused;
    } else if (chance(2)) {  // a channel that the head does not know: refused with its samples
      sent.good = false;
      sent.line.insert(sent.line.size() - 1, ",\"oil\":[1]");
      now.push_back(sent);
    } else {
      now.push_back(sent);
      if (chance(2))
        now.push_back(sent);  // doubled
    }
    if (chance(2)) {
      std::string garbage(1 + random() % 60, ' ');
      for (char &c : garbage)
        c = char(33 + random() % 90);
      if (auto answer = session.take(garbage); answer.message) {
        run.engine().take(*answer.message);
        ++refused;
      }
    }
    if (!held.empty() && chance(40)) {
      now.push_back(held.front());
      held.erase(held.begin());
    }
    for (const Sent &one : now) {
      auto answer = session.take(one.line);
      ASSERT_TRUE(answer.message) << one.line;
      refused += !one.good;
      run.engine().take(std::move(*answer.message));
      for (std::size_t i = 0; i < one.null_0.size(); ++i)
        truth.arrive(one.s + std::int64_t(i), one.good, one.null_0[i], one.null_1[i]);
      ASSERT_TRUE(run.engine().book()->balanced()) << "block " << block;
      ASSERT_EQ(run.engine().book()->next(), truth.next) << "block " << block;
    }
  }
  for (const int channel : {0, 1})
    expect_same(run.engine().book()->channels()[std::size_t(channel)], truth.account(channel));
  EXPECT_EQ(run.engine().book()->doubled(), truth.doubled);
  EXPECT_EQ(run.engine().refused_lines(), refused);
  EXPECT_GT(truth.account(1).rejected, 1000);
  EXPECT_GT(truth.account(1).missing, 10000);
  EXPECT_GT(truth.doubled, 1000);
}

TEST(Account, LateSamplesMoveFromMissingToRejectedOnce)
{
  live::AccountBook book(1);
  const Eigen::MatrixXd ten = Eigen::MatrixXd::Ones(10, 1);
  EXPECT_EQ(book.arrive(100, 10).take, 10);
  book.take(ten);
  EXPECT_EQ(book.arrive(120, 10).gap, 10);
  book.take(ten);
  EXPECT_EQ(book.arrive(110, 10).take, 0);
  EXPECT_EQ(book.arrive(110, 10).take, 0);
  expect_same(book.channels()[0], {30, 20, 0, 10, 0});
  EXPECT_EQ(book.doubled(), 10);
}

TEST(Account, ABlockThatOverlapsIsTakenFromItsFirstNewSample)
{
  live::AccountBook book(1);
  book.arrive(0, 10);
  book.take(Eigen::MatrixXd::Ones(10, 1));
  const auto part = book.arrive(6, 10);
  EXPECT_EQ(part.skip, 4);
  EXPECT_EQ(part.take, 6);
  book.take(Eigen::MatrixXd::Ones(6, 1));
  expect_same(book.channels()[0], {16, 16, 0, 0, 0});
}

TEST(Account, DroppedBlocksAreOverrun)
{
  live::AccountBook book(2);
  book.arrive(0, 5);
  book.take(Eigen::MatrixXd::Ones(5, 2));
  book.overrun(5, 20);
  book.overrun(30, 5);
  for (const auto &account : book.channels())
    expect_same(account, {35, 5, 5, 0, 25});
}
