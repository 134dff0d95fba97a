#include "verify/manual.h"
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

// Every case of the manual passes, and docs/verification.md shows it with the numbers it is judged by now.
using namespace mill::verify;

namespace {
std::string manual_section(const std::string &name)
{
  std::ifstream in(std::string(MILLSTAND_SOURCE_DIR) + "/docs/verification.md");
  std::stringstream text;
  text << in.rdbuf();
  const std::string page = text.str(), head = "\n## " + name + "\n";
  const auto begin = page.find(head);
  if (begin == std::string::npos)
    return "";
  return page.substr(begin, page.find("\n## ", begin + 1) - begin);
}

// Rows of the page without the result: what the check is judged by.
void expect_on_the_page(const Outcome &outcome)
{
  const std::string section = manual_section(outcome.page.name);
  for (const Check &check : outcome.checks) {
    const CheckText t      = check_text(check);
    const auto row         = section.find("\n| " + table_cell(t.quantity) + " | ");
    const auto end         = section.find('\n', row + 1);
    const std::string text = row == std::string::npos ? "" : section.substr(row, end - row);
    EXPECT_NE(text.find(" | " + t.unit + " | " + t.reference + " | "), std::string::npos)
        << "docs/verification.md is out of date: " << outcome.page.name << ", " << t.quantity
        << "; write it again with "
        << "millstand verify --markdown docs/verification.md";
    EXPECT_NE(text.find(" | " + t.tolerance + " | " + t.verdict + " |"), std::string::npos)
        << "docs/verification.md is out of date: " << outcome.page.name << ", " << t.quantity;
  }
}

void expect_passes(const std::vector<Case> &family)
{
  for (const Case &c : family) {
    const Outcome outcome = run(c);
    EXPECT_TRUE(passes(outcome)) << outcome_text(outcome);
    expect_on_the_page(outcome);
  }
}
}  // namespace

TEST(Manual, ClosedForms)
{
  expect_passes(closed_forms());
}

TEST(Manual, HalfSpaceCases)
{
  expect_passes(half_space_cases());
}

TEST(Manual, SectionCases)
{
  expect_passes(section_cases());
}

TEST(Manual, SolidCases)
{
  expect_passes(solid_cases());
}

TEST(Manual, FrictionCases)
{
  expect_passes(friction_cases());
}

TEST(Manual, NonlinearCases)
{
  expect_passes(nonlinear_cases());
}

TEST(Manual, RollCases)
{
  expect_passes(roll_cases());
}

TEST(Manual, BearingCases)
{
  expect_passes(bearing_cases());
}

TEST(Manual, RollerCases)
{
  expect_passes(roller_cases());
}

TEST(Manual, RingCases)
{
  expect_passes(ring_cases());
}

TEST(Manual, SlabCases)
{
  expect_passes(slab_cases());
}

TEST(Manual, InhomogeneousCases)
{
  expect_passes(inhomogeneous_cases());
}

TEST(Manual, ElasticArcCases)
{
  expect_passes(elastic_arc_cases());
}

TEST(Manual, StripFlowCases)
{
  expect_passes(strip_flow_cases());
}

TEST(Manual, StripElasticCases)
{
  expect_passes(strip_elastic_cases());
}

TEST(Manual, RollArcCases)
{
  expect_passes(roll_arc_cases());
}

TEST(Manual, MassCases)
{
  expect_passes(mass_cases());
}

TEST(Manual, ComponentCases)
{
  expect_passes(component_cases());
}

TEST(Manual, HousingCases)
{
  expect_passes(housing_cases());
}

TEST(Manual, ChatterStandCases)
{
  expect_passes(chatter_stand_cases());
}

TEST(Manual, ChatterMotionCases)
{
  expect_passes(chatter_motion_cases());
}

TEST(Manual, ChatterSensitivityCases)
{
  expect_passes(chatter_sensitivity_cases());
}

TEST(Manual, ChatterTandemCases)
{
  expect_passes(chatter_tandem_cases());
}
