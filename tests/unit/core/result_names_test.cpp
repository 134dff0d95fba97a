#include "core/records/chain_results.h"
#include "core/records/result_names.h"
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <stdexcept>

using namespace mill;

TEST(ResultNames, ArePutTogetherFromParts)
{
  EXPECT_EQ(result_name({family::bite, "pass 1", "", "force"}), "bite.pass 1.force");
  EXPECT_EQ(spring_of_contact("lower"), "K5");
  EXPECT_EQ(spring_of_contact("line"), "contact.line");
}

TEST(Checks, ChecksAreFoundByTheirId)
{
  const std::vector<Check> checks{
      check(CheckId::johnson_secant, 2, "upper end"), {"Foeppl (3.8)", 3, ""}, check(CheckId::published_model, 4)};
  ASSERT_TRUE(find_check(checks, CheckId::johnson_secant));
  EXPECT_EQ(find_check(checks, CheckId::johnson_secant)->note, "upper end");
  EXPECT_EQ(value_beside(checks, CheckId::published_model), 4);
  EXPECT_TRUE(std::isnan(value_beside(checks, CheckId::published))) << "the whole name, not its beginning";
  EXPECT_EQ(find_published(checks)->value, 4);
  std::set<std::string> names;
  for (int id = 0; id <= int(CheckId::stepped_beams); ++id)
    EXPECT_TRUE(names.insert(name_of(CheckId(id))).second) << name_of(CheckId(id)) << " represents two checks";
}

TEST(Curves, EveryKindIsRecognisedByTheNameOfItsFile)
{
  for (const CurveKind *kind : curve::all)
    for (const std::string item : {"upper", "pass-1", "2"}) {
      const std::string quantity = *kind->ending && std::string(kind->ending).back() == '-' ? "tension" : "";
      const std::string path     = curve_path(*kind, item, quantity);
      const auto name            = curve_name(path);
      ASSERT_TRUE(name) << path;
      EXPECT_EQ(name->kind, kind) << path;
      EXPECT_EQ(name->item, item) << path;
      EXPECT_EQ(name->of, quantity) << path;
    }
  EXPECT_EQ(curve_path(curve::contact_barrel_mirrored, "upper"), "curves/contact-upper-barrel-mirrored");
  EXPECT_EQ(curve_path(curve::chatter_map, "2", "tension"), "curves/chatter-2-map-tension");
  EXPECT_EQ(curve_path(curve::modes), "curves/modes");
  EXPECT_EQ(curve_path(curve::bite_arc, "pass-1", "fe"), "curves/bite-pass-1.fe");
  EXPECT_FALSE(curve_name("curves/chatter-2-anything"));
  EXPECT_FALSE(curve_name("curves/poles"));
}

TEST(Curves, ColumnsAreThoseOfTheKind)
{
  Table table;
  for (const CurveColumn &column : curve::of_barrel)
    if (*column.name)
      table.add(column.name, column.unit, Eigen::Vector2d(1, 2));
  EXPECT_NO_THROW(require_columns(curve::contact_barrel, table));
  EXPECT_THROW(require_columns(curve::contact, table), std::logic_error) << "other names";
  table.add("roughness", "m", Eigen::Vector2d(1, 2));
  EXPECT_THROW(require_columns(curve::contact_barrel, table), std::logic_error) << "one too many";
  EXPECT_THROW(require_columns(curve::contact_barrel, Table()), std::logic_error) << "none at all";
}

TEST(ResultNames, ASpringHasTheResultThatARunSolves)
{
  const auto solved = [](const char *number) {
    const auto name = solved_result_of(number);
    return name ? name->text() : "";
  };
  EXPECT_EQ(solved("K3"), "K3.tangent");
  EXPECT_EQ(solved("K5"), "K5.tangent");
  EXPECT_EQ(solved("K4"), "K4.combined");
  EXPECT_EQ(solved("Kzc4"), "Kzc4.tangent");
  for (const char *other : {"K1", "M3", "K_ZW", "K3.tangent", ""})
    EXPECT_EQ(solved(other), "") << other;
}
