// The installed program: in a folder of its own, as the packages have it (cmake/package).
#include "tests/support/program.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <sstream>

namespace fs = std::filesystem;

namespace {
const fs::path build = fs::path(MILLSTAND_PROGRAM).parent_path();

// An installation of some components; they are made once.
std::string installed(const std::string &components)
{
  static const std::string folder = scratch("installed");
  for (std::istringstream names(components); names;) {
    std::string name;
    if (!(names >> name))
      break;
    const Outcome made =
        shell("cmake --install '" + build.string() + "' --prefix '" + folder + "' --component " + name, folder);
    EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
  }
  return folder;
}

bool is_a_program(const std::string &name)
{
  return shell("command -v " + name, "/").exit_code == 0;
}
}  // namespace

TEST(Install, TheLinkOnThePathRunsAnInstalledCaseWithFiniteElements)
{
  const std::string root = installed("programs fem"), out = scratch("installed_run");
  const std::string start = "env -u LD_LIBRARY_PATH PATH='" + root + "/bin':/usr/bin:/bin ";
  EXPECT_EQ(shell(start + "millstand --version", out).out.rfind("millstand ", 0), 0u);
  const Outcome run = shell(start + "millstand run '" + root +
                                "/share/millstand/cases/two-cylinders.toml' -q --fresh --cache cache -o run",
                            out);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(fs::exists(out + "/run/report.html"));
  // A verb of another program of the installation.
  EXPECT_EQ(shell(start + "millstand verify --list", out).exit_code, 0);
  EXPECT_EQ(shell(start + "millstand study --help", out).exit_code, 0);
}

TEST(Install, ManualPageCompletionsAndSchemaAreReadWithoutComplaint)
{
  const std::string share = installed("programs") + "/share";
  const Outcome page      = shell("gzip -dc man/man1/millstand.1.gz", share);
  EXPECT_EQ(page.exit_code, 0);
  for (const char *verb : {"run", "chatter", "study", "live", "help"})
    EXPECT_NE(page.out.find(std::string("\n.SS ") + verb), std::string::npos) << verb;
  EXPECT_EQ(shell("bash -n bash-completion/completions/millstand", share).err, "");
  EXPECT_EQ(shell("python3 -m json.tool millstand/millstand.schema.json >/dev/null", share).err, "");
  if (is_a_program("zsh"))
    EXPECT_EQ(shell("zsh -n zsh/vendor-completions/_millstand", share).err, "");
  if (is_a_program("fish"))
    EXPECT_EQ(shell("fish --no-execute fish/vendor_completions.d/millstand.fish", share).err, "");
  if (is_a_program("groff"))
    EXPECT_EQ(shell("gzip -dc man/man1/millstand.1.gz | groff -man -Tutf8 -ww >/dev/null", share).err, "");
}

TEST(Install, BashCompletesVerbsOptionsAndKinds)
{
  const std::string share = installed("programs") + "/share";
  const auto completed    = [&](const std::string &words, const int position) {
    return shell("bash -c '. bash-completion/completions/millstand; COMP_WORDS=(millstand " + words +
                        "); COMP_CWORD=" + std::to_string(position) + "; _millstand; echo \"${COMPREPLY[*]}\"'",
                    share)
        .out;
  };
  EXPECT_EQ(completed("swee", 1), "sweep\n");
  EXPECT_EQ(completed("sweep --var", 2), "--vary\n");
  EXPECT_EQ(completed("new two-c", 2), "two-cylinders\n");
  EXPECT_EQ(completed("completion fi", 2), "fish\n");
}

TEST(Install, AnOlderProcessorGetsASentence)
{
  if (!is_a_program("qemu-x86_64"))
    GTEST_SKIP() << "qemu-x86_64 (package qemu-user) is not installed";
#ifdef MILLSTAND_NATIVE
  GTEST_SKIP() << "a program tuned for this machine's processor starts with its instructions; packages are not";
#endif
  const Outcome outcome = shell("qemu-x86_64 -cpu core2duo '" MILLSTAND_PROGRAM "' --version", "/");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_EQ(
      outcome.err.rfind("error: this program was built for a newer processor; this one lacks sse4.2, popcnt", 0),
      0u)
      << outcome.err;
  EXPECT_EQ(outcome.out, "");
}
