#include "core/base/choice.h"
#include "core/base/input_file.h"
#include "twin/records/binary_numbers.h"
#include "twin/records/channel_names.h"
#include <cmath>
#include <fmt/format.h>

// Sound files: PCM of 8 to 32 bit and floating point, RIFF and RF64 with one run of samples.
// Sources: Microsoft and IBM, Multimedia Programming Interface and Data Specifications 1.0 (1991), chapter 3; EBU
// Tech 3306, RF64: an extended file format for audio (2009).
namespace mill::twin {
namespace {
// First four bytes of a file, and of the chunks of it that are read.
enum class WavForm { usual, of_64_bits };
constexpr auto words_of(WavForm)
{
  return choice_words<WavForm>("RIFF", "RF64");
}
enum class WavChunk { format, samples, sizes };
constexpr auto words_of(WavChunk)
{
  return choice_words<WavChunk>("fmt ", "data", "ds64");
}

struct WavFormat {
  int coding = 0, channels = 0, bits = 0;  // coding 1: PCM, 3: floating point
  double rate = 0;                         // Hz
};

constexpr int most_wav_channels = 1024;
constexpr double size_elsewhere = 0xFFFFFFFF;  // of a chunk: it is in 'ds64'

[[noreturn]] void refuse_wav(const std::string &file, const std::string &what)
{
  throw InputError(file + " " + what);
}

WavFormat wav_format(const std::string &bytes, const std::string &path)
{
  const auto number = [&](const std::size_t position, const int size) {
    return position + std::size_t(size) <= bytes.size() ? number_at(&bytes[position], {'u', size, false}) : 0.0;
  };
  if (bytes.size() < 16)
    refuse_wav(path, "ends inside its head; it was cut off while it was written or copied");
  WavFormat format{int(number(0, 2)), int(number(2, 2)), int(number(14, 2)), number(4, 4)};
  if (format.coding == 0xFFFE)  // extensible: the coding is at the head of an identifier
    format.coding = int(number(24, 2));
  const bool whole =
      format.coding == 1 && (format.bits == 8 || format.bits == 16 || format.bits == 24 || format.bits == 32);
  const bool real = format.coding == 3 && (format.bits == 32 || format.bits == 64);
  if (!whole && !real)
    refuse_wav(path,
               fmt::format("holds samples of coding {} with {} bits; save PCM of 8 to 32 bit or floating point",
                           format.coding, format.bits));
  if (format.channels < 1 || format.channels > most_wav_channels || !(format.rate > 0))
    refuse_wav(path, fmt::format("has {} channel{} at {} Hz, which is not possible", format.channels,
                                 format.channels == 1 ? "" : "s", format.rate));
  if (const int row = int(number(12, 2)), packed = format.channels * format.bits / 8; row > 0 && row != packed)
    refuse_wav(path,
               fmt::format("has rows of {} byte, where {} channels of {} bit take {}; save it as PCM without "
                           "bytes between the samples",
                           row, format.channels, format.bits, packed));
  return format;
}

// One sample in units of full scale.
double wav_sample(const char *bytes, const WavFormat &format)
{
  if (format.coding == 3)
    return number_at(bytes, {'f', format.bits / 8, false});
  if (format.bits == 8)
    return (number_at(bytes, {'u', 1, false}) - 128) / 128;
  if (format.bits == 24) {
    const char wide[4] = {0, bytes[0], bytes[1], bytes[2]};
    return number_at(wide, {'i', 4, false}) / 2147483648.0;
  }
  return number_at(bytes, {'i', format.bits / 8, false}) / std::ldexp(1.0, format.bits - 1);
}

// Bytes of the samples by the chunk 'ds64' of an RF64 file: behind the 8 bytes of the size of the file.  0: not
// written, as by a recorder that was switched off.
double size_of_samples(InputFile &file)
{
  char bytes[16] = {};
  return file.read(bytes, 16) == 16 ? number_at(&bytes[8], {'u', 8, false}) : 0;
}

std::vector<Eigen::VectorXd> wav_samples(InputFile &file, const WavFormat &format, const double size,
                                         const std::string &path)
{
  const std::size_t width = std::size_t(format.bits / 8), row = width * std::size_t(format.channels);
  const auto n = Eigen::Index(size / double(row));
  require_memory(path, file.size(), 8.0 * double(n) * double(format.channels));
  std::vector<Eigen::VectorXd> columns(std::size_t(format.channels), Eigen::VectorXd(n));
  std::string block(row * 4096, '\0');
  for (Eigen::Index first = 0; first < n; first += 4096) {
    const auto rows = std::min<Eigen::Index>(4096, n - first);
    if (file.read(block.data(), std::size_t(rows) * row) != std::size_t(rows) * row)
      refuse_wav(path, "is shorter than its head says; it was cut off while it was written or copied");
    for (Eigen::Index r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns.size(); ++c)
        columns[c][first + r] = wav_sample(&block[std::size_t(r) * row + c * width], format);
  }
  return columns;
}
}  // namespace

RawRecord read_wav_record(const std::string &path, const ReadOptions &options)
{
  InputFile file(path);
  std::string head(12, '\0');
  head.resize(file.read(head.data(), 12));
  if (head.size() < 12 || !choice_named<WavForm>(head.substr(0, 4)) || head.substr(8) != "WAVE")
    refuse_wav(path, "is not a WAV file: it does not begin with RIFF .. WAVE");
  RawRecord record;
  record.file   = path;
  record.format = "WAV";
  WavFormat format;
  double position = 12, long_size = 0;
  while (true) {
    std::string chunk(8, '\0');
    file.go_to(std::size_t(position));
    if (file.read(chunk.data(), 8) != 8)
      refuse_wav(path, "has no samples (chunk 'data'); it was cut off while it was written or copied");
    double size     = number_at(&chunk[4], {'u', 4, false});
    const auto left = file.size() - position - 8;
    const auto kind = choice_named<WavChunk>(chunk.substr(0, 4));
    if (kind == WavChunk::format) {
      std::string bytes(std::size_t(std::min(size, 64.0)), '\0');
      bytes.resize(file.read(bytes.data(), bytes.size()));
      format = wav_format(bytes, path);
    }
    if (kind == WavChunk::sizes)
      long_size = size_of_samples(file);
    if (kind == WavChunk::samples) {
      if (format.coding == 0)
        refuse_wav(path, "has samples before it says how they are written (chunk 'fmt ')");
      if (size == size_elsewhere && long_size > 0)
        size = long_size;
      if (size > left) {  // a recorder that was switched off, or more than 4 GiB
        record.notes.push_back("the head says more samples than the file holds; those there are were read");
        size = left;
      }
      auto columns = wav_samples(file, format, size, path);
      record.rate  = options.rate ? *options.rate : format.rate;
      for (std::size_t c = 0; c < columns.size(); ++c)
        add_channel(record, {fmt::format("ch{}", c + 1), ""}, {path, 0, 0}, options, std::move(columns[c]));
      break;
    }
    position += 8 + size + (std::fmod(size, 2) > 0 ? 1 : 0);
  }
  if (!options.scales.empty() && format.coding == 1)
    record.notes.push_back(
        "full scale of the file was taken as 1 V; with another, multiply the sensitivity by 1 V over "
        "it, or say what full scale stands for, --scale \"20 g\"");
  if (options.from_case)
    throw InputError(path +
                     " holds numbers in units of full scale and no unit; export the record as CSV with units");
  const std::vector<std::string> &asked = options.asked;
  if (options.scales.empty() && options.units.empty() && asked.empty())
    throw InputError(fmt::format("{} holds {} channel{} (ch1{}) in units of full scale; say what they mean, for "
                                 "example: {}",
                                 path, format.channels, format.channels == 1 ? "" : "s",
                                 format.channels == 1 ? "" : fmt::format(" to ch{}", format.channels),
                                 command_with(options, path, "--scale '50 mV/g'")));
  require_usable_channels(record, options, "say what full scale stands for, --scale \"20 g\", or the unit");
  return record;
}
}  // namespace mill::twin
