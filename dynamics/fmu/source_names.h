#pragma once
#include <string>

namespace mill::fmu {
/// Name of the header that the sources of a unit include first.
constexpr const char *names_header = "function_prefix.h";

/// That header: functions of the interface get the prefix "<identifier>_" and our namespace a name of this unit,
/// so that several units can be linked into one program.  FMI2_OVERRIDE_FUNCTION_PREFIX and
/// FMI3_OVERRIDE_FUNCTION_PREFIX, as the standard names them, leave the plain names for a shared library.
std::string source_names(const std::string &identifier);

/// Not a header.
bool is_compiled(const std::string &file);

/// Text of a source as it travels: one that is compiled includes the header first.
std::string travelling_source(const std::string &name, const std::string &text);
}  // namespace mill::fmu
