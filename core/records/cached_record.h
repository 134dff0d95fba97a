#pragma once
#include "core/base/files.h"
#include "core/records/binary_archive.h"
#include "core/records/cache_entry.h"

namespace mill {
/// Keeps a record in the cache under the hash of everything it depends on (core/records/cache_entry.h).  An entry
/// says which members the record has: of another list it is not read.
/// @throws SystemError  cannot be written
template <class Record> void save_record(const std::string &path, const std::string &key, const Record &record)
{
  write_cache_entry(path, "millstand record " + hash_of(layout_of<Record>()), key, bytes_of_record(record));
}

/// The kept record, or nothing when there is none or when it cannot be used; then `note` says why.
template <class Record>
std::optional<Record> load_record(const std::string &path, const std::string &key, std::string *note = nullptr)
{
  const auto bytes = read_cache_entry(path, "millstand record " + hash_of(layout_of<Record>()), key, note);
  auto record      = bytes ? record_of_bytes<Record>(*bytes) : std::nullopt;
  if (bytes && !record && note)
    *note = path + " is not used: it is incomplete";
  return record;
}
}  // namespace mill
