// The program where files, folders and terminals are not what they should be: every answer is a sentence and an
// exit code.
#include "core/base/files.h"
#include "tests/support/program.h"
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {
const std::string quick = "modes cases/published-1400.toml -q -o ";

// What waits for ever ends here with exit code 124.
Outcome soon(const std::string &arguments)
{
  const std::string program = "'" MILLSTAND_PROGRAM "'";
  return millstand("--version >/dev/null; timeout 100 " + program + " " + arguments);
}

// As `soon`, with redirections of its own and what the shell does before; only the exit code and what it wrote to
// `err` come back.
Outcome redirected(const std::string &arguments_and_redirections, const std::string &err,
                   const std::string &before = "")
{
  const std::string command = "cd '" MILLSTAND_SOURCE_DIR "' && " + before +
                              " timeout 100 '" MILLSTAND_PROGRAM "' " + arguments_and_redirections + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), "",
          mill::text_if_readable(err).value_or("")};
}

std::string pipe_in(const std::string &folder, const std::string &name)
{
  const std::string path = scratch(folder) + "/" + name;
  fs::remove(path);
  EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
  return path;
}

void expect_refused(const Outcome &outcome, const std::string &sentence)
{
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
}

std::string finished_run(const std::string &name, const std::string &more = "")
{
  const std::string out = scratch(name);
  EXPECT_EQ(millstand(quick + out + more).exit_code, 0);
  return out;
}

// The case of `quick`, to be put anywhere.
std::string published_case()
{
  std::string text = mill::read_text(MILLSTAND_SOURCE_DIR "/cases/published-1400.toml");
  for (std::size_t position = 0; (position = text.find("\"data/", position)) != std::string::npos; position += 2)
    text.replace(position, 1, "\"" MILLSTAND_SOURCE_DIR "/cases/");
  return text;
}

const std::string no_pipe = "cannot be read: it is a named pipe; name a regular file";
}  // namespace

TEST(HostilePlaces, PipesAreRefusedWhereverAFileIsNamed)
{
  const std::string pipe = pipe_in("pipes", "pipe.toml"), out = scratch("pipes") + "/out";
  expect_refused(soon("check " + pipe), no_pipe);
  expect_refused(
      soon("simulate cases/published-1400.toml -q -o " + out + " --force " + pipe_in("pipes", "pipe.csv")),
      "is not a regular file; a record is read from a file");
  expect_refused(soon("check cases/published-1400.toml --set pass.1.force=" + pipe),
                 "is not a regular file; name one");
  expect_refused(soon("check cases/chatter-tandem.toml --set stand.from=" + pipe), no_pipe);
  expect_refused(soon(quick + out + " --log " + pipe), "is not a regular file; name one with --log");
  expect_refused(soon(quick + out + " --log /dev/full"), "is not a regular file; name one with --log");
  const std::string run = finished_run("piped-run");
  fs::remove(run + "/results.json");
  EXPECT_EQ(::mkfifo((run + "/results.json").c_str(), 0600), 0);
  expect_refused(soon("report " + run), no_pipe);
  expect_refused(soon("trace cases/published-1400.toml given.K3 -o " + run), no_pipe);
  EXPECT_EQ(soon(quick + run).exit_code, 0) << "a new run replaces it";
}

TEST(HostilePlaces, ALogReplacesOnlyALog)
{
  const std::string folder = scratch("logs"), out = folder + "/out", file = folder + "/case.toml";
  mill::write_atomically(file, published_case());
  const std::string before = mill::read_text(file);
  const std::string run    = "modes " + file + " -q -o " + out + " --force-overwrite --log ";
  expect_refused(soon(run + file), "exists and is not a log of this program; choose another with --log");
  EXPECT_EQ(mill::read_text(file), before);
  fs::create_symlink(file, folder + "/link");
  expect_refused(soon(run + folder + "/link"), "is a symbolic link; name the file that it points to");
  for (int twice = 0; twice < 2; ++twice)
    EXPECT_EQ(soon(run + folder + "/mine.log").exit_code, 0);
  EXPECT_NE(mill::read_text(folder + "/mine.log").find("millstand"), std::string::npos);
  expect_refused(soon(run + out + "/millstand.log"), "is one of the results in " + out);
}

