// What a unit leaves alone in the process of its client, and what a step inside a call costs.
#include "dynamics/fmu/unit_archive.h"
#include "tests/support/near.h"
#include "tests/support/unit_client.h"
#include <cfenv>
#include <clocale>
#include <cmath>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <map>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
double hundred_steps(Client2 &client)
{
  EXPECT_EQ(client.start(976e3), fmi2OK) << client.logged();
  for (int i = 0; i < 100; ++i) {
    client.set("F_roll", 976e3 + 1e4 * std::sin(0.1 * i));
    EXPECT_EQ(client.step(1e-3 * i, 1e-3), fmi2OK) << client.logged();
  }
  return client.get("a_upper_work_roll");
}

std::map<std::string, std::pair<std::uintmax_t, fs::file_time_type>> files_below(const fs::path &folder)
{
  std::map<std::string, std::pair<std::uintmax_t, fs::file_time_type>> all;
  for (const auto &file : fs::recursive_directory_iterator(folder))
    all[file.path().string()] = {file.is_regular_file() ? file.file_size() : 0, file.last_write_time()};
  return all;
}

std::vector<void (*)(int)> handlers()
{
  std::vector<void (*)(int)> all;
  for (const int number : {SIGINT, SIGTERM, SIGFPE, SIGSEGV, SIGABRT, SIGILL}) {
    struct sigaction now;
    sigaction(number, nullptr, &now);
    all.push_back(now.sa_handler);
  }
  return all;
}
}  // namespace

TEST(UnitProcess, IsLeftAsItWasFound)
{
  const SampleStand stand = sample_stand(ForceMeaning::disturbance, 0.01, 2e6);
  Client2 first(stand.model);
  ASSERT_TRUE(first.c) << first.logged();
  const double wanted   = hundred_steps(first);
  const auto files      = files_below(fs::path(first.unit->resources()).parent_path().parent_path());
  const auto directory  = fs::current_path();
  const auto signals    = handlers();
  const auto local_name = std::string(std::setlocale(LC_ALL, nullptr));
  std::fesetround(FE_UPWARD);
  {
    Client2 second(first.unit, stand.model, stand.model.data.guid, "");
    hundred_steps(second);
  }
  EXPECT_EQ(std::fegetround(), FE_UPWARD) << "rounding mode";
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(files_below(fs::path(first.unit->resources()).parent_path().parent_path()), files);
  EXPECT_EQ(fs::current_path(), directory);
  EXPECT_EQ(handlers(), signals);
  EXPECT_EQ(std::string(std::setlocale(LC_ALL, nullptr)), local_name);
  Client2 third(first.unit, stand.model, stand.model.data.guid, "");
  EXPECT_EQ(hundred_steps(third), wanted);
}

TEST(UnitProcess, ReadsItsFilesInAnyLocale)
{
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const char *found        = nullptr;
  for (const char *name : {"de_DE.UTF-8", "de_DE.utf8", "de_AT.utf8", "fr_FR.utf8", "nl_NL.utf8"})
    found = found ? found : std::setlocale(LC_ALL, name);
  if (!found)
    GTEST_SKIP() << "no locale with a decimal comma is installed";
  SampleStand stand = sample_stand();
  carry(stand.model, sample_force(200, 1e-3));
  Client2 client(stand.model);
  ASSERT_TRUE(client.c) << client.logged();
  const unsigned use = client.at("use_stored_force");
  const int yes      = 1;
  FMI2(client, SetBoolean)(client.c, &use, 1, &yes);
  const double with_comma = hundred_steps(client);
  std::setlocale(LC_ALL, before.c_str());
  Client2 again(client.unit, stand.model, stand.model.data.guid, "");
  FMI2(again, SetBoolean)(again.c, &use, 1, &yes);
  EXPECT_EQ(hundred_steps(again), with_comma);
}

TEST(UnitProcess, WhatIsReadAfterASetIsOfTheLastStep)
{
  const SampleStand stand = sample_stand();
  Client2 client(stand.model), other(client.unit, stand.model, stand.model.data.guid, "");
  const double a = hundred_steps(client), y = client.get("y_upper_work_roll"), f = client.get("f1");
  client.set("F_roll", 5e5);
  EXPECT_EQ(client.get("a_upper_work_roll"), a) << "the force acts from the next step on";
  client.set("K3", 1e10);
  EXPECT_EQ(client.get("a_upper_work_roll"), a);
  EXPECT_EQ(client.get("y_upper_work_roll"), y);
  EXPECT_LT(client.get("f1"), f) << "what the parameters alone say is said at once";
  hundred_steps(other);
  EXPECT_EQ(other.step(0.1, 1e-3), fmi2OK);
  EXPECT_EQ(client.step(0.1, 1e-3), fmi2OK);
  EXPECT_NE(client.get("a_upper_work_roll"), other.get("a_upper_work_roll"));
}

TEST(UnitProcess, TerminateAndFreeMayBeLeftOutOrComeAfterAnError)
{
  const SampleStand stand = sample_stand();
  Client2 client(stand.model);
  FMI2(client, FreeInstance)(nullptr);
  ASSERT_EQ(client.start(976e3), fmi2OK);
  EXPECT_EQ(client.step(5, 1e-3), fmi2Error) << "a step that does not begin where the last one ended";
  EXPECT_EQ(FMI2(client, Terminate)(client.c), fmi2OK);
  Client2 without(client.unit, stand.model, stand.model.data.guid, "");
  ASSERT_EQ(without.start(976e3), fmi2OK);
  EXPECT_EQ(without.step(0, 1e-3), fmi2OK);
}

// 0.5 us for a step inside, 2 us for a call: a played record of 20 kHz, 2000 samples in each call.
TEST(UnitProcess, StepsInsideACallCostHalfAMicrosecond)
{
  SampleStand stand = sample_stand();
  carry(stand.model, sample_force(40001, 5e-5));
  Client2 client(stand.model);
  const unsigned use = client.at("use_stored_force");
  const int yes      = 1;
  ASSERT_EQ(FMI2(client, SetBoolean)(client.c, &use, 1, &yes), fmi2OK);
  ASSERT_EQ(client.start(976e3), fmi2OK) << client.logged();
  const std::clock_t begin = std::clock();
  for (int i = 0; i < 20; ++i)
    ASSERT_EQ(client.step(0.1 * i, 0.1), fmi2OK) << client.logged();
  const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf("  %.3f us a step inside a call\n", 1e6 * seconds / 40000);
  EXPECT_LT(seconds, 40000 * 0.5e-6 + 20 * 2e-6);
}
