#include "app/run/run_kind.h"
#include "core/base/files.h"
#include "core/case/input_reference.h"
#include "core/case/kinds.h"
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

// The tables of the kinds of case, walked row by row: a new kind with a missing entry fails here.
namespace {
using namespace mill;

Case case_of(const std::string &kind)
{
  const std::string path = (std::filesystem::path(testing::TempDir()) / ("kind-" + kind + ".toml")).string();
  write_atomically(path, template_of(kind));
  return read_case(path);
}
}  // namespace

TEST(CaseKinds, EveryKindHasARowInTheTableOfRuns)
{
  const std::vector<Verb> verbs{Verb::run,   Verb::stiffness, Verb::masses,
                                Verb::modes, Verb::chatter,   Verb::simulate};
  for (const CaseKind *kind : all_kinds()) {
    const Case the_case = case_of(kind->name);
    const RunKind &row  = run_kind(the_case);
    EXPECT_EQ(&kind_of(the_case), kind) << kind->name;
    EXPECT_EQ(row.verbs.at(0), Verb::run) << kind->name;
    for (const Verb verb : row.verbs)
      EXPECT_EQ(std::count(verbs.begin(), verbs.end(), verb), 1) << kind->name << " " << word_of(verb);
    EXPECT_TRUE(row.stages && row.run && row.describe && row.trace) << kind->name;
    EXPECT_FALSE(row.stages(the_case).empty()) << kind->name;
  }
}

TEST(CaseKinds, EveryRepeatedSectionStatesItsNumber)
{
  for (const CaseKind *kind : all_kinds()) {
    const Case the_case = case_of(kind->name);
    for (const SectionRows &section : kind->sections) {
      const auto names = repeated_sections(the_case, section.name);
      if (section.repeat == SectionRows::Repeat::once || !section.needed)
        continue;
      EXPECT_FALSE(names.empty()) << kind->name << " " << section.name;
    }
  }
}

TEST(CaseKinds, NotesOfATemplateBelongToItsSections)
{
  for (const CaseKind *kind : all_kinds())
    for (const TemplateNote &note : kind->notes)
      EXPECT_TRUE(std::any_of(kind->sections.begin(), kind->sections.end(),
                              [&](const SectionRows &section) { return section.id() == note.section; }))
          << kind->name << " " << note.section;
}

TEST(CaseKinds, BearingsAndPassesAreThoseOfTheCase)
{
  EXPECT_EQ(all_bearings(case_of("four-high")).size(), 2u);
  EXPECT_EQ(all_passes(case_of("four-high")).size(), 1u);
  EXPECT_EQ(all_passes(case_of("bite")).size(), 1u);
  EXPECT_TRUE(all_bearings(case_of("lumped")).empty());
  EXPECT_TRUE(all_passes(case_of("chatter")).empty());
}
