#pragma once
#include <string>
#include <vector>

// What is printed from the rows of the parameters: template, schema, reference.
namespace mill {
/// Commented case file of a kind, or of a named stack, that runs as it is; keys that may be left out without a
/// default stand as comments.
/// @throws InputError  none of template_names()
std::string template_of(const std::string &kind);

/// The kinds of case, then "stack-2" .. for stacks of so many rolls.
std::vector<std::string> template_names();

/// JSON Schema (draft-07) of the case file for editors.  A schema cannot compare "1450 mm" with a number, so unit,
/// range and default stand in the descriptions and a quantity is checked by its pattern only.
std::string case_schema();

/// docs/input.md: every section once, with its keys and the kinds that read it.
std::string input_reference();
}  // namespace mill
