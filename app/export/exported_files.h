#pragma once
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

/// Is this a format of matrices and equations (modelica, matlab, statespace)?
bool is_exchange_format(const std::string &format);

/// Where it goes without -o.
std::string usual_output(const std::string &format, const std::string &case_name);

/// Name of package or function: that of the file, since other programs look for it there.
/// @throws InputError  the ending or the name does not fit the format
std::string exchange_name(const std::string &format, const std::string &output);

/// The files of a format.  @param output  file, or folder of statespace
std::vector<ExportedFile> exchange_files(const std::string &format, const dynamics::ExchangedStand &stand,
                                         const std::string &output);

/// @throws InputError  a file that would be written beside the first one is there and was never written by an
/// export
void require_own_companions(const std::string &format, const std::vector<ExportedFile> &files);

/// @throws InputError  the output is there and is no earlier export of this case
void require_own(const std::string &format, const std::string &output, const std::string &case_name);
}  // namespace mill
