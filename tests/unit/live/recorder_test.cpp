#include "core/base/errors.h"
#include "tests/support/near.h"
#include "twin/live/recording/npy_header.h"
#include "twin/live/recording/recorder.h"
#include "twin/records/raw_record.h"
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
struct Folder {
  std::string path = (fs::temp_directory_path() / ("millstand-rec-" + std::to_string(getpid()))).string();
  Folder()
  {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder()
  {
    fs::remove_all(path);
  }
  std::vector<std::string> files(const std::string &ending) const
  {
    std::vector<std::string> names;
    for (const auto &entry : fs::directory_iterator(path)) {
      const std::string name = entry.path().filename().string();
      if (name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0)
        names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

live::LiveSource source()
{
  return {"daq-1", 1000,     1767607200.0, {{"force", "N"}, {"upper_work_roll", "m/s2"}, {"it's", "V"}},
          {},      {1, 1, 1}};
}

Eigen::MatrixXd rows(const std::int64_t first, const Eigen::Index n)
{
  Eigen::MatrixXd values(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    values.row(i) << 976e3 + double(first + i), 0.25 * double((first + i) % 64), double(i % 2);
  return values;
}

struct Recording {
  Folder folder;
  std::vector<std::string> messages;
  std::unique_ptr<live::Background> background = std::make_unique<live::Background>();
  std::unique_ptr<live::Recorder> recorder;
  explicit Recording(const live::KeptRecords &kept = {})
  {
    live::RecorderSettings settings;
    settings.folder    = folder.path;
    settings.case_name = "test";
    settings.case_hash = "hash";
    settings.kept      = kept;
    recorder           = std::make_unique<live::Recorder>(
        settings, *background,
        [this](const std::string &kind, const std::string &text) { messages.push_back(kind + ": " + text); },
        [] { return R"({"gaps":1})"; });
    recorder->begin(source());
  }
  void end()
  {
    recorder.reset();
    background.reset();
  }
};
}  // namespace

// What live wrote is read by whoever analyses records: gaps are jumps of the time, the start is that of the file.
TEST(Recorder, WritesWhatTheReaderOfRecordsReads)
{
  Recording to;
  to.recorder->add(2000, rows(2000, 1500));
  to.recorder->add(3600, rows(3600, 400));  // 100 samples were lost
  to.end();
  ASSERT_EQ(to.folder.files(".npy"), std::vector<std::string>{"20260105T100002Z_2000.npy"});
  const auto record = twin::read_npy_record(to.folder.path + "/20260105T100002Z_2000.npy", {});
  ASSERT_EQ(record.n_samples(), 1900);
  EXPECT_EQ(record.rate, 1000);
  EXPECT_EQ(record.start, 1767607202.0);
  EXPECT_TRUE(near(record.time[1499], 1.499, within_absolute(1e-12, "sample number over the rate, rounding")));
  EXPECT_TRUE(near(record.time[1500], 1.6, within_absolute(1e-12, "sample number over the rate, rounding")));
  ASSERT_TRUE(record.find("upper_work_roll"));
  EXPECT_EQ(record.find("upper_work_roll")->unit, "m/s2");
  EXPECT_EQ(record.find("upper_work_roll")->value[10], 0.25 * (2010 % 64));
  EXPECT_EQ(record.find("force")->value[3], 976e3 + 2003);
  ASSERT_TRUE(record.find("it_s")) << "a quote would end the name";
  const auto sidecar = nlohmann::json::parse(std::ifstream(to.folder.path + "/20260105T100002Z_2000.json"));
  EXPECT_EQ(sidecar["account"]["gaps"], 1);
  EXPECT_EQ(sidecar["case_hash"], "hash");
  EXPECT_EQ(sidecar["names"]["it_s"], "it's");
  EXPECT_TRUE(sidecar["complete"].get<bool>());
}

TEST(Recorder, BeginsAFileEachMinuteAndReplacesNone)
{
  Recording to;
  for (int k = 0; k < 130; ++k)
    to.recorder->add(1000 * k, rows(1000 * k, 1000));
  to.recorder->begin(source());
  to.recorder->add(0, rows(0, 10));  // the same record again
  to.end();
  EXPECT_EQ(to.folder.files(".npy"),
            (std::vector<std::string>{"20260105T100000Z_0-2.npy", "20260105T100000Z_0.npy",
                                      "20260105T100100Z_60000.npy", "20260105T100200Z_120000.npy"}));
  EXPECT_TRUE(to.folder.files(".part").empty());
}

// Of a source that stalls no whole tenth of a second comes: the clock saves what waits, also behind a save().
TEST(Recorder, SavesWhatWaitsOfASourceThatStalls)
{
  Recording to;
  const auto saved = [&] {
    const auto parts = to.folder.files(".part");
    live::NpyHeader header;
    std::ifstream file(to.folder.path + "/" + parts.at(0), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    return live::read_npy_header(bytes, header) ? header.rows : -1;
  };
  to.recorder->add(0, rows(0, 50));
  to.recorder->save();
  EXPECT_EQ(saved(), 50);
  to.recorder->add(50, rows(50, 50));
  to.recorder->tick(1000.0);
  EXPECT_EQ(saved(), 100);
  to.recorder->add(100, rows(100, 50));
  to.recorder->tick(1000.01);
  EXPECT_EQ(saved(), 100) << "not at each tick";
  to.recorder->tick(1000.1);
  EXPECT_EQ(saved(), 150);
}

// The part is whole up to the last tenth of a second at any moment, and finished by the next program.
TEST(Recorder, APartIsReadableWhileItGrowsAndFinishedAfterwards)
{
  Recording to;
  to.recorder->add(0, rows(0, 1234));
  const std::string part = to.folder.path + "/20260105T100000Z_0.npy.part";
  fs::copy_file(part, to.folder.path + "/copy.npy");
  fs::copy_file(to.folder.path + "/20260105T100000Z_0.json", to.folder.path + "/copy.json");
  const auto record = twin::read_npy_record(to.folder.path + "/copy.npy", {});
  EXPECT_EQ(record.n_samples(), 1200);
  std::vector<std::string> messages;
  const auto hear = [&](const std::string &text) { messages.push_back(text); };
  EXPECT_TRUE(live::finish_parts(to.folder.path, hear).empty());
  EXPECT_EQ(messages.at(0), part + " is being written by another program");
  // what a killed program leaves: rows beyond the header's count and a piece of one
  const std::string left = to.folder.path + "/20260105T110000Z_77.npy.part";
  fs::copy_file(part, left);
  fs::copy_file(to.folder.path + "/copy.json", to.folder.path + "/20260105T110000Z_77.json");
  std::ofstream(left, std::ios::app | std::ios::binary) << std::string(20 * 3 + 7, '\1');
  std::ofstream(to.folder.path + "/20260105T120000Z_0.npy.part") << "something else";
  messages.clear();
  const auto finished = live::finish_parts(to.folder.path, hear);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].rows, 1203);
  const auto whole = twin::read_npy_record(to.folder.path + "/20260105T110000Z_77.npy", {});
  EXPECT_EQ(whole.n_samples(), 1203);
  EXPECT_EQ(messages.at(2),
            to.folder.path +
                "/20260105T120000Z_0.npy.part cannot be finished, since it is not a recording; it stays "
                "as it is");
  to.end();
}

TEST(Recorder, DoesNotRecordTwiceWhatIsThere)
{
  Recording to;
  to.recorder->resume(150);
  to.recorder->add(100, rows(100, 100));
  to.end();
  const auto record = twin::read_npy_record(to.folder.path + "/20260105T100000Z_150.npy", {});
  EXPECT_EQ(record.n_samples(), 50);
  EXPECT_EQ(record.find("force")->value[0], 976e3 + 150);
}

// A disk that is full, in the form of a limit on the size of files.
TEST(Recorder, StopsWithANoteWhenTheDiskIsFull)
{
  Recording to;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{10000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  for (int k = 0; k < 20; ++k)
    to.recorder->add(100 * k, rows(100 * k, 100));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_FALSE(to.recorder->trouble().empty());
  ASSERT_EQ(to.messages.size(), 1u);
  EXPECT_EQ(to.messages[0],
            "recording: cannot write " + to.folder.path +
                "/20260105T100000Z_0.npy.part: File too large; recording stopped, the twin goes on");
  to.recorder->add(5000, rows(5000, 100));
  to.end();
  const auto finished = live::finish_parts(to.folder.path, [](const std::string &) {});
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(twin::read_npy_record(finished[0].file, {}).n_samples(), finished[0].rows);
  EXPECT_GE(finished[0].rows, 400);
}

// A folder that the system no longer lets us look into, in the form of a link that leads to itself.
TEST(Recorder, StopsWithANoteWhenTheFolderCannotBeRead)
{
  Recording to;
  fs::remove_all(to.folder.path);
  fs::create_symlink(to.folder.path, to.folder.path);
  EXPECT_NO_THROW(to.recorder->add(0, rows(0, 100)));
  const std::string why = "cannot write " + to.folder.path +
                          "/20260105T100000Z_0.npy.part: Too many levels of symbolic links; recording stopped, "
                          "the twin goes on";
  EXPECT_EQ(to.recorder->trouble(), why);
  EXPECT_EQ(to.messages, std::vector<std::string>{"recording: " + why});
  to.end();
}

// A file that cannot take its name stays a part, which the next program finishes; its sidecar does not say that it
// is complete.
TEST(Recorder, AFileWithoutItsNameIsNotComplete)
{
  Recording to;
  to.recorder->add(0, rows(0, 100));
  const std::string stem = to.folder.path + "/20260105T100000Z_0";
  fs::create_directories(stem + ".npy/in the way");
  to.end();
  EXPECT_EQ(to.messages, std::vector<std::string>{"recording: " + stem + ".npy: Is a directory"});
  EXPECT_TRUE(fs::exists(stem + ".npy.part"));
  const auto sidecar = nlohmann::json::parse(std::ifstream(stem + ".json"));
  EXPECT_FALSE(sidecar["complete"].get<bool>());
  fs::remove_all(stem + ".npy");
  const auto finished = live::finish_parts(to.folder.path, [](const std::string &) {});
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(twin::read_npy_record(stem + ".npy", {}).n_samples(), 100);
}

TEST(Recorder, KeepsTheLatestAndTouchesNothingElse)
{
  const Folder folder;
  const auto make = [&](const std::string &stem, const std::size_t bytes, const bool sidecar, const int age) {
    std::ofstream(folder.path + "/" + stem + ".npy") << std::string(bytes, 'x');
    if (sidecar)
      std::ofstream(folder.path + "/" + stem + ".json") << "{}";
    fs::last_write_time(folder.path + "/" + stem + ".npy",
                        fs::file_time_type::clock::now() - std::chrono::hours(age));
  };
  make("20260105T100000Z_0", 100, true, 5);
  make("20260105T110000Z_1", 100, true, 4);
  make("20260105T120000Z_2", 100, true, 3);
  make("20260105T090000Z_9", 100, false, 9);  // without a sidecar: not ours
  make("my-own-record", 100, true, 9);
  EXPECT_TRUE(live::remove_old_records(folder.path, {}, double(std::time(nullptr))).empty());
  EXPECT_EQ(live::remove_old_records(folder.path, live::kept_records("4.5h"), double(std::time(nullptr))),
            std::vector<std::string>{folder.path + "/20260105T100000Z_0.npy"});
  EXPECT_EQ(live::remove_old_records(folder.path, {{}, 150.0}, double(std::time(nullptr))),
            std::vector<std::string>{folder.path + "/20260105T110000Z_1.npy"});
  EXPECT_EQ(live::remove_old_records(folder.path, {{}, 1.0}, double(std::time(nullptr))).size(), 0u);
  EXPECT_TRUE(fs::exists(folder.path + "/my-own-record.npy"));
  EXPECT_TRUE(fs::exists(folder.path + "/20260105T090000Z_9.npy"));
}

// The clock was years ahead for a while: what it wrote then is older than what was written since.
TEST(Recorder, AFileFromTheFutureGoesBeforeLaterOnes)
{
  const Folder folder;
  const auto make = [&](const std::string &stem, const int age) {
    std::ofstream(folder.path + "/" + stem + ".npy") << std::string(100, 'x');
    std::ofstream(folder.path + "/" + stem + ".json") << "{}";
    fs::last_write_time(folder.path + "/" + stem + ".npy",
                        fs::file_time_type::clock::now() - std::chrono::hours(age));
  };
  const double now = double(std::time(nullptr));
  make("20300105T100000Z_0", -4 * 365 * 24);
  make("20260105T110000Z_1", 2);
  make("20260105T120000Z_2", -1);  // the hour of daylight saving, or the clock of another machine
  EXPECT_TRUE(live::remove_old_records(folder.path, live::kept_records("24h"), now).empty())
      << "how old the first one is, is not known";
  EXPECT_EQ(live::remove_old_records(folder.path, {{}, 250.0}, now),
            std::vector<std::string>{folder.path + "/20300105T100000Z_0.npy"});
  EXPECT_EQ(live::remove_old_records(folder.path, {{}, 150.0}, now),
            std::vector<std::string>{folder.path + "/20260105T110000Z_1.npy"});
}

// The disk is full when the program starts: the rows are there, and only their description cannot be renewed.
TEST(Recorder, FinishesAPartWhoseDescriptionCannotBeWritten)
{
  Recording to;
  to.recorder->add(0, rows(0, 100));
  to.recorder->save();
  const std::string stem = to.folder.path + "/20260105T100000Z_0", part = stem + ".npy.part";
  fs::copy_file(part, to.folder.path + "/copy");  // as a kill leaves it
  to.end();
  fs::rename(to.folder.path + "/copy", part);
  fs::remove(stem + ".npy");
  auto sidecar    = nlohmann::json::parse(std::ifstream(stem + ".json"));
  sidecar["text"] = std::string(20000, 'x');
  std::ofstream(stem + ".json") << sidecar;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{10000, before.rlim_max};  // between the two sizes
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  std::vector<std::string> notes;
  std::vector<live::FinishedPart> finished;
  EXPECT_NO_THROW(finished =
                      live::finish_parts(to.folder.path, [&](const std::string &note) { notes.push_back(note); }));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].rows, 100);
  EXPECT_EQ(finished[0].source, "daq-1");
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].rfind(stem + ".json stays as it was: ", 0), 0u) << notes[0];
  EXPECT_EQ(twin::read_npy_record(stem + ".npy", {}).n_samples(), 100);
}

