// [plant] of a case: the mains, and what is refused word for word.
#include "core/case/plant.h"
#include "core/model/case.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace mill;

namespace {
// A case of given masses and springs with these lines at its end.
std::string case_with(const std::string &lines)
{
  const std::string path = testing::TempDir() + "millstand_plant_test.toml";
  std::ofstream out(path);
  out << "schema = 1\nkind = \"lumped\"\n[given]\n";
  for (int i = 1; i <= 6; ++i)
    out << "M" << i << " = \"5000 kg\"\n";
  for (int i = 1; i <= 7; ++i)
    out << "K" << i << " = \"1e4 kN/mm\"\n";
  out << lines;
  return path;
}
}  // namespace

TEST(PlantSection, GivesTheMains)
{
  EXPECT_EQ(plant_of(case_with("[plant]\nmains = \"60 Hz\"\n")).mains, 60);
  EXPECT_TRUE(std::isnan(plant_of(case_with("")).mains)) << "both are tried";
}

TEST(PlantSection, RefusesMainsThatDoNotExist)
{
  try {
    read_case(case_with("[plant]\nmains = \"55 Hz\"\n"));
    FAIL() << "accepted";
  } catch (const InputError &error) {
    EXPECT_EQ(error.problems.at(0).message, "plant.mains = \"55 Hz\" must be \"50 Hz\" or \"60 Hz\"");
  }
}
