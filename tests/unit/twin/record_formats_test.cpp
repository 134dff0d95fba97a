// What holds for records of every format: scales, names that are not UTF-8, damaged files.
#include "tests/support/record_format_test.h"
#include "twin/records/inflate.h"

using namespace mill;
using namespace mill::twin;
using namespace mill::record_format;

namespace {
class RecordFormats : public RecordFormatTest {};
}  // namespace

TEST_F(RecordFormats, VoltagesOfAnyFormatTakeAScale)
{
  std::string text = "time [s],a [mV],b [g]\n";
  for (int i = 0; i < n; ++i)
    text += std::to_string(i) + "e-3," + std::to_string((37 * i) % 101) + "," + std::to_string(i % 13) + "\n";
  ReadOptions scaled;
  scaled.scales["a"] = "100 mV/g";
  const auto record  = read("r.csv", text, scaled);
  EXPECT_TRUE(near(record.find("a")->value[1], 0.37 * g, within(1e-12, doubles_kept)));
  EXPECT_TRUE(near(record.find("b")->value[1], g, within(1e-12, doubles_kept)));
}

TEST_F(RecordFormats, NamesThatAreNotUtf8AreMadeValidInEveryFormat)
{
  const auto expect_name = [&](const RawRecord &record) { EXPECT_EQ(record.channels[0].name, "Kr\u00e4fte"); };
  ReadOptions options    = in_g({"Kr\u00e4fte"});
  expect_name(read("r.mat",
                   mat_file(mat_array("Kr\xE4"
                                      "fte",
                                      swings()) +
                            mat_array("fs", {1000})),
                   options));
  expect_name(read("r.npz",
                   zip({{"Kr\xE4"
                         "fte.npy",
                         npy(swings(), "(3000,)")},
                        {"fs.npy", npy({1000}, "()")}}),
                   options));
  UffSet set;
  set.numbers = even_numbers();
  set.id1     = "Kr\xE4"
                "fte";
  expect_name(read("r.uff", uff(set), options));
  std::string text = "Zeit [s];Kr\xE4"
                     "fte [kN]\n";
  for (int i = 0; i < n; ++i)
    text += std::to_string(i) + "e-3;" + std::to_string((37 * i) % 101) + "\n";
  const auto record = read("Walzger\xFC"
                           "st.csv",
                           text);
  expect_name(record);
  EXPECT_EQ(record.file, folder + "/Walzger\u00fcst.csv");
}

TEST_F(RecordFormats, ArchivesThatUnpackWithoutEndAreRefused)
{
  const std::string million(1 << 20, 'a');
  EXPECT_EQ(inflated(zlib_stream(million), Deflated::zlib, million.size()).value_or(""), million);
  EXPECT_FALSE(inflated(zlib_stream(million), Deflated::zlib, 1000)) << "more than was announced";
  EXPECT_FALSE(inflated(zlib_stream(million), Deflated::zlib, 2 << 20)) << "less than was announced";
  EXPECT_FALSE(inflated("\x78\x01nonsense", Deflated::zlib, 10));
  // a variable that announces 4 GiB and holds nothing
  const std::string packed = zlib_stream(little(14, 4) + little(0xFFFFFFF0, 4) + "short");
  EXPECT_NE(refusal("r.mat", mat_file(little(15, 4) + little(packed.size(), 4) + packed)), "accepted");
}

// Hostile bytes: whatever a file holds, it is read or refused, and what is read is valid UTF-8.
TEST_F(RecordFormats, DamagedFilesOfEveryFormatAreReadOrRefused)
{
  UffSet set;
  set.numbers     = even_numbers();
  std::string csv = "time [s];a [g];coil\n",
              lvm = "LabVIEW Measurement\nX_Columns\tOne\n***End_of_Header***\nChannels\t1\n"
                    "Delta_X\t0.001\n***End_of_Header***\nX_Value\tchock\n";
  for (int i = 0; i < n; ++i) {
    csv += std::to_string(i) + "e-3;" + std::to_string((37 * i) % 101) + ";K" + std::to_string(i / 1000) + "\n";
    lvm += std::to_string(i) + "e-3\t" + std::to_string((37 * i) % 101) + "\n";
  }
  const std::vector<std::pair<std::string, std::string>> files{
      {"d.mat", mat_file(mat_structure("run", {{"a", mat_array("", swings())}, {"fs", mat_array("", {1000})}}))},
      {"e.mat", mat_file(mat_compressed(mat_array("a", swings())))},
      {"d.npz", zip({{"a.npy", npy(swings(), "(3000,)")}, {"fs.npy", npy({1000}, "()")}})},
      {"d.wav", wav(1000, {std::vector<int>(n, 7)})},
      {"d.uff", uff(set)},
      {"d.csv", csv},
      {"d.lvm", lvm}};
  std::uint64_t state = 20261127;
  const auto random   = [&](const std::uint64_t below) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state % below;
  };
  int read_ones = 0, refused = 0;
  for (const auto &[name, whole] : files)
    for (int i = 0; i < 60; ++i) {
      std::string bytes = whole;
      for (std::uint64_t k = 0; k <= random(6); ++k)  // most of them in the head
        bytes[random(random(2) ? std::min<std::size_t>(bytes.size(), 400) : bytes.size())] = char(random(256));
      if (random(4) == 0)
        bytes.resize(random(bytes.size()) + 1);
      ReadOptions options;
      options.scales[""] = "50 mV/g";
      if (random(2))
        options.rate = 1000;
      try {
        const auto record = read(name, bytes, options);
        EXPECT_GE(record.n_samples(), 2048);
        ++read_ones;
      } catch (const InputError &) {
        ++refused;
      }
    }
  EXPECT_EQ(read_ones + refused, int(60 * files.size()));
  EXPECT_GT(read_ones, 40);
  EXPECT_GT(refused, 40);
}
