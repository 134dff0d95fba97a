// Warnings as records: ids, text from parts, JSON and back.
#include "core/base/warning.h"
#include "core/records/json_archive.h"
#include <gtest/gtest.h>
#include <set>

using namespace mill;

TEST(Warnings, EveryIdHasOneRowWithAStableWordAndAMeaning)
{
  std::set<std::string> words;
  for (const WarningRow &row : warning_rows()) {
    const std::string word = row.word;
    EXPECT_EQ(id_of(row.id), word);
    EXPECT_EQ(warning_named(word), row.id) << word;
    EXPECT_EQ(word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos) << word;
    EXPECT_TRUE(words.insert(word).second) << word;
    EXPECT_GT(std::string(row.meaning).size(), 10u) << word;
  }
  EXPECT_EQ(std::size_t(warning_rows().back().id) + 1, warning_rows().size());
  EXPECT_EQ(warning_rows().back().id, WarningId::not_kept) << "the last enumerator";
  EXPECT_EQ(warning_named("of-a-later-version"), WarningId::text_only);
}

TEST(Warnings, TextIsJoinedFromTheParts)
{
  Warning w{WarningId::bearing_yield, "bearing trb", "the raceway yields"};
  EXPECT_EQ(text_of(w), "bearing trb: the raceway yields");
  w.remedy = "take a larger one";
  EXPECT_EQ(text_of(w), "bearing trb: the raceway yields; take a larger one");
  w.detail = "stiffnesses end";
  EXPECT_EQ(text_of(w), "bearing trb: the raceway yields: stiffnesses end; take a larger one");
  w.subject = "";
  EXPECT_EQ(problem_of(w).message, "the raceway yields: stiffnesses end; take a larger one");
}

TEST(Warnings, JsonKeepsEveryPart)
{
  const Warning w{WarningId::bite_force,
                  "pass 1",
                  "a \"fact\"; with marks: in it",
                  "detail",
                  "remedy",
                  {"K4", "bite.pass 1"},
                  "pass.0.load",
                  {"a.toml", 12, 3},
                  {{"b.toml", 1, 2}}};
  const Warning back = record_of_json<Warning>(json_of_record(w));
  EXPECT_EQ(back, w);
  EXPECT_EQ(back.subject, w.subject);
  EXPECT_EQ(back.fact, w.fact);
  EXPECT_EQ(back.concerns, w.concerns);
  EXPECT_EQ(back.key, w.key);
  EXPECT_EQ(back.place.file, "a.toml");
  EXPECT_EQ(back.place.line, 12);
  EXPECT_EQ(back.place.column, 3);
  ASSERT_EQ(back.related.size(), 1u);
  EXPECT_EQ(back.related[0].line, 1);
}

// A later version may warn of more.
TEST(Warnings, AnUnknownIdIsReadAsText)
{
  const Warning w = record_of_json<Warning>("{\"id\": \"unheard-of\", \"fact\": \"what is so\"}");
  EXPECT_EQ(w.id, WarningId::text_only);
  EXPECT_EQ(text_of(w), "what is so");
}
