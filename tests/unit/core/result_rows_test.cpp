// Rows of the results: names, places, meanings, and what they cite.
#include "core/base/files.h"
#include "core/base/name_part.h"
#include "core/records/open_rows.h"
#include "core/records/result_place.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_chatter.h"
#include "core/records/rows_of_cluster.h"
#include "core/records/rows_of_contact.h"
#include "core/records/rows_of_stand.h"
#include <gtest/gtest.h>
#include <set>

using namespace mill;

namespace {
const std::string tree = MILLSTAND_SOURCE_DIR;

template <class Visit> void each_row(const Visit &visit)
{
  for (const RowGroup &group : row_groups())
    for (const ResultRow *row : group.rows)
      visit(*row);
}

std::string theory_text()
{
  std::string all;
  for (const std::string &name : names_in(tree + "/docs/theory"))
    all += read_text(tree + "/docs/theory/" + name);
  return all;
}
}  // namespace

TEST(ResultRows, ANameIsMadeOfItsPartsAndTakenApartAgain)
{
  EXPECT_EQ(row::contact::half_width.of("upper").text(), "contact.upper.half_width");
  EXPECT_EQ(row::roll_contact::tangent.of("", "K3").text(), "K3.tangent") << "what is in brackets may be left out";
  EXPECT_EQ(row::roll_contact::tangent.of("pass 2", "K3").text(), "pass 2.K3.tangent");
  EXPECT_EQ(row::stand::modulus_kiss.of("pass 2").text(), "stand.pass 2.modulus.kiss");
  const auto id = result_id("stand.pass 2.modulus.kiss");
  ASSERT_TRUE(id);
  EXPECT_TRUE(id->is_of(row::stand::modulus_kiss));
  EXPECT_EQ(id->place("pass"), "pass 2");
  EXPECT_EQ(result_id("stand.modulus.kiss")->place("pass"), "");
  EXPECT_FALSE(result_id("contact.sideways.half_width")) << "a contact of this name does not exist";
  EXPECT_FALSE(result_id("K8"));
  EXPECT_FALSE(result_id(""));
}

TEST(ResultRows, NamesOfTheUserMayHoldAnything)
{
  const std::string pass = name_part("2.0 mm/A");
  const auto id          = result_id(row::bite::force.of(pass));
  ASSERT_TRUE(id);
  EXPECT_TRUE(id->is_of(row::bite::force));
  EXPECT_EQ(id->place("pass"), pass);
  EXPECT_TRUE(is_made_by(row::chain::K3, row::chain::K3.of("open"))) << "a pass may have the word of a family";
}

TEST(ResultRows, TheRowThatKnowsMoreOfTheWordsIsTaken)
{
  EXPECT_TRUE(is_made_by(row::bite_fit::number, "bite.fit.friction")) << "and not the friction of a pass \"fit\"";
  EXPECT_TRUE(is_made_by(row::bite_fit::misfit, "bite.fit.misfit"));
  EXPECT_TRUE(is_made_by(row::bite_fit::number_low, "bite.fit.friction_low"));
  EXPECT_TRUE(is_made_by(row::cluster::contact_force, "cluster.1.W-I.force"));
  EXPECT_TRUE(is_made_by(row::cluster::force, "cluster.1.force"));
  const auto fit = result_id("cluster.fit.N.support.E.stiffness");
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->is_of(row::cluster::fit));
  EXPECT_EQ(fit->place("key"), "support.E.stiffness") << "a key keeps its points";
  EXPECT_EQ(result_id("chatter.2.speed_slope.oil.friction.mu1")->place("key"), "oil.friction.mu1");
}

TEST(ResultRows, WithoutARowANameIsOfItsFamily)
{
  const auto spring = result_id_or_open("Kzc.something_new");
  ASSERT_TRUE(spring);
  EXPECT_TRUE(spring->is_of(row::open::one_bearing));
  EXPECT_FALSE(result_id("Kzc.something_new"));
  EXPECT_EQ(meaning_of_result("Kzc.something_new"), "");
  const auto of_model = result_id_or_open("bite.pass 1.karman.something_new");
  ASSERT_TRUE(of_model);
  EXPECT_TRUE(of_model->is_of(row::open::bite_model));
  EXPECT_EQ(of_model->place("pass"), "pass 1");
  EXPECT_TRUE(result_id_or_open("bite.1.karman.some.thing")->is_of(row::open::below_bite_model));
  EXPECT_TRUE(result_id_or_open("bite.fit.some.thing")->is_of(row::open::bite_fit)) << "not of a pass \"fit\"";
  EXPECT_TRUE(result_id_or_open("bearing.trb.film.new")->is_of(row::open::film)) << "before the rating";
  EXPECT_EQ(result_id_or_open("chatter.2.of.another.version")->place("pass"), "2");
  EXPECT_TRUE(result_id_or_open("contact.upper.half_width")->is_of(row::contact::all)) << "a row of its own first";
  EXPECT_FALSE(result_id_or_open("something.else.entirely.new"));
}

TEST(ResultRows, EveryRowHasAMeaningAndCitesWhatExists)
{
  const std::string theory = theory_text();
  std::set<std::string> names;
  std::size_t seen = 0;
  each_row([&](const ResultRow &row) {
    ++seen;
    EXPECT_TRUE(names.insert(row.name).second) << row.name << " has two rows";
    EXPECT_GT(std::string(row.meaning).size(), 5u) << row.name;
    const std::string cited  = row.theory;
    const std::string needle = cited.find('.') == std::string::npos ? "# " + cited + ". " : "\\tag{" + cited + "}";
    EXPECT_NE(theory.find(needle), std::string::npos) << row.name << " cites " << cited;
    for (const std::string &name : names_on_page(row)) {
      const auto id = result_id(name);
      ASSERT_TRUE(id) << name;
      EXPECT_TRUE(id->is_of(row)) << name << " is taken for " << id->row->name;
      EXPECT_EQ(meaning_of(*id).find('{'), std::string::npos)
          << meaning_of(*id) << " names a place without a part";
    }
  });
  EXPECT_GT(seen, 250u);
}

// A row that no group lists has neither page nor meaning.
TEST(ResultRows, EveryRowOfTheHeadersIsInAGroup)
{
  std::size_t declared = 0, listed = 0;
  for (const std::string &name : names_in(tree + "/core/records"))
    if (name.rfind("rows_of_", 0) == 0) {
      const std::string text = read_text(tree + "/core/records/" + name);
      for (auto i = text.find("constexpr RowOf<"); i != std::string::npos;
           i      = text.find("constexpr RowOf<", i + 1))
        ++declared;
    }
  each_row([&](const ResultRow &) { ++listed; });
  EXPECT_EQ(declared, listed);
}

TEST(ResultRows, PlacesAreShownInWords)
{
  EXPECT_EQ(meaning_of_result("K3.curvature"),
            "upper backup roll on upper work roll, curvature d\u00b2F/d\u03b4\u00b2 of force over approach");
  EXPECT_EQ(meaning_of_result("pass 2.Kzc1_across"),
            "pass 2, one bearing of the upper backup roll, across its load");
  EXPECT_EQ(meaning_of_result("open.craig-bampton.f3"),
            "open stand, without the strip between the work rolls, stand with rolls as reduced finite elements, "
            "natural frequency 3");
  EXPECT_EQ(meaning_of_result("bite.1.karman.force"), "bite, 1, K\u00e1rm\u00e1n's slab, roll force");
  EXPECT_EQ(meaning_of_result("something.else.entirely.new"), "");
  EXPECT_TRUE(is_any_name("PASS"));
  EXPECT_FALSE(is_any_name("K3"));
}
