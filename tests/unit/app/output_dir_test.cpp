// Whose results a folder holds: the case file that made it is known by its place, not by its name alone.
#include "app/run/output_dir.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "core/records/source_location.h"
#include "tests/support/program.h"
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>

namespace fs = std::filesystem;
using namespace mill;

namespace {
// What is said to a run of a case into a folder; empty where it may.
std::string refusal(const std::string &folder, const Case &the_case)
{
  try {
    const OutputDir out(folder, the_case, false, "id");
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}
}  // namespace

TEST(OutputDir, BelongsToOneCaseFileOfThatName)
{
  const std::string folder = scratch("output-dir"), out = folder + "/out";
  for (const char *mill : {"mill1", "mill2"}) {
    fs::create_directories(folder + "/" + mill);
    write_atomically(folder + "/" + mill + "/stand.toml", "");
  }
  Case first, other;
  first.name = other.name = "stand";
  first.path              = folder + "/mill1/stand.toml";
  other.path              = folder + "/mill2/stand.toml";
  fs::create_directory(out);
  const auto write_manifest = [&](const std::string &location) {
    write_atomically(out + "/run.json",
                     fmt::format(R"({{"case": "stand", "{}": "{}"}})", source_location, location));
  };
  write_manifest(location_of(first.path));
  EXPECT_EQ(refusal(out, first), "");
  EXPECT_NE(refusal(out, other)
                .find("holds the results of another case file of this name, " + location_of(first.path) +
                      "; choose another with -o, or give --force-overwrite"),
            std::string::npos)
      << refusal(out, other);
  first.path = folder + "/mill1/../mill1/stand.toml";
  EXPECT_EQ(refusal(out, first), "") << "the same file by another path";
  fs::create_hard_link(folder + "/mill1/stand.toml", folder + "/stand.toml");
  first.path = folder + "/stand.toml";
  EXPECT_EQ(refusal(out, first), "") << "the same file by another name";
  fs::remove(folder + "/mill1/stand.toml");
  EXPECT_EQ(refusal(out, other), "") << "the file has been moved";
  write_manifest("");
  EXPECT_EQ(refusal(out, other), "") << "an earlier version did not state it";
}
