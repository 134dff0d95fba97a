// Notes of advise, calibrate and analyse: ids, text from parts, records in JSON.
#include "core/base/note.h"
#include "core/records/note_records.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

using namespace mill;

TEST(Notes, EveryIdHasOneRowWithAWordThatNoWarningHas)
{
  std::set<std::string> words;
  for (const NoteRow &row : note_rows()) {
    const std::string word = row.word;
    EXPECT_EQ(id_of(Note(row.id, "", "what is so")), word);
    EXPECT_EQ(word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos) << word;
    EXPECT_TRUE(words.insert(word).second) << word;
    EXPECT_EQ(warning_named(word), WarningId::text_only) << word;
    EXPECT_GT(std::string(row.meaning).size(), 10u) << word;
  }
  EXPECT_EQ(note_rows().back().id, NoteId::band_not_resolved) << "the last enumerator";
}

TEST(Notes, TextIsJoinedAsThatOfAWarning)
{
  EXPECT_EQ(
      text_of(Note(NoteId::error_not_stated, "", "no error is stated for K2", "10 % are assumed", "state one")),
      "no error is stated for K2: 10 % are assumed; state one");
  EXPECT_EQ(text_of(Note("contacts follow the rolling force")), "contacts follow the rolling force");
  EXPECT_EQ(text_of(Note(Warning{WarningId::record_gap, "speed", "3 samples are missing"})),
            "speed: 3 samples are missing");
}

TEST(Notes, RecordsHoldWhatDecidesSomethingAndTextsAll)
{
  nlohmann::ordered_json document;
  write_notes(document,
              {"a remark",
               {NoteId::torque_not_limited, "", "no limit is given", "", "", {}, "advice.torque_rise"},
               Warning{WarningId::record_gap, "speed", "samples are missing", "", "", {}, "", {"x/y.csv", 3}}});
  EXPECT_EQ(document["notes"],
            (nlohmann::ordered_json{"a remark", "no limit is given", "speed: samples are missing"}));
  ASSERT_EQ(document["note_records"].size(), 2u);
  const auto &first = document["note_records"][0], &second = document["note_records"][1];
  EXPECT_EQ(first["id"], "torque-not-limited");
  EXPECT_EQ(first["fact"], "no limit is given");
  EXPECT_EQ(first["key"], "advice.torque_rise");
  EXPECT_EQ(second["id"], "record-gap");
  EXPECT_EQ(second["subject"], "speed");
  EXPECT_EQ(second["place"]["file"], "y.csv");
  std::vector<std::string> members;
  for (const auto &[name, value] : first.items())
    members.push_back(name);
  EXPECT_EQ(members, (std::vector<std::string>{"id", "subject", "fact", "detail", "remedy", "concerns", "key",
                                               "place", "related"}));
}
