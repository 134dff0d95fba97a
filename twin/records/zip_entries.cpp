#include "twin/records/zip_entries.h"
#include "core/base/errors.h"
#include "core/base/input_file.h"
#include "twin/records/binary_numbers.h"
#include "twin/records/inflate.h"
#include <fmt/format.h>
#include <zlib.h>

namespace mill::twin {
namespace {
constexpr std::size_t too_many = 0xFFFF, too_large = 0xFFFFFFFF;  // the number is in a part of Zip64

[[noreturn]] void refuse_zip(const std::string &file)
{
  throw InputError(file + " is not a whole zip archive; it was cut off while it was written or copied");
}

// A number of two or four bytes.
std::size_t number_in_zip(const std::string &file, const std::string_view archive, const std::size_t position,
                          const int size)
{
  if (position > archive.size() || archive.size() - position < std::size_t(size))
    refuse_zip(file);
  return std::size_t(number_at(archive.data() + position, {'u', size, false}));
}

std::string_view bytes_in_zip(const std::string &file, const std::string_view archive, const std::size_t position,
                              const std::size_t n)
{
  if (position > archive.size() || archive.size() - position < n)
    refuse_zip(file);
  return archive.substr(position, n);
}
}  // namespace

std::vector<ZipEntry> zip_entries(const std::string &file, const std::string_view archive)
{
  const auto end = archive.rfind(std::string_view("PK\5\6", 4));
  if (end == std::string_view::npos)
    refuse_zip(file);
  const auto number = [&](const std::size_t position, const int size) {
    return number_in_zip(file, archive, position, size);
  };
  const std::size_t n      = number(end + 10, 2);
  std::size_t position     = number(end + 16, 4);
  const auto require_small = [&](const bool is_small) {
    if (!is_small)
      throw InputError(file + " is a zip archive of 4 GiB and more; save the arrays into several files");
  };
  require_small(n < too_many && position < too_large);
  std::vector<ZipEntry> entries;
  for (std::size_t i = 0; i < n; ++i) {
    if (bytes_in_zip(file, archive, position, 4) != std::string_view("PK\1\2", 4))
      refuse_zip(file);
    const std::size_t name = number(position + 28, 2), extra = number(position + 30, 2),
                      comment = number(position + 32, 2);
    const std::size_t local   = number(position + 42, 4);
    ZipEntry entry;
    entry.method = int(number(position + 10, 2));
    entry.check  = std::uint32_t(number(position + 16, 4));
    entry.size   = number(position + 24, 4);
    require_small(local < too_large && entry.size < too_large && number(position + 20, 4) < too_large);
    entry.name = std::string(bytes_in_zip(file, archive, position + 46, name));
    if (bytes_in_zip(file, archive, local, 4) != std::string_view("PK\3\4", 4))
      refuse_zip(file);
    entry.packed = bytes_in_zip(file, archive, local + 30 + number(local + 26, 2) + number(local + 28, 2),
                                number(position + 20, 4));
    entries.push_back(std::move(entry));
    position += 46 + name + extra + comment;
  }
  return entries;
}

std::string unpacked(const std::string &file, const ZipEntry &entry)
{
  if (entry.method != 0 && entry.method != 8)
    throw InputError(fmt::format("{} holds '{}' packed by another method than deflate; save it with numpy.savez",
                                 file, entry.name));
  require_memory(file, double(entry.packed.size()), 2.0 * double(entry.size));
  std::optional<std::string> bytes =
      entry.method == 0 ? std::string(entry.packed) : inflated(entry.packed, Deflated::raw, entry.size);
  if (!bytes || crc32_z(0, reinterpret_cast<const Bytef *>(bytes->data()), bytes->size()) != entry.check)
    throw InputError(fmt::format("{} holds '{}', which is damaged", file, entry.name));
  return std::move(*bytes);
}
}  // namespace mill::twin
