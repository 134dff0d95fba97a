#pragma once
#include <optional>
#include <string>

namespace mill {
/// Writes beside the target under a name that nobody else has, and renames, so that an interrupted run leaves the
/// old file or the new one, never half.  A target that is a link is replaced, not followed.
/// @throws SystemError when the system refuses it (disk, permission), InputError when the name is wrong, with the
/// path and the reason; a pipe or a device is refused
void write_atomically(const std::string &path, const std::string &text);

/// Whole file as text.  A pipe, a device or a socket is refused: reading it may never end.
/// @throws InputError  not there, not a regular file, not permitted, or larger than memory; SystemError  the disk
///         refuses it
std::string read_text(const std::string &path);

/// As read_text, but nothing where that would throw.
std::optional<std::string> text_if_readable(const std::string &path);

/// 16 hex digits from the system's random numbers: names what processes on several machines or in several
/// containers write beside each other, where process numbers repeat.
std::string random_name();

/// Name for what is written aside before it takes the place of `path`, in the same folder: "path.<random>.part".
/// Whoever creates it uses O_EXCL or a library that writes new files.
std::string name_aside(const std::string &path, const std::string &ending = ".part");

/// Removes from a folder what write_atomically() of killed processes left there: "path.<random>.part" whose
/// writer's lock is free.  What cannot be told from a living one, or not removed, stays.
void remove_stale_parts(const std::string &folder);

/// flock(2), made again when interrupted: false where another holds the lock or the file system knows none.
bool lock_file(int file, int how);

/// Puts a file or folder on the disk (fsync); a file system that cannot do so for folders is no error.
/// @throws SystemError with the path and the system's reason
void sync_to_disk(const std::string &path);

/// 64-bit FNV-1a as 16 hex digits: names caches and notices changes, not for security.
std::string hash_of(const std::string &bytes);

/// "pass 1" -> "pass-1": letters, digits and dashes, for file names.
std::string slug(const std::string &name);
}  // namespace mill
