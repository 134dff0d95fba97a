#pragma once
#include "core/base/choice.h"

namespace mill {
/// Contacts of bodies of revolution, as results and files name them: of the rolls of a stand, and of kind
/// "two-cylinders" in plane strain and in space.
enum class ContactName { upper, lower, line, space };
constexpr auto words_of(ContactName)
{
  return choice_words<ContactName>("upper", "lower", "line", "space");
}

/// Of two rolls of a stand.
inline bool is_of_stand(const std::string_view contact)
{
  const auto name = choice_named<ContactName>(contact);
  return name == ContactName::upper || name == ContactName::lower;
}
constexpr bool is_contact(const std::string_view contact, const ContactName name)
{
  return contact == word_of(name);
}
}  // namespace mill
