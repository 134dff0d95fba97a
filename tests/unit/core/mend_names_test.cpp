// One typo, one error: what a mistyped name represents is read on and checked.
#include "core/base/files.h"
#include "core/case/fields.h"
#include "core/case/input_reference.h"
#include "core/case/removed_keys.h"
#include "core/model/case.h"
#include "tests/support/refusal.h"
#include <ctime>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>

using namespace mill;

namespace {
class OneTypo : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_typo_test.toml").string();
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  /// The demo stand with one text in place of another.
  std::string with(const std::string &from, const std::string &to, const char *file = "cases/four-high-1400.toml")
  {
    std::string text    = read_text(file);
    const auto position = text.find(from);
    EXPECT_NE(position, std::string::npos) << from;
    text.replace(position, from.size(), to);
    for (std::size_t i; (i = text.find("\"data/")) != std::string::npos;)
      text.replace(i, 6, "\"" MILLSTAND_SOURCE_DIR "/cases/data/");
    write_atomically(path, text);
    return refusals([&] { read_case(path); });
  }
};
}  // namespace

TEST_F(OneTypo, ATypoInASectionIsOneError)
{
  EXPECT_EQ(with("[backup_roll]", "[backup_rol]"), "unknown section [backup_rol]; did you mean 'backup_roll'?");
  EXPECT_EQ(with("[frame] ", "[fraem] "), "unknown section [fraem]; did you mean 'frame'?");
  EXPECT_EQ(with("[strip]", "[stripp]"), "unknown section [stripp]; did you mean 'strip'?");
  EXPECT_EQ(with("[contact.upper]", "[contact.uper]"), "unknown key 'uper' in [contact]; did you mean 'upper'?");
  EXPECT_EQ(with("[upper]", "[uper]", "cases/two-cylinders.toml"),
            "unknown section [uper]; did you mean 'upper'?");
}

TEST_F(OneTypo, ATypoInAKeyIsOneError)
{
  EXPECT_EQ(with("barrel_length    = \"1400 mm\"", "barrel_lenght    = \"1400 mm\""),
            "unknown key 'barrel_lenght' in [work_roll]; did you mean 'barrel_length'?");
  EXPECT_EQ(with("rollers_per_row   = 39", "roller_per_row   = 39"),
            "unknown key 'roller_per_row' in [bearing.trb]; did you mean 'rollers_per_row'?");
  EXPECT_EQ(with("k = \"28 MPa\"", "kk = \"28 MPa\""),
            "unknown key 'kk' in [strip.flow_stress]; did you mean 'k'?");
  EXPECT_EQ(with("name           = \"pass 1\"", "nmae           = \"pass 1\""),
            "unknown key 'nmae' in [pass.0]; did you mean 'name'?");
  EXPECT_EQ(with("kind   =", "kidn   ="), "unknown key 'kidn' in the top level; did you mean 'kind'?");
  EXPECT_EQ(with("title  =", "titel  ="), "unknown key 'titel' in the top level; did you mean 'title'?");
}

// What stands under the mistyped name is checked in the same go.
TEST_F(OneTypo, TheValueUnderItIsCheckedToo)
{
  EXPECT_EQ(with("barrel_length    = \"1400 mm\"", "barrel_lenght    = \"1400 kg\""),
            "unknown key 'barrel_lenght' in [work_roll]; did you mean 'barrel_length'?\n"
            "work_roll.barrel_length = \"1400 kg\" is a mass; a length is needed, for example \"1400 mm\"");
}

// A second key of the same name is not a typo of the first.
TEST_F(OneTypo, ATypoOfANameThatIsAlsoGivenStaysUnknown)
{
  EXPECT_EQ(with("crown            = \"0 um\"", "crown = \"0 um\"\ncrwon = \"1 kg\""),
            "unknown key 'crwon' in [work_roll]; did you mean 'crown'?");
}

// A damaged file may hold a hundred thousand names: for those that are not shown no suggestion is computed.
TEST_F(OneTypo, SuggestionsStopWhereNothingIsShown)
{
  std::string text = "schema = 1\nkind = \"four-high\"\n[work_roll]\n";
  for (int i = 0; i < 5000; ++i)
    text += "barrel_diametr" + std::to_string(i) + " = 1\n";
  write_atomically(path, text);
  try {
    read_case(path);
    FAIL() << "accepted";
  } catch (const InputError &error) {
    int unknown = 0, suggested = 0;
    for (const Problem &problem : error.problems)
      if (problem.message.rfind("unknown key 'barrel_diametr", 0) == 0) {
        ++unknown;
        suggested += problem.message.find("did you mean 'barrel_diameter'?") != std::string::npos;
      }
    EXPECT_EQ(unknown, 5000);
    EXPECT_GE(suggested, 50) << "as many as are shown";
    EXPECT_LE(suggested, 200);
  }
}

// One table names every key that was removed, with its successor or the version that dropped it.
TEST_F(OneTypo, ARemovedKeySaysWhatBecameOfIt)
{
  for (const RemovedKey &removed : removed_keys()) {
    const std::string note = removal_note(removed.key);
    EXPECT_NE(note.find(removed.last_version), std::string::npos) << removed.key;
    EXPECT_NE(note.find(removed.remedy), std::string::npos) << removed.key;
    EXPECT_NE(note.find(removed.successor), std::string::npos) << removed.key;
  }
  EXPECT_EQ(removal_note("barrel_diameter"), "");
  EXPECT_EQ(with("bearing_span     = ", "tilt_lever = \"full\"\nbearing_span     = ").substr(0, 60),
            "unknown key 'tilt_lever' in [work_roll]; it was dropped afte");
}

// Each letter that only one of two words has costs a slip, and a table of distances ends where the limit is
// reached.
TEST(NearestWord, IsTheSameAsWithoutTheShortcuts)
{
  const std::vector<std::string> known{
      "barrel_diameter", "barrel_length", "neck_diameter", "bearing_span", "k", "at"};
  const auto by_full_tables = [&](const std::string &word) {
    std::string best;
    std::size_t fewest = word.size() == 2 ? 2 : word.size() / 3 + 1;
    for (const std::string &candidate : known)
      if (const std::size_t slips = slips_between(word, candidate); slips < fewest) {
        fewest = slips;
        best   = candidate;
      }
    return best;
  };
  std::mt19937 random(7);
  int with_a_neighbour = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string word = known[random() % known.size()];
    for (unsigned n = random() % 6; n > 0 && !word.empty(); --n) {
      const std::size_t place = random() % word.size();
      if (random() % 3 == 0)
        word.erase(place, 1);
      else if (random() % 2 == 0)
        word.insert(place, 1, char('a' + random() % 26));
      else
        std::swap(word[place], word[random() % word.size()]);
    }
    with_a_neighbour += !by_full_tables(word).empty();
    ASSERT_EQ(nearest_word(word, known), by_full_tables(word)) << word << ", seed 7, word " << i;
  }
  EXPECT_GT(with_a_neighbour, 1000);
}

TEST_F(OneTypo, AMegabyteOfUnknownKeysIsReadInASecond)
{
  std::string keys;
  for (int i = 0; keys.size() < 1000000; ++i)
    keys += "barrel_diameter_of_" + std::to_string(i) + " = 1\n";
  const auto begin        = std::clock();
  const std::string error = with("upper_post_mass", keys + "upper_post_mass");
  EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 3.0)
      << "seconds of a processor; one in the release build, twenty before";
  EXPECT_NE(error.find("unknown key 'barrel_diameter_of_0' in [frame]"), std::string::npos);
}
