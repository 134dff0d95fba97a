// results.json as the contract describes it, read back by a JSON parser.
#include "core/records/results.h"
#include "core/records/rows_of_contact.h"
#include "tests/support/near.h"
#include <nlohmann/json.hpp>
#include <tuple>

using namespace mill;

namespace {
Results sample()
{
  Results results;
  Parameter k3;
  k3.value          = 1.0 / 3.0 * 1e11;
  k3.method         = "contact FEM";
  k3.at             = at_force(976.2e3);
  k3.error_estimate = 0.004;
  k3.inputs         = {"work_roll.barrel_diameter", "backup_roll.barrel_diameter"};
  k3.checks         = {{"Hertz line contact", 4.0192e10, "infinitely long"}};
  results.add(row::roll_contact::tangent.of("", "K3"), k3);  // the unit is that of the row
  Parameter unknown;
  unknown.unit   = "N/m";
  unknown.source = Source::assumed;
  results.append({{"A.first.in.the.alphabet", unknown}});
  results.warnings    = {{WarningId::force_band,
                          "pass 1",
                          "the record ends early",
                          "peaks are low",
                          "filter less",
                          {"pass 1"},
                          "pass.0.force",
                          {"cases/a.toml", 7, 9}}};
  results.assumptions = {"bearing load F/20"};
  return results;
}
}  // namespace

TEST(Results, JsonHasEveryPart)
{
  const auto json = nlohmann::json::parse(results_json(sample(), "four-high-1400", "ok"));
  EXPECT_EQ(json.at("schema"), 1);
  EXPECT_EQ(json.at("case"), "four-high-1400");
  EXPECT_EQ(json.at("status"), "ok");
  const auto &k3 = json.at("values").at("K3.tangent");
  EXPECT_EQ(k3.at("value").get<double>(), 1.0 / 3.0 * 1e11);  // all digits
  EXPECT_EQ(k3.at("unit"), "N/m");
  EXPECT_EQ(k3.at("source"), "computed: contact FEM");
  EXPECT_EQ(k3.at("at"), "976.2 kN");
  ASSERT_EQ(k3.at("at_values").size(), 1u);
  EXPECT_EQ(k3.at("at_values").at(0).at("value"), 976.2e3);
  EXPECT_EQ(k3.at("at_values").at(0).at("unit"), "N");
  EXPECT_EQ(k3.at("error_estimate"), 0.004);
  EXPECT_EQ(k3.at("inputs").size(), 2u);
  EXPECT_EQ(k3.at("checks").at(0).at("name"), "Hertz line contact");
  EXPECT_EQ(k3.at("checks").at(0).at("value"), 4.0192e10);
  EXPECT_EQ(k3.at("checks").at(0).at("note"), "infinitely long");
  EXPECT_EQ(json.at("warnings").at(0), "pass 1: the record ends early: peaks are low; filter less");
  const auto &record = json.at("warning_records").at(0);
  EXPECT_EQ(record.at("id"), "force-band");
  EXPECT_EQ(record.at("fact"), "the record ends early");
  EXPECT_EQ(record.at("remedy"), "filter less");
  EXPECT_EQ(record.at("concerns").at(0), "pass 1");
  EXPECT_EQ(record.at("key"), "pass.0.force");
  EXPECT_EQ(record.at("place").at("line"), 7);
  EXPECT_EQ(record.at("place").at("file"), "a.toml") << "not the way to it";
  EXPECT_EQ(json.at("assumptions").at(0), "bearing load F/20");
}

TEST(Results, UnknownNumbersAreNull)
{
  const auto json  = nlohmann::json::parse(results_json(sample(), "x", "ok"));
  const auto &none = json.at("values").at("A.first.in.the.alphabet");
  EXPECT_TRUE(none.at("value").is_null());
  EXPECT_TRUE(none.at("error_estimate").is_null());
  EXPECT_EQ(none.at("source"), "assumed");
  EXPECT_EQ(none.at("at"), "");
  EXPECT_FALSE(none.contains("at_values"));
}

TEST(Results, OrderIsThatOfTheComputation)
{
  const std::string text = results_json(sample(), "x", "ok");
  EXPECT_LT(text.find("K3.tangent"), text.find("A.first.in.the.alphabet"));
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Results, ResultsAreFoundByName)
{
  const Results results = sample();
  ASSERT_NE(results.find("K3.tangent"), nullptr);
  EXPECT_EQ(results.find("K3.tangent")->at.text(), "976.2 kN");
  EXPECT_EQ(results.find("K3"), nullptr);
}

TEST(Results, BytesThatAreNotUtf8DoNotBreakTheFile)
{
  Results results;
  results.warnings = {warning_of_text("a name with a stray byte: \xff")};
  EXPECT_NO_THROW(std::ignore = nlohmann::json::parse(results_json(results, "\xc3", "ok")));
}

TEST(Results, ANameTwiceIsNoticedInEveryBuild)
{
  Results results = sample();
  EXPECT_THROW(results.add(row::roll_contact::tangent.of("", "K3"), Parameter{}), std::logic_error);
  EXPECT_EQ(results.values.size(), 2u);
}
