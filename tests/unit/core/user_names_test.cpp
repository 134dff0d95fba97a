// Names of the user with the signs that separate the parts of the names of results, keys and files.
#include "core/base/files.h"
#include "core/base/name_part.h"
#include "core/base/visible_text.h"
#include "core/case/case_template.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bite.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <random>

using namespace mill;

TEST(NameParts, HoldNoSeparatorAndComeBackAsTheyWere)
{
  EXPECT_EQ(name_part("2.0 mm/A"), "2%2E0 mm%2FA");
  const unsigned seed = 11;
  std::mt19937 random(seed);
  for (int draw = 0; draw < 1000; ++draw) {
    std::string name;
    for (int i = int(random() % 12); i >= 0; --i)
      name += "ab./% 2EF-"[random() % 10];
    const std::string part = name_part(name);
    EXPECT_EQ(part.find_first_of("./"), std::string::npos) << name;
    if (name.find("%2") == std::string::npos) {  // who writes %2E means a point
      EXPECT_EQ(with_plain_names("pass \"" + part + "\": x"), "pass \"" + name + "\": x") << "seed " << seed;
    }
    const auto id = result_id(row::bite::force.of(part));
    ASSERT_TRUE(id) << name;
    EXPECT_EQ(id->place("pass"), part) << name;
  }
}

TEST(NameParts, FilesAndMessagesHaveTheNameItself)
{
  EXPECT_EQ(slug(name_part("2.0 mm/A")), slug("2.0 mm/A"));
  EXPECT_EQ(slug(name_part("2.0 mm/A")), "2-0-mm-a");
  EXPECT_EQ(visible(name_part("S1/front")), "S1/front");
}

TEST(NameParts, AreReadWhereverANameIsGivenOrReferredTo)
{
  const std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_names.toml").string();
  std::string text       = template_of("four-high");
  const auto replace_all = [&](const std::string &from, const std::string &to) {
    std::size_t n = 0;
    for (auto place = text.find(from); place != std::string::npos; place = text.find(from, place + to.size()), ++n)
      text.replace(place, from.size(), to);
    EXPECT_GT(n, 0u) << from;
  };
  replace_all("[bearing.trb]", "[bearing.\"TRB 1.5/a\"]");
  replace_all("\"trb\"", "\"TRB 1.5/a\"");
  replace_all("\"pass 1\"", "\"2.0 mm/A\"");
  write_atomically(path, text);
  const Case c      = read_case(path, {"bearing.\"TRB 1.5/a\".rollers_per_row=41"});
  const auto &stand = std::get<FourHigh>(c.spec);
  EXPECT_EQ(stand.passes.at(0).name, "2%2E0 mm%2FA");
  EXPECT_EQ(stand.work_roll.bearing, "TRB 1%2E5%2Fa");
  EXPECT_EQ(bearing_of(stand.bearings, stand.work_roll.bearing).rollers_per_row, 41);
  std::filesystem::remove(path);
}
