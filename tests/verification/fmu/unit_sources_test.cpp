// The sources of a unit, compiled as an importer compiles them.
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/unit_archive.h"
#include "tests/support/unit_client.h"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace fs = std::filesystem;
using namespace mill;

namespace {
// A folder with the sources of a unit, and all of them but the interfaces in one file, which is quicker to
// compile.
std::string unpacked_sources(const std::string &identifier)
{
  fmu::ExportedModel model = sample_stand().model;
  model.identifier         = identifier;
  const fs::path folder    = fs::path(testing::TempDir()) / ("sources-" + identifier);
  fs::create_directories(folder);
  std::ofstream together(folder / "together.cc");
  for (const auto &entry : fmu::entries_of(fmu::unit_archive(model, 3))) {
    if (entry.name.rfind("sources/", 0) != 0)
      continue;
    const std::string name = entry.name.substr(8);
    std::ofstream(folder / name) << entry.bytes;
    if (fs::path(name).extension() == ".cpp" && name.rfind("fmi", 0) != 0)
      together << "#include \"" << name << "\"\n";
  }
  return folder.string();
}

void compile(const std::string &folder, const std::string &files, const std::string &options)
{
  const std::string command =
      "cd '" + folder + "' && " CXX_COMPILER " -std=c++17 -O0 -fPIC -c -w " + options + " " + files;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
}

std::set<std::string> symbols_of(const std::string &folder, const std::string &object)
{
  std::set<std::string> names;
  const std::string list = folder + "/" + object + ".txt";
  EXPECT_EQ(std::system(("nm --defined-only --extern-only '" + folder + "/" + object +
                         "' | awk '{ print $2, $3 }' >'" + list + "'")
                            .c_str()),
            0);
  std::ifstream file(list);
  for (std::string kind, name; file >> kind >> name;)
    if (kind != "W" && kind != "V" &&
        kind != "u")  // templates and inline functions of the standard library may repeat
      names.insert(name);
  return names;
}
}  // namespace

// Two units in one program: no name is defined twice.
TEST(UnitSources, HaveThePrefixOfTheUnitForStaticLinking)
{
  const std::string folder = unpacked_sources("left_stand");
  compile(folder, "together.cc fmi2.cpp fmi3.cpp fmi3_refused.cpp", "");
  int functions = 0;
  for (const char *object : {"together.o", "fmi2.o", "fmi3.o", "fmi3_refused.o"})
    for (const std::string &name : symbols_of(folder, object)) {
      EXPECT_NE(name.find("left_stand_"), std::string::npos) << object << ": " << name;
      functions += name.rfind("left_stand_fmi", 0) == 0;
    }
  EXPECT_EQ(functions, 34 + 75);
}

TEST(UnitSources, HavePlainNamesForASharedLibrary)
{
  const std::string folder = unpacked_sources("right_stand");
  compile(folder, "fmi2.cpp", "-DFMI2_OVERRIDE_FUNCTION_PREFIX");
  compile(folder, "fmi3_refused.cpp", "-DFMI3_OVERRIDE_FUNCTION_PREFIX");
  EXPECT_EQ(symbols_of(folder, "fmi2.o").count("fmi2DoStep"), 1u);
  EXPECT_EQ(symbols_of(folder, "fmi3_refused.o").count("fmi3SetTime"), 1u);
}
