#include "twin/live/source/line_session.h"
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace mill;

namespace {
live::SourceRules rules()
{
  live::SourceRules its;
  its.places = {"upper_work_roll", "lower_work_roll"};
  return its;
}

const std::string good_head =
    R"({"millstand":1,"rate":20000,"start":"2026-01-05T10:00:00Z","units":{"force":"kN","upper_work_roll":"g","speed":"m/s"},"source":"daq-1"})";

std::string reason_of(live::LineSession &session, const std::string &line)
{
  const auto answer = session.take(line);
  if (!answer.message || !std::holds_alternative<live::RefusedLine>(*answer.message))
    return "taken";
  return std::get<live::RefusedLine>(*answer.message).reason;
}

std::string head_reason(const std::string &line)
{
  live::LineSession session(rules());
  const auto answer = session.take(line);
  EXPECT_TRUE(answer.close) << "the first line has to be a head: " << line;
  return answer.message ? std::get<live::RefusedLine>(*answer.message).reason : "";
}

std::string deep(const int n)
{
  return std::string(std::size_t(n), '[');
}
}  // namespace

TEST(LineSession, TakesTheLinesOfTheDescription)
{
  live::LineSession session(rules());
  const auto head = session.take(good_head);
  ASSERT_TRUE(head.message && std::holds_alternative<live::SourceHead>(*head.message));
  EXPECT_EQ(head.reply, "{\"millstand\":1}");
  const auto &source = std::get<live::SourceHead>(*head.message);
  EXPECT_EQ(source.rate, 20000);
  EXPECT_EQ(source.start, 1767607200.0);
  EXPECT_EQ(source.channels[0].unit, "N");
  EXPECT_EQ(source.channels[1].unit, "m/s2");
  const auto answer =
      session.take(R"({"s":40000,"force":[976.2,977],"upper_work_roll":[0.11,null],"speed":[4.02]})");
  ASSERT_TRUE(answer.message && std::holds_alternative<live::SourceBlock>(*answer.message));
  EXPECT_EQ(answer.reply, "{\"ack\":40000}");
  const auto &block = std::get<live::SourceBlock>(*answer.message);
  EXPECT_EQ(block.first, 40000);
  EXPECT_DOUBLE_EQ(block.value(1, 0), 977e3);
  EXPECT_DOUBLE_EQ(block.value(0, 1), 0.11 * 9.80665);
  EXPECT_TRUE(std::isnan(block.value(1, 1)));
  EXPECT_EQ(block.value(1, 2), 4.02);
}

TEST(LineSession, RefusesHeadsWithAReason)
{
  EXPECT_EQ(head_reason("GET / HTTP/1.1"), "line 1: no JSON from byte 1 on");
  EXPECT_EQ(head_reason(R"({"s":0,"force":[1]})"),
            "line 1: a block before the head; send {\"millstand\":1,\"rate\":..,\"units\":{..}} first");
  EXPECT_EQ(head_reason(R"({"millstand":2,"rate":20000,"units":{"force":"kN"}})"),
            "line 1: \"millstand\" is not 1, the only version there is");
  EXPECT_EQ(head_reason(R"({"millstand":1,"rate":0,"units":{"force":"kN"}})"),
            "line 1: \"rate\" is 0; 10 to 1e+06 samples per second are allowed");
  EXPECT_EQ(head_reason(R"({"millstand":1,"units":{"force":"kN"}})"),
            "line 1: \"rate\" is missing; 10 to 1e+06 samples per second are allowed");
  EXPECT_EQ(head_reason(R"({"millstand":1,"rate":20000,"units":{"force":"furlong"}})"),
            "line 1: channel \"force\" has the unit \"furlong\"; a force (N, kN, MN) is needed");
  EXPECT_EQ(head_reason(R"({"millstand":1,"rate":20000,"units":{"force":""}})"),
            "line 1: channel \"force\" has no unit; a force (N, kN, MN) is needed");
  EXPECT_EQ(
      head_reason(R"({"millstand":1,"rate":20000,"units":{"force":"kN","upper_work_roll":"gee"}})"),
      "line 1: channel \"upper_work_roll\" has the unit \"gee\"; an acceleration (g, m/s2) or a velocity (mm/s) "
      "is needed");
  EXPECT_EQ(head_reason(R"({"millstand":1,"rate":20000,"units":{"torque":"Nm"}})"),
            "line 1: no channel \"force\", which drives the twin, and no acceleration; name the column of the "
            "rolling force "
            "with --channel NAME=force, or give the unit of an acceleration with --unit NAME=g");
  EXPECT_EQ(head_reason(R"({"millstand":1,"rate":20000,"start":"yesterday","units":{"force":"kN"}})"),
            "line 1: 'yesterday' is not a time; write for example 2026-01-05T10:00:00.00005+01:00");
  EXPECT_EQ(head_reason(R"({"millstand":1,"rate":20000,"start":"10:00:00","units":{"force":"kN"}})"),
            "line 1: \"start\" has no date; write for example 2026-01-05T10:00:00Z");
}

