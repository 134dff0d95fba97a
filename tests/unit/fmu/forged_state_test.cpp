// A serialised state whose hash fits is whole, and not by that a state of this model: whoever has the file may
// have made it. None of these may be taken, since a step from it would read beyond its lists.
#include "tests/support/unit_client.h"
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

namespace {
constexpr std::size_t head_size = 8 + 3 * sizeof(std::uint64_t);

std::uint64_t number_in(const std::string &bytes, const std::size_t position)
{
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data() + position, sizeof number);
  return number;
}

template <class T> void put(std::string &bytes, const std::size_t position, const T &number)
{
  std::memcpy(bytes.data() + position, &number, sizeof number);
}

// FNV-1a, as the unit checks its bytes.
void sign(std::string &bytes)
{
  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t i = head_size; i < bytes.size(); ++i)
    hash = (hash ^ std::uint64_t(static_cast<unsigned char>(bytes[i]))) * 1099511628211u;
  put(bytes, 16, std::uint64_t(bytes.size() - head_size));
  put(bytes, 24, hash);
}

std::string state_of(Client2 &client)
{
  fmi2FMUstate state = nullptr;
  std::size_t size   = 0;
  EXPECT_EQ(FMI2(client, GetFMUstate)(client.c, &state), fmi2OK);
  EXPECT_EQ(FMI2(client, SerializedFMUstateSize)(client.c, state, &size), fmi2OK);
  std::string bytes(size, '\0');
  EXPECT_EQ(FMI2(client, SerializeFMUstate)(client.c, state, bytes.data(), size), fmi2OK);
  FMI2(client, FreeFMUstate)(client.c, &state);
  return bytes;
}

// What the client learns of these bytes; a state that is taken is stepped from.
int taken(Client2 &client, const std::string &bytes)
{
  fmi2FMUstate state = nullptr;
  const int status   = FMI2(client, DeSerializeFMUstate)(client.c, bytes.data(), bytes.size(), &state);
  if (status != fmi2OK)
    return status;
  EXPECT_EQ(FMI2(client, SetFMUstate)(client.c, state), fmi2OK);
  FMI2(client, FreeFMUstate)(client.c, &state);
  EXPECT_EQ(client.step(1e-3, 1e-3), fmi2OK) << client.logged();
  return status;
}
}  // namespace

TEST(ForgedState, WhatTheModelCannotHoldIsRefused)
{
  SampleStand stand = sample_stand();
  carry(stand.model, sample_force(50, 1e-4));
  Client2 client(stand.model);
  ASSERT_EQ(FMI2(client, SetupExperiment)(client.c, 0, 0, 0, 0, 0), fmi2OK);
  ASSERT_EQ(FMI2(client, EnterInitializationMode)(client.c), fmi2OK);
  ASSERT_EQ(FMI2(client, ExitInitializationMode)(client.c), fmi2OK);
  ASSERT_EQ(client.step(0, 1e-3), fmi2OK);
  const std::string state = state_of(client);
  ASSERT_EQ(taken(client, state), fmi2OK) << "its own";

  const std::size_t values = number_in(state, head_size), modes_at = head_size + 8 * (1 + values);
  const std::size_t modes = number_in(state, modes_at);
  ASSERT_EQ(modes, 6u);
  std::string no_modes =
      state.substr(0, modes_at) + std::string(16, '\0') + state.substr(modes_at + 2 * 8 * (1 + modes));
  sign(no_modes);
  EXPECT_EQ(taken(client, no_modes), fmi2Error);

  const auto with = [&](const std::size_t position, const auto number) {
    std::string bytes = state;
    put(bytes, position, number);
    sign(bytes);
    return bytes;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(taken(client, with(modes_at + 8, nan)), fmi2Error) << "a displacement that is not a number";
  EXPECT_EQ(taken(client, with(state.size() - 16, std::uint64_t(4))), fmi2Error)
      << "inside a step that was never begun";
  EXPECT_EQ(taken(client, with(head_size + 8 * (1 + std::size_t(client.at("M3"))), -1.0)), fmi2Error)
      << "a mass below zero";
  // The place in the recorded force follows from the time.
  EXPECT_EQ(taken(client, with(state.size() - 24, std::uint64_t(1) << 40)), fmi2OK);
}
