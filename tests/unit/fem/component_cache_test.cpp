#include "core/base/files.h"
#include "core/records/cached_record.h"
#include "core/records/component.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <unistd.h>

using namespace mill;

namespace {
Component some_component()
{
  Component c;
  c.name                = "work roll";
  c.source              = "finite elements, 12 unknowns";
  c.interface           = {"barrel P0", "seat"};
  c.n_barrel            = 1;
  c.half_barrel         = 0.7;
  c.elements_per_radius = 5;
  c.M                   = Eigen::MatrixXd::Random(5, 5);
  c.K                   = Eigen::MatrixXd::Random(5, 5);
  c.fixed_frequency     = Eigen::VectorXd::LinSpaced(3, 1, 3);
  c.residual            = Eigen::MatrixXd::Random(2, 2);
  c.axis_z              = Eigen::VectorXd::LinSpaced(4, 0, 3);
  c.axis                = Eigen::MatrixXd::Random(4, 5);
  c.mass                = 1889.25;
  c.reach               = 6127;
  return c;
}

class ComponentCache : public testing::Test {
protected:
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("millstand-component-" + std::to_string(getpid()))).string();
  void SetUp() override
  {
    std::filesystem::create_directories(folder);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }
};
}  // namespace

TEST_F(ComponentCache, GivesBackEveryBit)
{
  const Component c = some_component();
  save_record(folder + "/a", "key", c);
  const auto back = load_record<Component>(folder + "/a", "key");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, c.name);
  EXPECT_EQ(back->source, c.source);
  EXPECT_EQ(back->interface, c.interface);
  EXPECT_EQ(back->n_barrel, c.n_barrel);
  EXPECT_EQ(back->half_barrel, c.half_barrel);
  EXPECT_EQ(back->elements_per_radius, c.elements_per_radius);
  EXPECT_EQ(back->M, c.M);
  EXPECT_EQ(back->K, c.K);
  EXPECT_EQ(back->fixed_frequency, c.fixed_frequency);
  EXPECT_EQ(back->residual, c.residual);
  EXPECT_EQ(back->axis_z, c.axis_z);
  EXPECT_EQ(back->axis, c.axis);
  EXPECT_EQ(back->mass, c.mass);
  EXPECT_EQ(back->reach, c.reach);
}

TEST_F(ComponentCache, RefusesOtherKeysAndAbsentFiles)
{
  save_record(folder + "/a", "key", some_component());
  std::string note;
  EXPECT_FALSE(load_record<Component>(folder + "/a", "other", &note));
  EXPECT_EQ(note, folder + "/a is not used: it belongs to other inputs");
  EXPECT_FALSE(load_record<Component>(folder + "/b", "key"));
}

TEST_F(ComponentCache, NoTruncatedOrFlippedFileIsTrusted)
{
  save_record(folder + "/a", "key", some_component());
  const std::string whole = read_text(folder + "/a");
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    std::string broken = whole;
    if (trial % 3 == 0)
      broken.resize(random() % whole.size());
    else
      broken[random() % whole.size()] ^= char(1 << (random() % 8));
    write_atomically(folder + "/b", broken);
    EXPECT_FALSE(load_record<Component>(folder + "/b", "key")) << "trial " << trial;
  }
}
