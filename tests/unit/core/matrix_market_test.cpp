// Matrix Market files: every bit comes back, and errors name their line.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/records/matrix_market.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
class MatrixMarket : public testing::Test {
protected:
  const fs::path folder = fs::temp_directory_path() / ("millstand_matrix_market_" + std::to_string(::getpid()));
  void SetUp() override
  {
    fs::create_directories(folder);
  }
  void TearDown() override
  {
    fs::remove_all(folder);
  }
  std::string file(const std::string &text) const
  {
    const std::string path = (folder / "a.mtx").string();
    write_atomically(path, text);
    return path;
  }
  std::string refused(const std::string &text) const
  {
    try {
      read_matrix_market(file(text));
    } catch (const InputError &e) {
      const Problem &p = e.problems.front();
      return std::to_string(p.place.line) + ": " + p.message;
    }
    return "accepted";
  }
};
}  // namespace

TEST_F(MatrixMarket, EveryBitComesBack)
{
  Eigen::MatrixXd symmetric(3, 3);
  symmetric << 1. / 3, -7.1e10, 0, -7.1e10, 5e-300, 0.1, 0, 0.1, 0;
  Eigen::MatrixXd general = symmetric;
  general(0, 2)           = 4.25;
  Eigen::MatrixXd column(4, 1);
  column << 0, 1, -1, 0;
  for (const Eigen::MatrixXd &m : {symmetric, general, column}) {
    const std::string text = matrix_market_text(m, "mass, kg");
    EXPECT_EQ(text.find("\n% mass, kg\n") != std::string::npos, true);
    EXPECT_EQ(text.find(" symmetric\n") != std::string::npos, m.rows() == m.cols() && m == m.transpose());
    EXPECT_EQ(read_matrix_market(file(text)), m);
  }
  EXPECT_EQ(matrix_market_text(symmetric, "").find("\n1 2 "), std::string::npos) << "the lower triangle alone";
}

TEST_F(MatrixMarket, FilesOfOtherProgramsAreRead)
{
  Eigen::MatrixXd expected(2, 2);
  expected << 1, 2, 2, 3;
  for (const char *text :
       {"%%MatrixMarket matrix array real general\n% by hand\n2 2\n1\n2\n2\n3\n",
        "%%MatrixMarket matrix array integer symmetric\r\n2 2\r\n1\r\n2\r\n3\r\n",
        "%%MatrixMarket matrix coordinate real general\n\n  2 2 4\n2 2 3.0\n1 1 1e0\n1 2 2\n2 1 2\n"})
    EXPECT_EQ(read_matrix_market(file(text)), expected) << text;
}

TEST_F(MatrixMarket, ErrorsNameTheirLine)
{
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  EXPECT_EQ(refused("1 2 3\n"),
            "1: the first line must be \"%%MatrixMarket matrix coordinate real general\" (or array, "
            "integer, symmetric)");
  EXPECT_EQ(refused("%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 1 0\n").substr(0, 2), "1:");
  EXPECT_EQ(refused(head + "2 3 1\n1 1 1\n"), "2: a symmetric matrix of 2 rows and 3 columns");
  EXPECT_EQ(refused(head + "2 2 1\n1 2 5\n"), "3: a symmetric matrix has its lower triangle only");
  EXPECT_EQ(refused(head + "2 2 2\n1 1 5\n1 1 6\n"), "4: the entry 1, 1 comes twice");
  EXPECT_EQ(refused(head + "2 2 2\n1 1 5\n"), "3: the file ends after 1 of 2 entries");
  EXPECT_EQ(refused(head + "2 2 1\n1 1 5\n2 2 5\n"), "4: more entries than the header says");
  EXPECT_EQ(refused(head + "2 2 1\n3 1 5\n"), "3: \"3\" is not a whole number from 1 to 2");
  EXPECT_EQ(refused(head + "2 2 1\n1 1 nan\n"), "3: \"nan\" is not a finite number");
  EXPECT_EQ(refused(head + "2 2 1\n1 1 5x\n"), "3: \"5x\" is not a finite number");
  EXPECT_EQ(refused(head + "99999999999 2 1\n").substr(0, 2), "2:");
  EXPECT_EQ(refused(""), "0: is empty; a Matrix Market file begins with \"%%MatrixMarket\"");
}