TEST(HostilePlaces, FullAndClosedOutputsAreReported)
{
  const std::string folder = scratch("full"), err = folder + "/err", out = folder + "/out";
  for (const std::string verb : {"schema", "--version", "new bite", "check cases/two-cylinders.toml",
                                 "trace cases/published-1400.toml given.K3"}) {
    const auto full = redirected(verb + " >/dev/full 2>" + err, err);
    EXPECT_EQ(full.exit_code, 3) << verb;
    EXPECT_EQ(full.err, "error: standard output cannot be written: No space left on device\n") << verb;
  }
  const auto closed = redirected("schema >&- 2>" + err, err);
  EXPECT_EQ(closed.exit_code, 3);
  EXPECT_EQ(closed.err, "error: standard output cannot be written: Bad file descriptor\n");
  const std::string run = "modes cases/published-1400.toml -o " + out;
  EXPECT_EQ(redirected(run + " >/dev/full 2>" + err, err).exit_code, 3);
  EXPECT_TRUE(fs::exists(out + "/report.html")) << "the results are there all the same";
  EXPECT_EQ(redirected(run + " -v >/dev/null 2>/dev/full", "").exit_code, 0) << "nothing is lost but the progress";
  EXPECT_EQ(redirected("check no-such-case.toml 2>/dev/full", "").exit_code, 2);
  const std::vector<std::string> files{"resolved.toml", "lumped_model.toml", "results.json", "curves/modes.csv"};
  std::string before, after;
  for (const std::string &file : files)
    before += mill::read_text(out + "/" + file);
  EXPECT_EQ(redirected(run + " <&- >&- 2>&-", "").exit_code, 3);
  for (const std::string &file : files)
    after += mill::read_text(out + "/" + file);
  EXPECT_EQ(after, before) << "text for the terminal went into a result that was given its number";
}

// The user asked for the right thing and the system refuses it: that is not an input error.
TEST(HostilePlaces, ARefusedWriteEndsWithExitCodeThree)
{
  const std::string folder = scratch("refused"), err = folder + "/err", out = folder + "/out";
  const auto limited = [&](const std::string &arguments) {  // no file may be longer than 2 KiB
    return redirected(arguments + " 2>" + err, err, "trap '' XFSZ; ulimit -f 4;");
  };
  const auto made = limited("new four-high -o " + folder + "/new.toml");
  EXPECT_EQ(made.exit_code, 3);
  EXPECT_EQ(made.err, folder + "/new.toml: error: cannot be written: File too large\n");
  EXPECT_FALSE(fs::exists(folder + "/new.toml"));
  ASSERT_EQ(millstand(quick + out).exit_code, 0);
  const std::string before = mill::read_text(out + "/results.json");
  const auto run           = limited(quick + out + " --set 'given.K1=5e3 kN/mm'");
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_NE(run.err.find(": error: cannot be written: File too large"), std::string::npos) << run.err;
  EXPECT_EQ(mill::read_text(out + "/results.json"), before);
  const auto elsewhere = soon(quick + "/sys/millstand");  // no user may make a folder there
  EXPECT_EQ(elsewhere.exit_code, 3) << elsewhere.err;
  EXPECT_NE(elsewhere.err.find("the folder /sys/millstand cannot be created: "), std::string::npos)
      << elsewhere.err;
}

