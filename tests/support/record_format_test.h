#pragma once
#include "tests/support/near.h"
#include "tests/support/record_files.h"
#include "tests/support/record_test.h"
#include <cmath>
#include <cstdio>

// What the tests of the record formats share: samples, their scale, and text of universal files.
namespace mill::record_format {
using namespace mill::record_files;

constexpr int n = 3000;

inline std::vector<double> swings(const double scale = 1)
{
  std::vector<double> values(n);
  for (int i = 0; i < n; ++i)
    values[std::size_t(i)] = scale * 0.01 * ((37 * i) % 101 - 50);
  return values;
}

inline twin::ReadOptions in_g(const std::vector<std::string> &columns)
{
  twin::ReadOptions options;
  for (const std::string &column : columns) {
    options.units[column] = "g";
    options.asked.push_back(column);
  }
  return options;
}

constexpr double g                 = 9.80665;  // m/s2
constexpr const char *doubles_kept = "doubles are kept to the last bit but for the factor of the unit";

class RecordFormatTest : public RecordTest {
protected:
  void expect_swing(const twin::RawRecord &record, const std::string &name, const double scale = 1)
  {
    const twin::RawChannel *channel = record.find(name);
    ASSERT_NE(channel, nullptr) << name;
    ASSERT_EQ(channel->value.size(), n);
    for (const int i : {0, 1, n - 1})
      EXPECT_TRUE(near(channel->value[i], scale * g * swings()[std::size_t(i)], within(1e-12, doubles_kept)));
  }
};

inline std::string printed(const char *form, const double x)
{
  char text[64];
  std::snprintf(text, sizeof text, form, x);
  return text;
}

// Data set 58 in text.
struct UffSet {
  std::string id1 = "NONE", id5 = "NONE", entity = "NONE", unit = "m/s2", axis_unit = "s", axis = "Time";
  int node = 1, direction = 3, function = 1, axis_kind = 17;
  std::string numbers;
  int type = 2, even = 1;
  double first = 0, step = 1e-3;
};

inline std::string uff(const UffSet &set)
{
  char head[400];
  std::snprintf(head, sizeof head, "%5d%10d%5d%10d %-10s%10d%4d %-10s%10d%4d\n%10d%10d%10d%13.5E%13.5E%13.5E\n",
                set.function, 0, 0, 0, set.entity.c_str(), set.node, set.direction, "NONE", 0, 0, set.type, n,
                set.even, set.first, set.step, 0.0);
  const auto axis = [](const int kind, const std::string &label, const std::string &unit) {
    char line[200];
    std::snprintf(line, sizeof line, "%10d%5d%5d%5d %-20s %-20s\n", kind, 0, 0, 0, label.c_str(), unit.c_str());
    return std::string(line);
  };
  return "    -1\n    58\n" + set.id1 + "\nNONE\nNONE\nNONE\n" + set.id5 + "\n" + head +
         axis(set.axis_kind, set.axis, set.axis_unit) + axis(12, "Acceleration", set.unit) +
         axis(0, "NONE", "NONE") + axis(0, "NONE", "NONE") + set.numbers + "    -1\n";
}

inline std::string even_numbers()
{
  std::string text;
  const auto values = swings();
  for (int i = 0; i < n; ++i)
    text += printed("%13.5E", values[std::size_t(i)]) + (i % 6 == 5 || i + 1 == n ? "\n" : "");
  return text;
}
}  // namespace mill::record_format