TEST(LineSession, RefusesBlocksWithAReasonAndItsSamples)
{
  live::LineSession session([] {
    auto its   = rules();
    its.closes = false;
    return its;
  }());
  session.take(good_head);
  EXPECT_EQ(reason_of(session, R"({"force":[1]})"),
            "line 2: \"s\", the number of the first sample, is missing or no whole number from 0 to 2^53");
  EXPECT_EQ(reason_of(session, R"({"s":1.5,"force":[1]})"),
            "line 3: \"s\", the number of the first sample, is missing or no whole number from 0 to 2^53");
  EXPECT_EQ(reason_of(session, R"({"s":0,"force":[1,2,3],"speed":[4,5]})"),
            "line 4: \"speed\" has 2 samples, the longest list 3; one, or as many as the longest, are needed");
  EXPECT_EQ(reason_of(session, R"({"s":0,"oil":[1]})"), "line 5: \"oil\" is not in the \"units\" of the head");
  EXPECT_EQ(reason_of(session, R"({"s":0,"force":[1e999]})"), "line 6: a number at byte 21 is too large");
  EXPECT_EQ(reason_of(session, R"({"s":0,"force":["a"]})"),
            "line 7: \"force\" holds a text; numbers and null are samples");
  EXPECT_EQ(reason_of(session, R"({"s":0,"force":[[1]]})"), "line 8: \"force\" holds a list inside a list");
  EXPECT_EQ(reason_of(session, R"({"s":0,"force":976.2})"),
            "line 9: \"force\" is one number; write a list, \"force\":[976.2]");
  EXPECT_EQ(reason_of(session, R"({"s":0,"force":[1],"force":[2]})"), "line 10: \"force\" appears twice");
  EXPECT_EQ(reason_of(session, R"({"s":0,"force":[1)"), "line 11: no JSON from byte 18 on");
  EXPECT_EQ(reason_of(session, R"({"s":0})"), "line 12: no samples");
  EXPECT_EQ(reason_of(session, "{\"s\":" + deep(100000)), "line 13: \"s\" holds a list inside a list");
  std::string many = "[0";
  for (int i = 0; i < 8192; ++i)
    many += ",0";
  EXPECT_EQ(reason_of(session, "{\"s\":0,\"force\":" + many + "]}"),
            "line 14: \"force\" has more than 8192 samples");
  EXPECT_EQ(reason_of(session, std::string((1 << 20) + 1, ' ') + "x"), "line 15: longer than 1 MiB");
  std::string wide = R"({"millstand":1,"rate":20000,"units":{"force":"kN")";
  for (int i = 0; i < 64; ++i)
    wide += ",\"c" + std::to_string(i) + "\":\"V\"";
  EXPECT_EQ(reason_of(session, wide + "}}"), "line 16: more than 64 channels");
  const auto known = session.take(R"({"s":70,"force":[1,2],"oil":[1]})");
  EXPECT_EQ(std::get<live::RefusedLine>(*known.message).first, 70);
  EXPECT_EQ(std::get<live::RefusedLine>(*known.message).n, 2);
}

TEST(LineSession, FiveBadLinesInARowClose)
{
  live::LineSession session(rules());
  session.take(good_head);
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 4; ++i)
      EXPECT_FALSE(session.take("garbage").close);
    EXPECT_FALSE(session.take(R"({"s":0,"force":[1]})").close);
  }
  for (int i = 0; i < 4; ++i)
    EXPECT_FALSE(session.take("garbage").close);
  const auto last = session.take("garbage");
  EXPECT_TRUE(last.close);
  EXPECT_EQ(last.reply, R"({"rejected":"no JSON from byte 1 on","line":21,"closed":"five bad lines in a row"})");
}

TEST(LineSession, RefusesANumberFarAhead)
{
  live::LineSession session(rules());
  session.take(good_head);
  session.take(R"({"s":0,"force":[1]})");
  EXPECT_EQ(
      reason_of(session, R"({"s":200000000000,"force":[1]})"),
      "line 3: \"s\":200000000000 is 10000000 s ahead of the block before; send a new head to go on from there");
  EXPECT_EQ(reason_of(session, R"({"s":40001,"force":[1]})"), "taken");
}