TEST(HostilePlaces, ARunRemovesTheTemporaryFilesOfKilledRuns)
{
  const std::string cache = scratch("parts-cache"), out = scratch("parts-run");
  const std::string ending = ".0123456789abcdef.part";
  std::ofstream(cache + "/roll-1.bin" + ending) << "half";
  ASSERT_EQ(millstand(quick + out + " --cache " + cache).exit_code, 0);
  EXPECT_FALSE(fs::exists(cache + "/roll-1.bin" + ending));
  std::ofstream(out + "/report.html" + ending) << "half";
  ASSERT_EQ(millstand(quick + out + " --cache " + cache).exit_code, 0);
  EXPECT_FALSE(fs::exists(out + "/report.html" + ending));
}

// A folder whose run.json does not hold a name belongs to no case.
TEST(HostilePlaces, AFolderWithoutAnOwnerIsRefused)
{
  const std::string folder = scratch("nobody");
  for (const std::string text :
       {"{\"case\": 7}", "{\"case\": {\"a\": 1}}", "{\"case\": null}", "[1]", "7", "{", ""}) {
    std::ofstream(folder + "/run.json") << text;
    expect_refused(soon(quick + folder), "error: the folder " + folder +
                                             " holds files that no run wrote; choose another with -o, or give "
                                             "--force-overwrite\n");
    EXPECT_EQ(mill::read_text(folder + "/run.json"), text);
  }
}

TEST(HostilePlaces, ControlCharactersReachNeitherTerminalNorLog)
{
  const std::string folder = scratch("escapes"), file = folder + "/case.toml";
  std::string text = published_case();
  const auto title = text.find("title");
  text.replace(title, text.find('\n', title) - title, "title = \"a\\u001b[31mb\\nK3 = 1\\u202e\"");
  mill::write_atomically(file, text);
  const auto check = soon("check " + file);
  EXPECT_EQ(check.out.substr(0, check.out.find('\n') + 1),
            file + ": no errors (lumped \"a\\x1b[31mb\\nK3 = 1\\u202e\")\n")
      << check.err;
  const auto key = soon("check " + file + " --set '\x1b[2J.x=1'");
  EXPECT_EQ(key.exit_code, 2);
  EXPECT_EQ(key.err.find('\x1b'), std::string::npos);
  EXPECT_NE(key.err.find("\\x1b[2J"), std::string::npos) << key.err;
  const std::string out = folder + "/out";
  EXPECT_EQ(soon("run " + file + " -v -q -o " + out + " --set 'pass.1.name=\"p\\u001b[31m\\n2026-01-01 line\"'")
                .err.find('\x1b'),
            std::string::npos);
  const std::string log = mill::read_text(out + "/millstand.log");
  EXPECT_EQ(log.find('\x1b'), std::string::npos);
  EXPECT_EQ(log.find("\n2026-01-01 line"), std::string::npos) << "a name may not write a line of its own";
  EXPECT_NE(log.find("p\\x1b[31m\\n2026-01-01 line"), std::string::npos) << log;
}

TEST(HostilePlaces, FilesOfTwoRunsAreRefused)
{
  const std::string a = finished_run("run-a"), b = finished_run("run-b", " --set 'given.K1=5e3 kN/mm'");
  const auto id = [](const std::string &run) {
    return nlohmann::json::parse(mill::read_text(run + "/results.json")).at("run_id").get<std::string>();
  };
  ASSERT_NE(id(a), id(b));
  EXPECT_EQ(id(a), id(finished_run("run-a-again"))) << "same inputs, same answer";
  for (const std::string file : {"resolved.toml", "lumped_model.toml"})
    EXPECT_EQ(mill::read_text(a + "/" + file).rfind("# run_id " + id(a) + "\n", 0), 0u) << file;
  EXPECT_EQ(soon("report " + a).exit_code, 0);
  const auto other = [&](const std::string &file) {
    fs::copy_file(b + "/" + file, a + "/" + file, fs::copy_options::overwrite_existing);
  };
  const std::string mixed = "the folder mixes two runs; run the case again";
  other("curves/modes.csv");
  expect_refused(soon("report " + a), "curves/modes.csv: error: is not the file that run " + id(a) + " wrote");
  other("lumped_model.toml");
  expect_refused(soon("modes " + a + "/lumped_model.toml -q -o " + scratch("from-mixed")), mixed);
  expect_refused(soon("check cases/chatter-tandem.toml --set stand.from=" + a + "/lumped_model.toml"), mixed);
  fs::copy_file(a + "/lumped_model.toml", a + "/copy.toml");
  EXPECT_EQ(soon("check " + a + "/copy.toml").exit_code, 0) << "a copy is a case like any other";
  other("results.json");
  expect_refused(soon("report " + a), mixed);
  expect_refused(soon("trace cases/published-1400.toml given.K3 -o " + a), mixed);
  EXPECT_EQ(soon(quick + a).exit_code, 0) << "a new run mends it";
  EXPECT_EQ(soon("report " + a).exit_code, 0);
}

