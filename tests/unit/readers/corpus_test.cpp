#include "tests/fuzz/readers.h"
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>

// The inputs that libFuzzer has kept for each reader, and what once broke one, read without it.  A reader that
// does not hold what its target promises calls abort().
namespace {
const std::filesystem::path corpus = std::filesystem::path(MILLSTAND_SOURCE_DIR) / "tests/fuzz/corpus";

std::string path_of_input;

void name_input(int)
{
  const std::string text              = path_of_input + "\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

std::string bytes_of(const std::filesystem::path &path)
{
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string name_of(const testing::TestParamInfo<Reader> &reader)
{
  return reader.param.name;
}
}  // namespace

// What gtest prints of a parameter.
void PrintTo(const Reader &reader, std::ostream *out)
{
  *out << reader.name;
}

class ReaderCorpus : public testing::TestWithParam<Reader> {};

TEST_P(ReaderCorpus, IsReadOrRefused)
{
  std::signal(SIGABRT, name_input);
  int n = 0;
  for (const auto &file : std::filesystem::directory_iterator(corpus / GetParam().name)) {
    path_of_input           = file.path();
    const std::string bytes = bytes_of(file);
    int returned            = -1;
    EXPECT_NO_THROW(returned = GetParam().read(reinterpret_cast<const std::uint8_t *>(bytes.data()), bytes.size()))
        << path_of_input;
    EXPECT_EQ(returned, 0) << path_of_input;
    ++n;
  }
  std::signal(SIGABRT, SIG_DFL);
  EXPECT_GT(n, 0) << "no inputs for " << GetParam().name;
}

INSTANTIATE_TEST_SUITE_P(Each, ReaderCorpus, testing::ValuesIn(all_readers()), name_of);

TEST(ReaderCorpora, HaveOneFolderForEachReaderAndTwoMegabytesAtMost)
{
  std::set<std::string> folders, names;
  std::uintmax_t bytes = 0;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(corpus)) {
    if (entry.is_directory())
      folders.insert(entry.path().filename());
    else
      bytes += entry.file_size();
  }
  for (const Reader &reader : all_readers())
    names.insert(reader.name);
  EXPECT_EQ(folders, names);
  EXPECT_LE(bytes, 2000000u);
}
