#pragma once
#include "app/command/option_words.h"
#include <string>
#include <vector>

namespace mill {
namespace dynamics {
struct ExchangedStand;
}

/// A file that an export writes.
struct ExportedFile {
  std::string path;
  std::string text;
};

/// File or folder that is written without -o.
std::string usual_output(ExportFormat format, const std::string &case_name);

/// Name of package or function: that of the file, since other programs look for it there.
/// @throws InputError  the ending does not fit the format, or the name is a word of the language or hides a
/// library or
///         a function that the file itself uses
std::string exchange_name(ExportFormat format, const std::string &output);

/// The files of a format.  @param output  file, or folder of statespace
std::vector<ExportedFile> exchange_files(ExportFormat format, const dynamics::ExchangedStand &stand,
                                         const std::string &output);

/// @throws InputError  a further file of the export exists and was not written by an export
void require_own_companions(ExportFormat format, const std::vector<ExportedFile> &files);

/// @throws InputError  the output exists and is not an earlier export of this case
void require_own(ExportFormat format, const std::string &output, const std::string &case_name);

/// Writes all files of an export, or none of them: each next to its target under another name, then all are
/// renamed.
/// @param folder  made where it is missing, and removed again when the files cannot be written; empty: none
/// @throws SystemError, InputError  as write_atomically(); files that existed before are then as they were
void write_together(const std::vector<ExportedFile> &files, const std::string &folder);
}  // namespace mill
