#include "twin/live/source/quick_line.h"
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

using namespace mill;

namespace {
// What the parser of the library reads must be what the quick one read, to the last bit.
void expect_the_same(const std::string &line, const live::LineContent &content)
{
  const auto json = nlohmann::json::parse(line, nullptr, false);
  ASSERT_TRUE(json.is_object()) << line;
  ASSERT_EQ(json.size(), content.values.size() + (content.s ? 1 : 0)) << line;
  if (content.s)
    EXPECT_EQ(json.at("s").get<double>(), *content.s);
  for (const auto &[name, list] : content.values) {
    ASSERT_EQ(json.at(name).size(), list.size()) << line;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (json.at(name)[i].is_null())
        EXPECT_TRUE(std::isnan(list[i])) << line;
      else
        EXPECT_EQ(json.at(name)[i].get<double>(), list[i]) << line;
    }
  }
}

std::string any_number(std::mt19937 &random)
{
  const double value = std::ldexp(double(random()) - 2147483648.0, int(random() % 80) - 60);
  switch (random() % 6) {
  case 0:
    return fmt::format("{}", int(random() % 2000) - 1000);
  case 1:
    return fmt::format("{:.{}f}", value, random() % 8);
  case 2:
    return fmt::format("{:.{}e}", value, random() % 20);
  case 3:
    return fmt::format("{}", value);
  case 4:
    return fmt::format("{}{}.{}", random(), random(), random());
  default:
    return "null";
  }
}

std::string any_line(std::mt19937 &random)
{
  std::string line = fmt::format("{{\"s\":{}", random());
  for (const char *name : {"force", "upper_work_roll", "AI 07"}) {
    line += fmt::format(", \"{}\" :[", name);
    for (unsigned i = 0, n = random() % 6; i < n; ++i)
      line += (i ? "," : "") + any_number(random);
    line += "]";
  }
  return line + "}";
}
}  // namespace

TEST(QuickLine, ReadsWhatTheParserReads)
{
  std::mt19937 random(7);
  int quick = 0;
  for (int k = 0; k < 3000; ++k) {
    const std::string line = any_line(random);
    live::LineContent content;
    if (!live::read_plain_block(line, content))
      continue;
    ++quick;
    expect_the_same(line, content);
  }
  EXPECT_GT(quick, 2900) << "blocks of numbers are its work";
}

// Whatever it takes of a line that was spoilt is what the parser takes; what it does not take it leaves as it was.
TEST(QuickLine, RefusesTextThatIsNotJson)
{
  std::mt19937 random(8);
  const std::string letters = "0123456789+-.eE,:[]{}\" nulx\\\t\x01\xc3";
  int taken                 = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string line = any_line(random);
    for (unsigned i = 0, n = 1 + random() % 3; i < n; ++i)
      line[random() % line.size()] = letters[random() % letters.size()];
    live::LineContent content;
    if (live::read_plain_block(line, content)) {
      ++taken;
      if (const auto json = nlohmann::json::parse(line, nullptr, false);
          json.is_object() && json.size() != content.values.size() + (content.s ? 1 : 0))
        FAIL() << "a name stands twice: " << line;
      expect_the_same(line, content);
    } else
      EXPECT_TRUE(content.values.empty() && !content.s);
  }
  EXPECT_GT(taken, 1000);
}

TEST(QuickLine, LeavesTheRestToTheParser)
{
  for (const char *line :
       {"{\"s\":1,\"s\":2,\"force\":[1]}", "{\"s\":1,\"force\":[1],\"force\":[2]}", "{\"s\":1,\"force\":[01]}",
        "{\"s\":1,\"force\":[1.]}", "{\"s\":1,\"force\":[.5]}", "{\"s\":1,\"force\":[+1]}",
        "{\"s\":1,\"force\":[1e]}", "{\"s\":1,\"force\":[1e999]}", "{\"s\":1,\"force\":[nan]}",
        "{\"s\":1,\"force\":[1,]}", "{\"s\":1,\"force\":1}", "{\"s\":1,\"force\":[1]} x",
        "{\"s\":1,\"f\\u006frce\":[1]}", "{\"s\":1,\"\":[1]}", "{\"millstand\":[1]}", "[1]", "", "{"}) {
    live::LineContent content;
    EXPECT_FALSE(live::read_plain_block(line, content)) << line;
  }
}
