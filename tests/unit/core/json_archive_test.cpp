#include "core/base/errors.h"
#include "core/records/chatter_record.h"
#include "core/records/json_archive.h"
#include "core/records/models_record.h"
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

using namespace mill;

namespace archive_sample {
struct Inner {
  std::string name;
  int count = 0;
};
template <class Io, class R, if_record<R, Inner> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, count] = record;
  io("name", name);
  io("count", count);
}

struct Outer {
  double number = 7;
  bool flag     = false;
  Eigen::VectorXd vector;
  Eigen::MatrixXd matrix;
  std::vector<Inner> list;
  std::map<std::string, Inner> map;
  std::optional<Inner> present, absent;
  std::array<double, 2> pair{1, 2};
};
template <class Io, class R, if_record<R, Outer> = 0> void each_member(Io &&io, R &record)
{
  auto &[number, flag, vector, matrix, list, map, present, absent, pair] = record;
  io("number", number);
  io("flag", flag);
  io("vector", vector);
  io("matrix", matrix);
  io("list", list);
  io("map", map);
  io("present", present);
  io("absent", absent);
  io("pair", pair);
}
}  // namespace archive_sample

namespace {
using archive_sample::Inner;
using archive_sample::Outer;

Outer sample()
{
  Outer outer;
  outer.number = NAN;
  outer.flag   = true;
  outer.vector = Eigen::Vector3d(0.1, -INFINITY, 1e300);
  outer.matrix.resize(2, 3);
  outer.matrix << 1, 2, 3, 4, NAN, 6;
  outer.list    = {{"a", 1}, {"b", 2}};
  outer.map     = {{"key", {"c", 3}}};
  outer.present = Inner{"d \"quoted\"", 4};
  outer.pair    = {0.1, 0.2};
  return outer;
}

// Stands for a value of any type: an aggregate takes as many as it has members.
struct Anything {
  template <class T> operator T() const
  {
    return T();
  }
};
template <class T, std::size_t... i> auto takes(std::index_sequence<i...>) -> decltype(T{(i, Anything())...}, true)
{
  return true;
}
template <class T, std::size_t n, class = void> constexpr bool takes_n = false;
template <class T, std::size_t n>
constexpr bool takes_n<T, n, std::void_t<decltype(takes<T>(std::make_index_sequence<n>()))>> = true;

template <class T, std::size_t n = 30> constexpr std::size_t members()
{
  if constexpr (n == 0 || takes_n<T, n>)
    return n;
  else
    return members<T, n - 1>();
}

struct Counter {
  std::size_t n = 0;
  template <class T> void operator()(const char *, const T &)
  {
    ++n;
  }
};

// Every member of a record is in its list, but for those left out on purpose.
template <class Record> void expect_all_listed(const std::size_t left_out = 0)
{
  Counter listed;
  const Record record;
  each_member(listed, record);
  EXPECT_EQ(listed.n + left_out, members<Record>());
}
}  // namespace

TEST(JsonArchive, EverythingComesBack)
{
  const Outer before = sample(), after = record_of_json<Outer>(json_of_record(before));
  EXPECT_TRUE(std::isnan(after.number));
  EXPECT_TRUE(after.flag);
  ASSERT_EQ(after.vector.size(), 3);
  EXPECT_EQ(after.vector[0], 0.1) << "every bit";
  EXPECT_TRUE(std::isnan(after.vector[1])) << "JSON knows no infinity";
  EXPECT_EQ(after.vector[2], 1e300);
  ASSERT_EQ(after.matrix.rows(), 2);
  ASSERT_EQ(after.matrix.cols(), 3);
  EXPECT_EQ(after.matrix(1, 2), 6);
  EXPECT_TRUE(std::isnan(after.matrix(1, 1)));
  ASSERT_EQ(after.list.size(), 2u);
  EXPECT_EQ(after.list[1].name, "b");
  EXPECT_EQ(after.map.at("key").count, 3);
  ASSERT_TRUE(after.present);
  EXPECT_EQ(after.present->name, "d \"quoted\"");
  EXPECT_FALSE(after.absent);
  EXPECT_EQ(after.pair[1], 0.2);
  EXPECT_EQ(json_of_record(after), json_of_record(record_of_json<Outer>(json_of_record(after))));
}

TEST(JsonArchive, AMissingOrWronglyTypedEntryLeavesTheMemberUnchanged)
{
  const auto empty = record_of_json<Outer>("{}");
  EXPECT_EQ(empty.number, 7);
  EXPECT_EQ(empty.pair[0], 1);
  EXPECT_EQ(empty.matrix.size(), 0);
  const auto other =
      record_of_json<Outer>(R"({"number": "a text", "flag": 1, "vector": {}, "list": [3, {"name": 4}],
    "map": 1, "matrix": [[1], "x", [1, 2]], "present": [], "pair": [5], "an unknown name": 1})");
  EXPECT_EQ(other.number, 7);
  EXPECT_FALSE(other.flag);
  EXPECT_EQ(other.list.size(), 2u);
  EXPECT_FALSE(other.present);
  EXPECT_EQ(other.pair[0], 5);
  EXPECT_EQ(other.pair[1], 2);
  ASSERT_EQ(other.matrix.rows(), 3);
  EXPECT_TRUE(std::isnan(other.matrix(0, 1))) << "rows that are too short end in gaps";
}

TEST(JsonArchive, TextThatIsNotARecordIsRefused)
{
  for (const char *text : {"", "7", "[1]", "{\"a\": [", "{\"number\": 1e999}"})
    EXPECT_THROW(record_of_json<Outer>(text), InputError) << text;
  EXPECT_THROW(record_of_json<Outer>("{\"a\": " + std::string(100000, '[')), InputError) << "too deep";
}

TEST(Records, EveryMemberIsListed)
{
  expect_all_listed<Outer>();
  expect_all_listed<ChatterCritical>();
  expect_all_listed<ChatterHistoryInfo>();
  expect_all_listed<ChatterEventInfo>();
  expect_all_listed<LimitCycleInfo>();
  expect_all_listed<ChatterPoint>();
  expect_all_listed<ChatterPhases>();
  expect_all_listed<FiniteChange>();
  expect_all_listed<ChatterSensitivity>();
  expect_all_listed<ChatterVariantInfo>();
  expect_all_listed<ChatterConclusion>();
  expect_all_listed<ChatterPublished>();
  expect_all_listed<ChatterCondition>(1);  // the slug
  expect_all_listed<ChatterTandem>();
  expect_all_listed<ModelMode>();
  expect_all_listed<ModelLine>();
  expect_all_listed<ComparedModel>();
  expect_all_listed<Partner>();
  expect_all_listed<ModePartners>();
  expect_all_listed<MacTable>();
  expect_all_listed<MassesRow>();
  expect_all_listed<KeptModes>();
  expect_all_listed<PartMass>();
  expect_all_listed<MassBreakdown>();
  expect_all_listed<MassRoutes>();
  expect_all_listed<ModelsRecord>();
}
