#pragma once
#include <string>

// What is printed from the rows of the parameters: template, schema, reference.
namespace mill {
/// Commented case file of a kind that runs as it is; keys that may be left out without a default stand as
/// comments.
/// @throws InputError  kind not handled by this version
std::string template_of(const std::string &kind);

/// JSON Schema (draft-07) of the case file for editors.  A schema cannot compare "1450 mm" with a number, so unit,
/// range and default stand in the descriptions and a quantity is checked by its pattern only.
std::string case_schema();

/// docs/input.md: every section once, with its keys and the kinds that read it.
std::string input_reference();
}  // namespace mill
