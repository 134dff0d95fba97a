#include "app/stages/contact/contact_store.h"
#include "core/records/cached_record.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

// What is kept of a contact: all that is read off its pairs, without what they are solved with.
namespace {
using namespace mill;

// Two nodes that touch one after the other.
fem::ContactPair small_pair()
{
  fem::ContactPair pair;
  pair.name                = "upper";
  pair.reference           = "axis to axis";
  pair.grid.n_x            = 2;
  pair.grid.n_z            = 1;
  pair.grid.degree         = 1;
  pair.grid.x              = Eigen::Vector2d(0, 1e-3);
  pair.grid.z              = Eigen::VectorXd::Zero(1);
  pair.grid.area           = Eigen::Vector2d(0.5, 1);
  pair.problem.C           = (Eigen::Matrix2d() << 2e-9, 1e-9, 1e-9, 3e-9).finished();
  pair.problem.G           = Eigen::MatrixXd::Ones(2, 1);
  pair.problem.initial_gap = Eigen::Vector2d(0, 1e-6);
  pair.axis                = Eigen::MatrixXd::Zero(1, 2);
  pair.axis_support        = Eigen::MatrixXd::Constant(1, 1, -1e-10);
  pair.path                = Eigen::VectorXd::Ones(1);
  pair.mean                = Eigen::MatrixXd::Ones(1, 1);
  pair.drop                = Eigen::VectorXd::Zero(1);
  pair.radii_sum           = 0.9;
  pair.solved              = std::make_shared<fem::SolvedLoads>();
  return pair;
}

struct KeptContact : testing::Test {
  const std::string folder = testing::TempDir() + "contact-store-" + std::to_string(getpid());
  const std::string file   = folder + "/contact.bin";
  void SetUp() override
  {
    std::filesystem::create_directories(folder);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }
};

SolvedStudy study_of_one(const fem::ContactPair &pair)
{
  SolvedStudy study;
  study.pairs.push_back({pair, pair.solved->known()});
  study.fields = {"one file", std::string("another \0 file", 14)};
  return study;
}
}  // namespace

TEST_F(KeptContact, ReadingsOfAPairComeBackToTheBit)
{
  const fem::ContactPair pair = small_pair();
  const auto point            = fem::solve_load(pair, 4000);
  save_record(file, "key", study_of_one(pair));
  const auto kept = load_record<SolvedStudy>(file, "key");
  ASSERT_TRUE(kept);
  ASSERT_EQ(kept->pairs.size(), 1u);
  const fem::ContactPair &back = kept->pairs.front().pair;
  EXPECT_EQ(back.problem.C.size(), 0) << "what solves is not kept";
  EXPECT_EQ(back.axis, pair.axis) << "zero throughout, kept as such";
  EXPECT_EQ(back.axis_support, pair.axis_support);
  EXPECT_EQ(back.reference, pair.reference);
  EXPECT_EQ(back.radii_sum, pair.radii_sum);
  EXPECT_TRUE(std::isnan(back.load_offset));
  EXPECT_EQ(kept->fields, study_of_one(pair).fields);
  const auto before = fem::barrel_profile(pair, point),
             after  = fem::barrel_profile(back, kept->pairs.front().loads.points.at(4000));
  EXPECT_EQ(before.line_load, after.line_load);
  EXPECT_EQ(before.tangent, after.tangent);
}

TEST_F(KeptContact, OnlyAnUnknownLoadSolvesThePairAgain)
{
  const fem::ContactPair pair = small_pair();
  const double tangent        = fem::solve_load(pair, 4000).tangent;
  save_record(file, "key", study_of_one(pair));
  auto kept             = load_record<SolvedStudy>(file, "key");
  fem::ContactPair back = kept->pairs.front().pair;
  int asked             = 0;
  back.solved           = std::make_shared<fem::SolvedLoads>(kept->pairs.front().loads);
  back.completed        = [&]() -> const fem::ContactPair        &{
    ++asked;
    return pair;
  };
  EXPECT_EQ(fem::solve_load(back, 4000).tangent, tangent);
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(fem::solve_load(back, 5000).tangent, fem::solve_load(pair, 5000).tangent);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(fem::solve_load(back, 5000).load, 5000);
  EXPECT_EQ(asked, 1) << "known from then on";
}
