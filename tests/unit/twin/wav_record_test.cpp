// Sound files, made here byte by byte.
#include "tests/support/record_format_test.h"

using namespace mill;
using namespace mill::twin;
using namespace mill::record_format;

namespace {
class WavRecord : public RecordFormatTest {};
}  // namespace

TEST_F(WavRecord, SoundFilesHaveAScale)
{
  std::vector<int> samples(n);
  for (int i = 0; i < n; ++i)
    samples[std::size_t(i)] = (37 * i) % 101 - 50;
  const std::string file = wav(48000, {samples, samples});
  ReadOptions scaled;
  scaled.scales[""] = "50 mV/g";
  const auto record = read("r.wav", file, scaled);
  ASSERT_EQ(record.channels.size(), 2u);
  EXPECT_EQ(record.rate, 48000);
  EXPECT_TRUE(near(record.find("ch2")->value[1], (37 - 50) / 32768.0 / 0.05 * g, within(1e-12, doubles_kept)));
  EXPECT_TRUE(has_note(record, "full scale of the file was taken as 1 V"));
  scaled.scales[""] = "20 g";
  EXPECT_TRUE(near(read("s.wav", file, scaled).find("ch1")->value[0], -50 / 32768.0 * 20 * g,
                   within(1e-12, doubles_kept)));
  EXPECT_EQ(refusal("t.wav", file),
            "t.wav holds 2 channels (ch1 to ch2) in units of full scale; say what they mean, for "
            "example: millstand analyse t.wav --scale '50 mV/g'");
  scaled.scales[""] = "50 mV per g";
  EXPECT_EQ(refusal("u.wav", file, scaled), "--scale \"50 mV per g\" is not a sensitivity; write for example "
                                            "--scale \"50 mV/g\", --scale \"10 g/V\", or "
                                            "what full scale stands for, --scale \"20 g\"");
}

TEST_F(WavRecord, SoundFilesOfMoreThan4GiBSayTheirSizeElsewhere)
{
  const std::string usual = wav(48000, {std::vector<int>(n, 7)});
  const std::string form = usual.substr(12, 24), samples = usual.substr(44);
  const std::string behind = "LIST" + little(400, 4) + std::string(400, 'x');
  const auto large         = [&](const std::size_t size) {
    const std::string chunks = "WAVEds64" + little(28, 4) + little(72 + size + behind.size(), 8) +
                               little(size, 8) + little(n, 8) + little(0, 4) + form + "data" +
                               little(0xFFFFFFFF, 4);
    return "RF64" + little(0xFFFFFFFF, 4) + chunks + samples + behind;
  };
  ReadOptions scaled;
  scaled.scales[""] = "1 g/V";
  const auto record = read("r.wav", large(samples.size()), scaled);
  EXPECT_EQ(record.n_samples(), n);
  EXPECT_FALSE(has_note(record, "the head says more samples than the file holds"));
  EXPECT_EQ(record.channels[0].value.minCoeff(), record.channels[0].value.maxCoeff());
  // a recorder that was switched off has not written the size yet
  EXPECT_TRUE(has_note(read("s.wav", large(0), scaled), "the head says more samples than the file holds"));
}

// 24 bit in containers of four byte: read as three byte each, every later sample is another one.
TEST_F(WavRecord, BytesBetweenTheSamplesAreRefused)
{
  std::string file = wav(48000, {std::vector<int>(n, 7), std::vector<int>(n, 8)});
  EXPECT_EQ(refusal("r.wav", file).substr(0, 22), "r.wav holds 2 channels");
  file.replace(32, 2, little(8, 2));  // bytes of a row
  EXPECT_EQ(refusal("r.wav", file), "r.wav has rows of 8 byte, where 2 channels of 16 bit take 4; save it as PCM "
                                    "without bytes between the samples");
  EXPECT_EQ(refusal("s.wav", file.substr(0, 30)),
            "s.wav ends inside its head; it was cut off while it was written or copied");
}