// Messages of a broker do not say who sent them.
TEST(LineSession, ASecondSourceIsRefusedWhileTheFirstSends)
{
  double now = 100;
  auto its   = rules();
  its.closes = false;
  its.clock  = [&] { return now; };
  live::LineSession session(its);
  std::string other = good_head;
  other.replace(other.find("daq-1"), 5, "daq-2");
  EXPECT_EQ(reason_of(session, good_head), "taken");
  EXPECT_EQ(reason_of(session, other), "taken") << "the first has not sent anything";
  EXPECT_EQ(reason_of(session, good_head), "taken");
  EXPECT_EQ(reason_of(session, R"({"s":0,"force":[1]})"), "taken");
  now += 4;
  EXPECT_EQ(reason_of(session, other), "line 5: source \"daq-2\" begins while \"daq-1\" sends, which goes on; "
                                       "blocks of two sources cannot be "
                                       "distinguished here: stop one of them, or give it another stand");
  EXPECT_EQ(reason_of(session, good_head), "taken") << "the first may say its head again";
  EXPECT_EQ(reason_of(session, R"({"s":1,"force":[1]})"), "taken") << "and goes on";
  now += 6;
  EXPECT_EQ(reason_of(session, other), "taken") << "it has been silent";
}

TEST(LineSession, AskForTheToken)
{
  auto its  = rules();
  its.token = "0123456789abcdef0123456789abcdef";
  live::LineSession session(its);
  EXPECT_EQ(reason_of(session, good_head), "line 1: \"token\" is missing or wrong");
  std::string with = good_head;
  with.insert(1, "\"token\":\"0123456789abcdef0123456789abcdef\",");
  EXPECT_EQ(reason_of(session, with), "taken");
}

TEST(LineSession, SendsTheNumberToContinueAt)
{
  auto its = rules();
  its.next = [](const live::SourceHead &head) {
    return head.rate == 20000 && head.start == 1767607200.0 && head.source == "daq-1" && head.channels.size() == 3
               ? std::optional<std::int64_t>(4711)
               : std::nullopt;
  };
  live::LineSession session(its);
  EXPECT_EQ(session.take(good_head).reply, "{\"millstand\":1,\"next\":4711}");
  EXPECT_EQ(session.take(R"({"millstand":1,"rate":1000,"units":{"force":"kN"}})").reply, "{\"millstand\":1}")
      << "another record";
}

TEST(LineCutter, KeepsHalfALineAndCutsALongOne)
{
  live::LineCutter cutter;
  std::vector<std::size_t> lengths;
  const auto take = [&](const std::string_view line) { lengths.push_back(line.size()); };
  cutter.add("ab", take);
  EXPECT_TRUE(lengths.empty());
  cutter.add("c\r\n\nde", take);
  for (int i = 0; i < 3; ++i)
    cutter.add(std::string(1 << 20, 'x'), take);
  cutter.add("\nend\n", take);
  EXPECT_EQ(lengths, (std::vector<std::size_t>{3, 0, live::line_limits.bytes + 1, 3}));
}

// Short form of the fuzz run: MILLSTAND_PASSES times as many inputs.
TEST(LineSession, SurvivesAnyInput)
{
  const char *const passes = std::getenv("MILLSTAND_PASSES");
  const int rounds         = 10000 * (passes ? std::max(1, std::atoi(passes)) : 1);
  std::mt19937 random(7);
  const std::vector<std::string> seeds{
      good_head,
      R"({"s":40000,"force":[976.2,977],"upper_work_roll":[0.11,null],"speed":[4.02]})",
      R"({"s":9007199254740992,"force":[-1e308,1e-320,0]})",
      R"({"millstand":1,"rate":1e6,"units":{"force":"MN"}})",
      R"({"\u0000":[1],"s":0})",
      "[[[[[[",
      "{\"a\":{\"b\":{\"c\":{}}}}"};
  auto its   = rules();
  its.closes = false;
  live::LineSession session(its);
  int taken = 0, refused = 0;
  for (int i = 0; i < rounds; ++i) {
    std::string line = seeds[random() % seeds.size()];
    for (auto n = random() % 6; n > 0; --n) {
      const auto position = line.empty() ? 0 : random() % line.size();
      switch (random() % 5) {
      case 0:
        line.insert(line.begin() + std::ptrdiff_t(position), char(random() % 256));
        break;
      case 1:
        if (!line.empty())
          line[position] = char(random() % 256);
        break;
      case 2:
        line.erase(position, random() % 8);
        break;
      case 3:
        line.insert(position, seeds[random() % seeds.size()].substr(0, random() % 30));
        break;
      default:
        line.insert(position, "[{\"0,:.e-null\\u"[random() % 15], 1);
      }
    }
    const auto answer = session.take(line);
    if (!answer.message)
      continue;
    ++(std::holds_alternative<live::RefusedLine>(*answer.message) ? refused : taken);
    if (const auto *block = std::get_if<live::SourceBlock>(&*answer.message)) {
      ASSERT_GE(block->first, 0);
      ASSERT_LE(block->value.rows(), 8192);
      ASSERT_FALSE((block->value.array().abs() == std::numeric_limits<double>::infinity()).any()) << line;
    }
  }
  EXPECT_GT(taken, rounds / 20) << "mutations too coarse to reach what is behind the parser";
  EXPECT_GT(refused, rounds / 10);
}
