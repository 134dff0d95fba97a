#include "app/stages/bearing/bearing_readings.h"
#include "core/model/case.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

// Tables and numbers read off a bearing outlive the run, under its inputs and their own names.
namespace {
using namespace mill;

struct ReadingsFolder {
  Case the_case;
  std::string path = testing::TempDir() + "bearing-readings-" + std::to_string(getpid());
  ReadingsFolder()
  {
    std::filesystem::remove_all(path);
    the_case.name = "bearing-readings";
  }
  ~ReadingsFolder()
  {
    std::filesystem::remove_all(path);
  }
};
}  // namespace

TEST(BearingReadings, ReadingsAreTakenFromTheRunBefore)
{
  const ReadingsFolder folder;
  const OutputDir out(folder.path, folder.the_case, false, "0");
  RunContext run{folder.the_case, out, out.staging()};
  int made            = 0;
  const auto a_number = [&] { return Eigen::VectorXd::Constant(1, ++made); };
  const auto a_table  = [&] {
    return Table().add("load", "N", Eigen::Vector3d(1, 2, ++made)).add("tilt", "", Eigen::Vector3d(4, 5, 6));
  };
  {
    BearingReadings first(run, "inputs");
    EXPECT_EQ(first.numbers("a", a_number)[0], 1);
    EXPECT_EQ(first.numbers("a", a_number)[0], 1);
    EXPECT_EQ(first.table("t", a_table).columns[0][2], 2);
    first.keep(run);
  }
  BearingReadings again(run, "inputs"), others(run, "other inputs");
  EXPECT_EQ(again.numbers("a", a_number)[0], 1);
  const Table back = again.table("t", a_table);
  EXPECT_EQ(back.names, (std::vector<std::string>{"load", "tilt"}));
  EXPECT_EQ(back.units, (std::vector<std::string>{"N", ""}));
  EXPECT_EQ(back.columns[0], Eigen::Vector3d(1, 2, 2));
  EXPECT_EQ(made, 2);
  EXPECT_EQ(others.numbers("a", a_number)[0], 3) << "another bearing";
  run.fresh = true;
  EXPECT_EQ(BearingReadings(run, "inputs").numbers("a", a_number)[0], 4);
  EXPECT_TRUE(run.results.warnings.empty());
}
