// A mutilated case is read or refused and nothing else.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "tests/support/case_folder.h"
#include <algorithm>
#include <random>

using namespace mill;

namespace {
class MutilatedCases : public CaseFolder {};
}  // namespace

TEST_F(MutilatedCases, AMutilatedCaseIsEitherReadOrRefused)
{
  const std::string all[]      = {template_of("four-high"), template_of("lumped"),
                                  read_text("cases/four-high-1400.toml"), read_text("cases/published-1400.toml"),
                                  read_text("cases/two-cylinders.toml")};
  const std::string snippets[] = {
      "\"",       "[",   "]",   "[[",         "]]",       "=",           "\n", ".",    "{",
      "}",        ",",   "#",   "-",          "e999",     " mm",         "\\", "'''",  "\xff",
      "\xc2\xb5", "nan", "inf", "1979-05-27", "[pass]\n", "[[strip]]\n", "0x", "true", std::string(1, '\0')};
  const unsigned seed = 20240501;
  std::mt19937 random(seed);
  int n_refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = all[random() % std::size(all)];
    for (unsigned n = 1 + random() % 4; n > 0 && !text.empty(); --n) {
      const std::size_t position = random() % text.size();
      const std::size_t line =
          text.rfind('\n', position) == std::string::npos ? 0 : text.rfind('\n', position) + 1;
      const std::size_t end = std::min(text.find('\n', position), text.size() - 1) + 1;
      switch (random() % 6) {
      case 0:
        text[position] = char(random() % 256);
        break;
      case 1:
        text.insert(position, snippets[random() % std::size(snippets)]);
        break;
      case 2:
        text.erase(position, 1 + random() % 30);
        break;
      case 3:  // a line is lost
        text.erase(line, end - line);
        break;
      case 4:  // a line is doubled elsewhere
        text.insert(text.rfind('\n', random() % text.size()) + 1, text.substr(line, end - line));
        break;
      default:  // the value of a line is replaced
        if (const auto equals = text.find('=', line); equals < end)
          text.replace(equals, end - equals - 1, "= " + snippets[random() % std::size(snippets)]);
      }
    }
    const std::string path = file("mutant.toml", text);
    try {
      const Case c = read_case(path);
      ASSERT_FALSE(c.resolved.empty());
    } catch (const InputError &error) {
      ++n_refused;
      ASSERT_FALSE(error.problems.empty());
      for (const Problem &problem : error.problems)
        ASSERT_FALSE(render(problem).empty());
    }  // any other exception fails the test
  }
  // comments swallow some mutations, hardly ever most of them
  EXPECT_GT(n_refused, 700) << "seed " << seed;
}

// One problem for each name that stands again, not one for each pair.
TEST_F(MutilatedCases, EachEqualNameIsReportedOnce)
{
  std::string text = "schema = 1\nkind = \"lumped\"\n";
  for (int i = 0; i < 200; ++i)
    text += "[[pass]]\nname = \"again\"\nload = \"1 kN\"\n";
  try {
    read_case(file("names.toml", text));
    FAIL() << "accepted";
  } catch (const InputError &error) {
    const auto again = [](const Problem &p) { return p.message.find("earlier pass") != std::string::npos; };
    EXPECT_EQ(std::count_if(error.problems.begin(), error.problems.end(), again), 199);
  }
}
