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

// Stored arrays have no check of their own; a bit that fell over in one was read as another number.
TEST_F(NumpyRecord, ArraysThatDoNotFitTheirCheckAreRefused)
{
  EXPECT_EQ(crc32_of("123456789"), 0xCBF43926u) << "the check value of every description of CRC-32";
  std::string archive = zip({{"a.npy", npy(swings(), "(3000,)")}, {"fs.npy", npy({1000}, "()")}});
  EXPECT_EQ(refusal("r.npz", archive, in_g({"a"})), "accepted");
  archive[5000] ^= 0x40;
  EXPECT_EQ(refusal("r.npz", archive, in_g({"a"})), "r.npz holds 'a.npy', which is damaged");
}

TEST_F(NumpyRecord, ArchivesOf4GiBAreRefusedAsSuch)
{
  const std::string whole = zip({{"a.npy", npy(swings(), "(3000,)")}});
  const auto entry        = whole.find("PK\1\2");
  for (const std::size_t field : {20, 24, 42}) {  // of the directory: size packed, unpacked, place in the archive
    std::string large = whole;
    large.replace(entry + field, 4, little(0xFFFFFFFF, 4));
    EXPECT_EQ(refusal("r.npz", large, in_g({"a"})),
              "r.npz is a zip archive of 4 GiB and more; save the arrays into several files");
  }
}

// numpy.dtype(.., align=True) saves the bytes between its fields as fields without a name.
TEST_F(NumpyRecord, FieldsMayHaveBytesBetweenThem)
{
  std::string head =
      "{'descr': [('a', '|u1'), ('', '|V7'), ('force', '<f8')], 'fortran_order': False, 'shape': (3000,), }";
  head.resize(117, ' ');
  std::string array = "\x93NUMPY" + std::string("\1\0\x76\0", 4) + head + "\n";
  for (int i = 0; i < n; ++i)
    array += little(std::uint64_t(i % 101), 1) + std::string(7, '\x55') + doubles({1e3 + i % 7});
  file("r.json", R"({"rate": 1000, "units": {"a": "m/s2", "force": "N"}})");
  const auto record = read("r.npy", array);
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.find("a")->value[n - 1], (n - 1) % 101);
  EXPECT_EQ(record.find("force")->value[n - 1], 1e3 + (n - 1) % 7);
  EXPECT_TRUE(read("r.npy", array).notes.empty());
  EXPECT_TRUE(has_note(read("r.npy", array + "second"), "6 byte behind the array were not used"));
}
