// The library in the archive: what it exports, what it needs, what its sources include.
#include "dynamics/fmu/embedded.h"
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace {
using namespace mill;

std::string output_of(const std::string &command)
{
  std::string text;
  FILE *pipe = popen(command.c_str(), "r");
  char block[4096];
  for (std::size_t n; (n = fread(block, 1, sizeof block, pipe)) > 0;)
    text.append(block, n);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return text;
}

std::string library()
{
  static const std::string path = [] {
    std::string file = testing::TempDir() + "/unit_library_test.so";
    std::ofstream(file, std::ios::binary) << fmu::named_file("linux64");
    return file;
  }();
  return path;
}

std::set<std::string> words_of(const std::string &text)
{
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

// Names of the standard, version 2: 34 functions for co-simulation.
const char *const names_2 =
    "GetTypesPlatform GetVersion Instantiate FreeInstance SetDebugLogging SetupExperiment EnterInitializationMode "
    "ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean GetString SetReal SetInteger SetBoolean "
    "SetString GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate "
    "GetDirectionalDerivative SetRealInputDerivatives GetRealOutputDerivatives DoStep CancelStep GetStatus "
    "GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus";
// Version 3: all 75.
const char *const names_3 =
    "GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation InstantiateScheduledExecution "
    "FreeInstance EnterInitializationMode ExitInitializationMode EnterEventMode Terminate Reset GetFloat32 "
    "GetFloat64 "
    "GetInt8 GetUInt8 GetInt16 GetUInt16 GetInt32 GetUInt32 GetInt64 GetUInt64 GetBoolean GetString GetBinary "
    "GetClock SetFloat32 SetFloat64 SetInt8 SetUInt8 SetInt16 SetUInt16 SetInt32 SetUInt32 SetInt64 SetUInt64 "
    "SetBoolean SetString SetBinary SetClock GetNumberOfVariableDependencies GetVariableDependencies GetFMUState "
    "SetFMUState FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState "
    "GetDirectionalDerivative "
    "GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode GetIntervalDecimal GetIntervalFraction "
    "GetShiftDecimal GetShiftFraction SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction "
    "EvaluateDiscreteStates UpdateDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep SetTime "
    "SetContinuousStates GetContinuousStateDerivatives GetEventIndicators GetContinuousStates "
    "GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode "
    "GetOutputDerivatives DoStep ActivateModelPartition";
}  // namespace

TEST(UnitLibrary, ExportsTheFunctionsOfBothVersionsAndNothingElse)
{
  std::set<std::string> wanted;
  for (const std::string &name : words_of(names_2))
    wanted.insert("fmi2" + name);
  EXPECT_EQ(wanted.size(), 34u);
  for (const std::string &name : words_of(names_3))
    wanted.insert("fmi3" + name);
  EXPECT_EQ(wanted.size(), 34u + 75u);
  EXPECT_EQ(words_of(output_of("nm -D --defined-only '" + library() + "' | awk '{ print $3 }'")), wanted);
}

TEST(UnitLibrary, NeedsLibcAndLibmAndNoPath)
{
  const std::string dynamic = output_of("readelf -d '" + library() + "'");
  EXPECT_EQ(dynamic.find("RPATH"), std::string::npos);
  EXPECT_EQ(dynamic.find("RUNPATH"), std::string::npos);
  std::set<std::string> needed;
  const std::regex shared(R"(\(NEEDED\).*\[([^\]]*)\])");
  for (std::sregex_iterator it(dynamic.begin(), dynamic.end(), shared), end; it != end; ++it)
    needed.insert((*it)[1]);
  for (const std::string &name : needed)
    EXPECT_TRUE(name == "libc.so.6" || name == "libm.so.6" || name.find("ld-linux") == 0) << name;
  EXPECT_EQ(needed.count("libm.so.6"), 1u);
}

// glibc 2.31 is that of Debian 11 and Ubuntu 20.04.
TEST(UnitLibrary, NeedsNoNewerGlibcThanTwoThirtyOneAndSaysWhich)
{
  std::pair<int, int> newest{0, 0};
  const std::string symbols = output_of("objdump -T '" + library() + "'");
  const std::regex version(R"(GLIBC_(\d+)\.(\d+))");
  for (std::sregex_iterator it(symbols.begin(), symbols.end(), version), end; it != end; ++it)
    newest = std::max(newest, {std::stoi((*it)[1]), std::stoi((*it)[2])});
  EXPECT_LE(newest, (std::pair{2, 31})) << symbols;
  EXPECT_GT(newest.first, 0);
  EXPECT_EQ(fmu::named_file("glibc"),
            "GLIBC_" + std::to_string(newest.first) + "." + std::to_string(newest.second));
}

TEST(UnitLibrary, SourcesIncludeThemselvesAndTheStandardLibrary)
{
  const std::regex include(R"(#include ([<"])([^>"]+)[>"])");
  std::set<std::string> files;
  for (const auto &file : fmu::source_files())
    files.insert(file.name);
  EXPECT_GT(files.size(), 20u);
  for (const auto &file : fmu::source_files()) {
    const std::string text = file.bytes();
    // Those of the runtime, the steps of a stand on curves, the laws of the strip.
    const std::string source = MILLSTAND_SOURCE_DIR;
    std::string expected;
    for (const char *folder : {"/dynamics/fmu/runtime/", "/dynamics/nonlinear/", "/core/laws/"})
      if (std::filesystem::exists(source + folder + file.name))
        expected += source + folder + file.name;
    EXPECT_EQ(text, [&] {
      std::ostringstream in;
      in << std::ifstream(expected).rdbuf();
      return in.str();
    }()) << file.name;
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
      const std::string name = (*it)[2];
      if ((*it)[1] == "\"")
        EXPECT_EQ(files.count(name), 1u) << file.name << " includes " << name;
      else
        EXPECT_TRUE(name.find('/') == std::string::npos &&
                    (name.find(".h") == std::string::npos || name == "windows.h"))
            << file.name << " includes " << name;
    }
  }
}

TEST(UnitLibrary, ForWindowsExportsTheSameFunctions)
{
  const std::string windows = fmu::named_file("win64");
  if (windows.empty())
    GTEST_SKIP() << "no compiler for Windows (g++-mingw-w64-x86-64-posix) when this program was built";
  EXPECT_EQ(windows.substr(0, 2), "MZ");
  for (const std::string &name : words_of(names_2))
    EXPECT_NE(windows.find(std::string("fmi2" + name + '\0')), std::string::npos) << name;
  for (const std::string &name : words_of(names_3))
    EXPECT_NE(windows.find(std::string("fmi3" + name + '\0')), std::string::npos) << name;
  for (const char *foreign : {"libstdc++", "libgcc", "libwinpthread"})
    EXPECT_EQ(windows.find(std::string(foreign) + "-"), std::string::npos) << foreign;
}
