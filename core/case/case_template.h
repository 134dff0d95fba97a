#pragma once
#include "core/case/kinds.h"
#include <map>
#include <optional>
#include <string>
#include <vector>

// Templates: a section of a kind with the values that its template sets.
namespace mill {
/// One section of a template with what its kind says of it.
struct FilledSection {
  const SectionRows *section;
  TemplateNote note;
};

/// The sections of a kind with the values its template needs; one that is named twice stands twice.
std::vector<FilledSection> filled_sections(const CaseKind &kind);

/// Value of a row as the template sets it, TOML; nothing where its line is a comment.
std::optional<std::string> template_value(const CaseKind &kind, const FilledSection &filled, const Row &row);

/// The template with other values.
std::string template_text(const CaseKind &kind, const std::vector<FilledSection> &sections);

/// Where a drawing or a record has the value of a key, according to any kind; empty: no kind says so.
/// @param section  its id
std::string where_to_find(const std::string &section, const std::string &key);

/// Keys whose values are those of the template and not named in `confirmed` ("all", sections and keys parted by
/// blanks): numbers that the user may have forgotten to replace.  A default does not count as such.  Kinds without
/// drawing values have none.
/// @param written  full key -> value as written, Reading::written
std::vector<std::string> left_at_template(const CaseKind &kind, const std::map<std::string, std::string> &written,
                                          const std::string &confirmed);

/// What is wrong with the key `confirmed`: a name that no key and no section of this kind has; empty: all is
/// right.
std::string unknown_in_confirmed(const CaseKind &kind, const std::string &confirmed);
}  // namespace mill