TEST(Recorder, UnderstandsWhatToKeep)
{
  EXPECT_EQ(live::kept_records("24h").age, 86400.0);
  EXPECT_EQ(live::kept_records("7 d").age, 7 * 86400.0);
  EXPECT_EQ(live::kept_records("50GB").bytes, 50e9);
  for (const std::string text : {"", "24", "h", "-1h", "1 week", "0GB"})
    try {
      live::kept_records(text);
      FAIL() << text;
    } catch (const InputError &error) {
      EXPECT_EQ(error.problems.front().message,
                "--keep \"" + text +
                    "\": a time or a size is needed, for example --keep 24h or --keep "
                    "50GB (min, h, d, MB, GB, TB)");
    }
}

TEST(NpyHeader, HasTheSameLengthForAnyNumberOfRows)
{
  std::vector<std::string> fields;
  for (int i = 0; i < 64; ++i)
    fields.push_back("channel_" + std::to_string(i) + std::string(100, 'x'));
  for (const auto &names : {std::vector<std::string>{"force"}, fields}) {
    const std::string empty = live::npy_header(names, 0), full = live::npy_header(names, 4000000000);
    EXPECT_EQ(empty.size(), full.size());
    EXPECT_EQ(empty.size() % 64, 0u);
    live::NpyHeader read;
    ASSERT_TRUE(live::read_npy_header(full, read));
    EXPECT_EQ(read.rows, 4000000000);
    EXPECT_EQ(read.fields, names);
  }
}
