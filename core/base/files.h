#pragma once
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace mill {
/// Writes a file with a unique name in the folder of the target and renames it, so that an interrupted run leaves
/// the old file or the new one, never half.  A target that is a link is replaced, not followed.
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
/// containers write into one folder, where process numbers repeat.
std::string random_name();

/// Name for what is written aside before it takes the place of `path`, in the same folder: "path.<random>.part";
/// of a name that would be too long with it, the beginning.
/// Whoever creates it uses O_EXCL or a library that writes new files.
std::string name_aside(const std::string &path, const std::string &ending = ".part");

/// Removes from a folder what write_atomically() of killed processes left there: "path.<random>.part" whose
/// writer's lock is free.  Files that may belong to a living one, or cannot be removed, stay.
void remove_stale_parts(const std::string &folder);

/// open(2) with O_CLOEXEC, repeated when a signal interrupts it: the descriptor, or -1 and errno.
int open_file(const std::string &path, int flags);

/// Names of the entries of a folder in alphabetical order, without "." and ".."; calls that a signal interrupts
/// are repeated.  Empty where `error` is set.
std::vector<std::string> names_in(const std::string &folder, std::error_code &error);
/// @throws SystemError or InputError with the path and the reason
std::vector<std::string> names_in(const std::string &folder);

/// Removes a folder and everything in it, as far as the system permits.
void remove_folder(const std::string &path);

/// flock(2), repeated when a signal interrupts it: false where another holds the lock or the file system knows
/// none.
bool lock_file(int file, int how);

/// Puts a file or folder on the disk (fsync); a file system that cannot do so for folders is accepted.
/// @throws SystemError with the path and the system's reason
void sync_to_disk(const std::string &path);

/// 64-bit FNV-1a as 16 hex digits: names caches and notices changes, not for security.
std::string hash_of(const std::string &bytes);

/// "pass 1" -> "pass-1": letters, digits and dashes, for file names.
std::string slug(const std::string &name);
}  // namespace mill
