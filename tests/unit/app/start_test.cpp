// Whoever needs no finite elements does not wait for Gmsh and deal.II: they are a library of their own, opened
// with the first mesh (core/process/own_library.h).
#include "core/process/own_library.h"
#include "tests/support/program.h"
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace {
const fs::path program = MILLSTAND_PROGRAM, library = program.parent_path() / mill::finite_elements;

// s, the shortest of several starts.
double start_time(const std::string &before)
{
  double shortest = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(millstand("--help", MILLSTAND_SOURCE_DIR, before).exit_code, 0);
    shortest = std::min(shortest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return shortest;
}

// A run with finite elements by a copy of the program in `folder`, with nothing kept from before.
Outcome run_of_a_copy(const std::string &folder)
{
  fs::copy_file(program, folder + "/millstand", fs::copy_options::overwrite_existing);
  const std::string log = folder + "/err";
  const int status      = std::system(("cd '" MILLSTAND_SOURCE_DIR "' && '" + folder +
                                  "/millstand' run cases/two-cylinders.toml -q --fresh -o '" + folder +
                                  "/out' --cache '" + folder + "/cache' 2>'" + log + "'")
                                          .c_str());
  std::ifstream in(log);
  return {WEXITSTATUS(status), "", std::string(std::istreambuf_iterator<char>(in), {})};
}

std::string refusal(const std::string &folder, const std::string &why)
{
  return "error: the finite elements are a library in the folder of the program, '" + folder +
         "/millstand-fem.so', which cannot be used: " + why +
         "; install the package millstand-fem of the same version, or build both together (cmake "
         "--build --preset release --target millstand)\n";
}
}  // namespace

TEST(Start, OpensNeitherDealIINorGmshWhereNoMeshIsMade)
{
  const std::string out = scratch("start");
  for (const std::string &verb :
       {std::string("--help"), std::string("--version"), std::string("check cases/four-high-1400.toml"),
        "modes cases/published-1400.toml -q -o " + out, "simulate cases/published-1400.toml -q -o " + out}) {
    const Outcome outcome = millstand(verb, MILLSTAND_SOURCE_DIR, "export LD_DEBUG=files");
    EXPECT_EQ(outcome.exit_code, 0) << verb;
    EXPECT_NE(outcome.err.find("libstdc++.so"), std::string::npos) << verb << ": the loader says nothing";
    for (const char *name : {"libdeal", "libgmsh", mill::finite_elements})
      EXPECT_EQ(outcome.err.find(name), std::string::npos) << verb << " opens " << name;
  }
}

TEST(Start, StartIsFasterThanLoadingTheFiniteElements)
{
  // Loaded before the program begins, as they were when it was linked with them.
  const double with = start_time("export LD_PRELOAD='" + library.string() + "'"), without = start_time("true");
  EXPECT_LT(without, 0.25 * with) << without << " s against " << with << " s";
}

TEST(Start, AMissingLibraryIsNamed)
{
  const std::string folder = scratch("alone");
  const Outcome outcome    = run_of_a_copy(folder);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.err,
            refusal(folder, folder + "/millstand-fem.so: cannot open shared object file: No such file "
                                     "or directory"));
}

TEST(Start, RefusesALibraryOfAnotherBuild)
{
  const std::string folder = scratch("other");
  std::ofstream(folder + "/other.c") << "const char *const millstand_build = \"an earlier one\";\n"
                                        "void *millstand_mesher(void) { return 0; }\n"
                                        "void *millstand_on_mesh(void) { return 0; }\n";
  ASSERT_EQ(
      std::system(("cc -shared -fPIC -o '" + folder + "/millstand-fem.so' '" + folder + "/other.c'").c_str()), 0);
  const Outcome outcome = run_of_a_copy(folder);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.err, refusal(folder, "it is of another build"));
}

TEST(Start, AMissingProgramIsReportedWithItsBuildCommand)
{
  const std::string folder = scratch("handed_over");
  fs::copy_file(program, folder + "/millstand", fs::copy_options::overwrite_existing);
  const auto output_has = [&](const std::string &words) {
    const std::string log = folder + "/err";
    const int status      = std::system(
             ("cd '" MILLSTAND_SOURCE_DIR "' && '" + folder + "/millstand' " + words + " 2>'" + log + "'").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << words;
    std::ifstream in(log);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const auto refusal = [&](const std::string &what, const std::string &program) {
    return "error: " + what + " is carried out by a separate program, '" + folder + "/" + program +
           "', which cannot be started; build it with: cmake --build --preset release --target " + program + "\n";
  };
  const std::string stand = "cases/four-high-1400.toml", record = "any.csv";
  EXPECT_EQ(output_has("analyse " + record), refusal("millstand analyse", "millstand-all"));
  EXPECT_EQ(output_has("calibrate " + stand + " --measured " + record),
            refusal("millstand calibrate", "millstand-all"));
  EXPECT_EQ(output_has("advise " + stand), refusal("millstand advise", "millstand-all"));
  EXPECT_EQ(output_has("live " + stand + " --input " + record), refusal("millstand live", "millstand-all"));
  for (const char *file : {"analysis.json", "calibration.json", "advice.json"}) {
    std::ofstream(folder + "/" + file) << "{}";
    EXPECT_EQ(output_has("report '" + folder + "'"), refusal("the page of records", "millstand-all")) << file;
    fs::remove(folder + "/" + file);
  }
  EXPECT_EQ(output_has("export fmu " + stand), refusal("millstand export", "millstand-all"));
  EXPECT_EQ(output_has("chatter " + stand), refusal("millstand chatter", "millstand-all"));
  EXPECT_EQ(output_has("simulate " + stand + " --stream --force " + record),
            refusal("millstand simulate --stream", "millstand-all"));
  for (const char *verb : {"run ", "check "})
    EXPECT_EQ(output_has(verb + std::string("cases/chatter-two-stands.toml")),
              refusal("kind = \"chatter\"", "millstand-all"));
  EXPECT_EQ(output_has("trace cases/twenty-high.toml steel.youngs_modulus"),
            refusal("kind = \"cluster\"", "millstand-all"));
  EXPECT_EQ(output_has("verify"), refusal("the verification manual", "millstand-verify"));
}
