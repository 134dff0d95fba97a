// Arrays of numpy (.npy) and archives of them (.npz), made here byte by byte.
#include "tests/support/record_format_test.h"

using namespace mill;
using namespace mill::twin;
using namespace mill::record_format;

namespace {
class NumpyRecord : public RecordFormatTest {};
}  // namespace

TEST_F(NumpyRecord, ArchivesOfNumpyAreRead)
{
  const std::string archive = zip({{"a.npy", npy(swings(), "(3000,)")},
                                   {"fs.npy", npy({1000}, "()")},
                                   {"both.npy", npy(std::vector<double>(6000, 1), "(3000, 2)")}});
  const auto record         = read("r.npz", archive, in_g({"a"}));
  expect_swing(record, "a");
  EXPECT_EQ(record.rate, 1000);
  EXPECT_NE(record.find("both_2"), nullptr);
  file("s.json", R"({"rate": 500, "units": {"a": "g"}})");
  EXPECT_EQ(read("s.npz", zip({{"a.npy", npy(swings(), "(3000,)")}})).rate, 500);
  EXPECT_EQ(refusal("t.npz", archive.substr(0, 1000)),
            "t.npz is not a whole zip archive; it was cut off while it was written or copied");
}

// t_ms of 0, 1, 2 .. once gave a rate of 1 Hz.
TEST_F(NumpyRecord, AUnitBehindTheNameOfATimeIsItsUnit)
{
  std::vector<double> milliseconds(3000);
  for (std::size_t i = 0; i < milliseconds.size(); ++i)
    milliseconds[i] = double(i);
  const auto record =
      read("r.npz", zip({{"a.npy", npy(swings(), "(3000,)")}, {"t_ms.npy", npy(milliseconds, "(3000,)")}}),
           in_g({"a"}));
  EXPECT_TRUE(near(record.time[2999], 2.999, within(1e-12, "whole milliseconds, rounded once")));
}

// Three numbers in a field make a row longer than its field names say.
TEST_F(NumpyRecord, FieldsOfSeveralNumbersInArraysOfNumpyAreRefused)
{
  std::string head =
      "{'descr': [('t', '<f8'), ('a [g]', '<f4', (3,))], 'fortran_order': False, 'shape': (3000,), }";
  head.resize(117, ' ');
  const std::string array =
      "\x93NUMPY" + std::string("\1\0\x76\0", 4) + head + "\n" + std::string(3000 * (8 + 3 * 4), '\1');
  const std::string reason = "holds several numbers in one field of a structured array; save a field for each";
  file("r.json", R"({"rate": 1000})");
  EXPECT_EQ(refusal("r.npy", array), "r.npy " + reason);
  // an archive is read without it
  const std::string archive =
      zip({{"a.npy", npy(swings(), "(3000,)")}, {"fs.npy", npy({1000}, "()")}, {"run.npy", array}});
  EXPECT_EQ(refusal("s.npz", archive, in_g({"a"})), "accepted");
  EXPECT_NE(refusal("s.npz", archive, in_g({"a", "run.t"})), "accepted");
}
