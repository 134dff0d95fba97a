#include "core/base/files.h"
#include "core/records/cached_record.h"
#include "core/records/component.h"
#include "fem/bearing/ring_flexibility.h"
#include "fem/bearing/roller_contact.h"
#include "fem/roll/condensed_roll.h"
#include "fem/roll/fourier_roll.h"
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
  save_record(folder + "/a", "key", roll);
  const auto back = load_record<fem::CondensedRoll>(folder + "/a", "key");
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
  save_record(folder + "/a", "key", some_roll(0.1));
  std::string note;
  EXPECT_FALSE(load_record<fem::CondensedRoll>(folder + "/a", "other", &note));
  EXPECT_NE(note.find("other inputs"), std::string::npos);
  EXPECT_FALSE(load_record<fem::CondensedRoll>(folder + "/b", "key"));
}

TEST_F(RollCache, NoDamagedFileIsTrusted)
{
  save_record(folder + "/a", "key", some_roll(0.1));
  const std::string whole = read_text(folder + "/a");
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    std::string broken = whole;
    if (trial % 3 == 0)
      broken.resize(random() % whole.size());
    else
      broken[random() % whole.size()] ^= char(1 << (random() % 8));
    write_atomically(folder + "/b", broken);
    EXPECT_FALSE(load_record<fem::CondensedRoll>(folder + "/b", "key")) << "trial " << trial;
  }
}

// An entry with a checksum that fits, but sizes that are not: the first bytes of what is kept of a component are
// the length of its name.
TEST_F(RollCache, SizesBeyondTheEntryAreRefused)
{
  Component component;
  component.name = "barrel";
  save_record(folder + "/a", "key", component);
  ASSERT_TRUE(load_record<Component>(folder + "/a", "key"));
  const std::string whole = read_text(folder + "/a");
  const std::string kind  = whole.substr(0, whole.find('\n'));
  const auto bytes        = read_cache_entry(folder + "/a", kind, "key");
  ASSERT_TRUE(bytes);
  for (const std::uint64_t size :
       {~std::uint64_t(0), std::uint64_t(1) << 63, std::uint64_t(1e9), std::uint64_t(7)}) {
    std::string forged = *bytes, note;
    std::memcpy(forged.data(), &size, sizeof size);
    write_cache_entry(folder + "/b", kind, "key", forged);
    EXPECT_FALSE(load_record<Component>(folder + "/b", "key", &note)) << size;
    EXPECT_NE(note.find("is not used: it is incomplete"), std::string::npos) << note;
  }
}

TEST_F(RollCache, AnEntryOfAnotherListOfMembersIsNotRead)
{
  save_record(folder + "/a", "key", ComponentSurface());
  std::string note;
  EXPECT_FALSE(load_record<Component>(folder + "/a", "key", &note));
  EXPECT_NE(note.find("it is not a millstand record"), std::string::npos) << note;
}

TEST_F(RollCache, TwoWritersLeaveAWholeFile)
{
  std::vector<std::thread> writers;
  for (int w = 0; w < 4; ++w)
    writers.emplace_back([w] {
      for (int i = 0; i < 25; ++i)
        save_record(folder + "/a", "key", some_roll(w + 1));
    });
  for (auto &writer : writers)
    writer.join();
  EXPECT_TRUE(load_record<fem::CondensedRoll>(folder + "/a", "key"));
}

// Every kind of entry goes through core/records/cache_entry.h: what cannot be read is made again, and nothing
// waits.
TEST_F(RollCache, NoKindOfEntryStumblesOverAnObstacle)
{
  const std::string path = folder + "/entry";
  for (const std::string &obstacle : obstacles) {
    put_obstacle(path, obstacle);
    std::string roll, fourier, roller, rings, component;
    EXPECT_FALSE(load_record<fem::CondensedRoll>(path, "key", &roll)) << obstacle;
    EXPECT_FALSE(load_record<fem::FourierRoll>(path, "key", &fourier)) << obstacle;
    EXPECT_FALSE(load_record<fem::CondensedRoller>(path, "key", &roller)) << obstacle;
    EXPECT_FALSE(load_record<fem::RingResult>(path, "key", &rings)) << obstacle;
    EXPECT_FALSE(load_record<Component>(path, "key", &component)) << obstacle;
    for (const std::string &note : {roll, fourier, roller, rings, component})
      EXPECT_NE(note.find("is not used"), std::string::npos) << obstacle;
  }
}