TEST(HostilePlaces, AComparisonReplacesOnlyAComparison)
{
  const std::string a = finished_run("compared-a"), b = finished_run("compared-b", " --set 'given.K1=5e3 kN/mm'"),
                    page = scratch("compared") + "/page.html", notes = scratch("compared") + "/notes.html";
  const std::string runs = "report " + a + " " + b + " -o ";
  mill::write_atomically(notes, "not to be lost");
  expect_refused(soon(runs + notes),
                 "exists and is not a comparison that 'millstand report' wrote; choose another "
                 "name with -o");
  EXPECT_EQ(mill::read_text(notes), "not to be lost");
  expect_refused(soon(runs + a + "/report.html"), "is not a comparison");
  fs::remove(page);
  EXPECT_EQ(soon(runs + page).exit_code, 0);
  EXPECT_EQ(soon(runs + page).exit_code, 0) << "its own page is replaced";
}

namespace {
// As a kill between the renames leaves it: all of the earlier run gone, some entries of the new one not yet in
// place.
void interrupt_publishing(const std::string &out, const std::vector<std::string> &not_yet_in_place)
{
  const std::string journal = out + "/.publishing";
  std::string names;
  for (const auto &entry : fs::directory_iterator(out))
    names += entry.path().filename().string() + "\n";
  fs::create_directory(journal);
  for (const std::string &name : not_yet_in_place)
    fs::rename(out + "/" + name, journal + "/" + name);
  mill::write_atomically(journal + "/.names", names);
}
}  // namespace

TEST(HostilePlaces, EveryCommandThatReadsAFolderCompletesAnInterruptedRun)
{
  const std::string out = finished_run("killed-between");
  for (const std::string &command : {"trace cases/published-1400.toml given.K3 -o " + out,
                                     "check " + out + "/lumped_model.toml", "report " + out}) {
    interrupt_publishing(out, {"results.json", "run.json", "lumped_model.toml"});
    const auto reader = soon(command);
    EXPECT_EQ(reader.exit_code, 0) << command << ": " << reader.err;
    EXPECT_FALSE(fs::exists(out + "/.publishing")) << command;
    EXPECT_TRUE(fs::exists(out + "/results.json")) << command;
  }
}

TEST(HostilePlaces, AResultFolderMayBeASymbolicLink)
{
  const std::string out = finished_run("linked-run"), link = scratch("link-to-run") + "/link";
  fs::create_directory_symlink(out, link);
  fs::remove(out + "/results.json");
  const auto run = soon(quick + link);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(fs::is_symlink(link)) << "the link stays";
  EXPECT_TRUE(fs::exists(out + "/results.json")) << "the results are where it points to";
  EXPECT_EQ(soon("report " + link).exit_code, 0);
  const std::string nowhere = scratch("link-to-nothing") + "/link";
  fs::create_symlink(out + "-that-is-not-there", nowhere);
  expect_refused(soon(quick + nowhere), "the folder " + nowhere + " cannot be created");
}
