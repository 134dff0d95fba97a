#include "dynamics/fmu/archive.h"
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <unzip.h>
#include <zip.h>

namespace mill::fmu {
namespace {
// A file in memory that minizip reads and writes.
struct Memory {
  std::string bytes;
  std::size_t position = 0;
};

void *open_memory(void *opaque, const void *, int)
{
  return opaque;
}
uLong read_memory(void *opaque, void *, void *to, const uLong size)
{
  auto &m       = *static_cast<Memory *>(opaque);
  const uLong n = std::min<uLong>(size, m.bytes.size() - std::min(m.position, m.bytes.size()));
  std::memcpy(to, m.bytes.data() + m.position, n);
  m.position += n;
  return n;
}
uLong write_memory(void *opaque, void *, const void *from, const uLong size)
{
  auto &m = *static_cast<Memory *>(opaque);
  if (m.bytes.size() < m.position + size)
    m.bytes.resize(m.position + size);
  std::memcpy(&m.bytes[m.position], from, size);
  m.position += size;
  return size;
}
ZPOS64_T tell_memory(void *opaque, void *)
{
  return static_cast<Memory *>(opaque)->position;
}
long seek_memory(void *opaque, void *, const ZPOS64_T offset, const int origin)
{
  auto &m    = *static_cast<Memory *>(opaque);
  m.position = std::size_t(offset) + (origin == ZLIB_FILEFUNC_SEEK_CUR   ? m.position
                                      : origin == ZLIB_FILEFUNC_SEEK_END ? m.bytes.size()
                                                                         : 0);
  return 0;
}
int close_memory(void *, void *)
{
  return 0;
}
int error_of_memory(void *, void *)
{
  return 0;
}

zlib_filefunc64_def functions_of(Memory &memory)
{
  return {open_memory, read_memory,  write_memory,    tell_memory,
          seek_memory, close_memory, error_of_memory, &memory};
}

void require_done(const int code, const std::string &name)
{
  if (code != ZIP_OK)
    throw std::runtime_error("the archive cannot be made: minizip gives error " + std::to_string(code) + " for " +
                             name);
}
}  // namespace

std::string archive_of(const std::vector<ArchiveEntry> &entries)
{
  Memory memory;
  zlib_filefunc64_def functions = functions_of(memory);
  const zipFile zip             = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
  for (const ArchiveEntry &entry : entries) {
    constexpr uLong unix_2_0 = (3u << 8) | 20u, regular_file = 0100000;
    zip_fileinfo info{};
    info.tmz_date.tm_mday = 1;
    info.tmz_date.tm_year = 1980;
    info.external_fa      = (regular_file | (entry.executable ? 0755u : 0644u)) << 16;
    require_done(zipOpenNewFileInZip4_64(zip, entry.name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                                         Z_DEFLATED, Z_DEFAULT_COMPRESSION, 0, -MAX_WBITS, DEF_MEM_LEVEL,
                                         Z_DEFAULT_STRATEGY, nullptr, 0, unix_2_0, 0, 0),
                 entry.name);
    require_done(zipWriteInFileInZip(zip, entry.bytes.data(), unsigned(entry.bytes.size())), entry.name);
    require_done(zipCloseFileInZip(zip), entry.name);
  }
  require_done(zipClose(zip, nullptr), "the list of files");
  return memory.bytes;
}

std::vector<ArchiveEntry> entries_of(const std::string &archive)
{
  Memory memory{archive, 0};
  zlib_filefunc64_def functions = functions_of(memory);
  const unzFile zip             = unzOpen2_64("", &functions);
  if (!zip)
    throw std::runtime_error("the bytes are no zip archive");
  std::vector<ArchiveEntry> entries;
  bool whole = true;
  for (int code = unzGoToFirstFile(zip); code == UNZ_OK && whole; code = unzGoToNextFile(zip)) {
    unz_file_info64 info;
    char name[512];
    whole = unzGetCurrentFileInfo64(zip, &info, name, sizeof name, nullptr, 0, nullptr, 0) == UNZ_OK &&
            unzOpenCurrentFile(zip) == UNZ_OK;
    ArchiveEntry entry;
    entry.name       = name;
    entry.executable = ((info.external_fa >> 16) & 0100) != 0;
    char block[65536];
    for (int n = 1; whole && n > 0;) {
      n     = unzReadCurrentFile(zip, block, sizeof block);
      whole = n >= 0;
      if (n > 0)
        entry.bytes.append(block, std::size_t(n));
    }
    whole = whole && unzCloseCurrentFile(zip) == UNZ_OK;
    entries.push_back(std::move(entry));
  }
  unzClose(zip);
  if (!whole)
    throw std::runtime_error("the zip archive is damaged");
  return entries;
}
}  // namespace mill::fmu
