#include "core/base/files.h"
#include "core/records/cache_entry.h"
#include "fem/cache/component_cache.h"
#include "fem/cache/roll_cache.h"
#include "tests/support/obstacles.h"
#include <cmath>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <thread>
#include <unistd.h>

using namespace mill;

namespace {
const std::string folder =
    (std::filesystem::temp_directory_path() / ("millstand-cache-" + std::to_string(getpid()))).string();

fem::CondensedRoll some_roll(const double number)
{
  fem::CondensedRoll roll;
  roll.geometry.radius = number;
  roll.grid.n_x = 2, roll.grid.n_z = 3, roll.n_unknowns = 12345;
  roll.grid.x              = Eigen::VectorXd::LinSpaced(2, 0, number);
  roll.symmetric.patch     = Eigen::MatrixXd::Constant(6, 6, number);
  roll.antisymmetric.patch = Eigen::MatrixXd::Identity(6, 6);
  roll.field_mesh          = "$MeshFormat";
  return roll;
}
}  // namespace

class RollCache : public testing::Test {
  void SetUp() override
  {
    std::filesystem::create_directories(folder);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }
};

TEST_F(RollCache, GivesBackEveryBit)
{
  const auto roll = some_roll(0.1);
  fem::save_roll(folder + "/a", "key", roll);
  const auto back = fem::load_roll(folder + "/a", "key");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->symmetric.patch, roll.symmetric.patch);
  EXPECT_EQ(back->antisymmetric.patch, roll.antisymmetric.patch);
  EXPECT_EQ(back->grid.x, roll.grid.x);
  EXPECT_EQ(back->geometry.radius, roll.geometry.radius);
  EXPECT_EQ(back->n_unknowns, 12345);
  EXPECT_EQ(back->field_mesh, roll.field_mesh);
}

TEST_F(RollCache, RefusesOtherKeysAndAbsentFiles)
{
  fem::save_roll(folder + "/a", "key", some_roll(0.1));
  std::string note;
  EXPECT_FALSE(fem::load_roll(folder + "/a", "other", &note));
  EXPECT_NE(note.find("other inputs"), std::string::npos);
  EXPECT_FALSE(fem::load_roll(folder + "/b", "key"));
}

TEST_F(RollCache, NoDamagedFileIsTrusted)
{
  fem::save_roll(folder + "/a", "key", some_roll(0.1));
  const std::string whole = read_text(folder + "/a");
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    std::string broken = whole;
    if (trial % 3 == 0)
      broken.resize(random() % whole.size());
    else
      broken[random() % whole.size()] ^= char(1 << (random() % 8));
    write_atomically(folder + "/b", broken);
    EXPECT_FALSE(fem::load_roll(folder + "/b", "key")) << "trial " << trial;
  }
}

// An entry with a checksum that fits, but counts that are no counts: the first bytes of what is kept of a
// component are the length of its name.
TEST_F(RollCache, CountsThatAreNoCountsAreRefused)
{
  Component component;
  component.name = "barrel";
  fem::save_component(folder + "/a", "key", component);
  ASSERT_TRUE(fem::load_component(folder + "/a", "key"));
  const std::string whole = read_text(folder + "/a");
  const std::string kind  = whole.substr(0, whole.find('\n'));
  const auto bytes        = read_cache_entry(folder + "/a", kind, "key");
  ASSERT_TRUE(bytes);
  for (const double count : {std::nan(""), 1e30, -1e30, -1., 2147483648., 1e9}) {
    std::string forged = *bytes, note;
    std::memcpy(forged.data(), &count, sizeof count);
    write_cache_entry(folder + "/b", kind, "key", forged);
    EXPECT_FALSE(fem::load_component(folder + "/b", "key", &note)) << count;
    EXPECT_NE(note.find("is not used: it is incomplete"), std::string::npos) << note;
  }
}

TEST_F(RollCache, TwoWritersLeaveAWholeFile)
{
  std::vector<std::thread> writers;
  for (int w = 0; w < 4; ++w)
    writers.emplace_back([w] {
      for (int i = 0; i < 25; ++i)
        fem::save_roll(folder + "/a", "key", some_roll(w + 1));
    });
  for (auto &writer : writers)
    writer.join();
  EXPECT_TRUE(fem::load_roll(folder + "/a", "key"));
}

// Every kind of entry goes through core/records/cache_entry.h: what cannot be read is made again, and nothing
// waits.
TEST_F(RollCache, NoKindOfEntryStumblesOverAnObstacle)
{
  const std::string path = folder + "/entry";
  for (const std::string &obstacle : obstacles) {
    put_obstacle(path, obstacle);
    std::string roll, fourier, roller, rings, component;
    EXPECT_FALSE(fem::load_roll(path, "key", &roll)) << obstacle;
    EXPECT_FALSE(fem::load_fourier_roll(path, "key", &fourier)) << obstacle;
    EXPECT_FALSE(fem::load_roller(path, "key", &roller)) << obstacle;
    EXPECT_FALSE(fem::load_rings(path, "key", &rings)) << obstacle;
    EXPECT_FALSE(fem::load_component(path, "key", &component)) << obstacle;
    for (const std::string &note : {roll, fourier, roller, rings, component})
      EXPECT_NE(note.find("is not used"), std::string::npos) << obstacle;
  }
}
