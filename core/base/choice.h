#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// A choice is an enumeration with its words, one for each enumerator in their order:
//   enum class Frame { open, closed };
//   constexpr auto words_of(Frame) { return choice_words<Frame>("open", "closed"); }
// Case file, schema, docs/input.md, messages, archives and keys of kept results take the words from there.
namespace mill {
/// A number without enumerator is "(mill::Frame)2" in the name that the compiler gives this function.
template <auto value> constexpr bool is_enumerator()
{
  return std::string_view(__PRETTY_FUNCTION__).find("= (") == std::string_view::npos;
}

/// The words of E; one too many or too few does not compile.
template <class E, class... Word> constexpr std::array<const char *, sizeof...(Word)> choice_words(Word... word)
{
  static_assert(is_enumerator<E(sizeof...(Word) - 1)>() && !is_enumerator<E(sizeof...(Word))>(),
                "a choice has one word for each enumerator");
  return {word...};
}

template <class E, class = void> struct HasWords : std::false_type {
};
template <class E> struct HasWords<E, std::void_t<decltype(words_of(E()))>> : std::is_enum<E> {
};
template <class E> constexpr bool has_words = HasWords<E>::value;
template <class E> using if_choice          = std::enable_if_t<has_words<E>, int>;

/// "open"
template <class E, if_choice<E> = 0> constexpr const char *word_of(const E choice)
{
  return words_of(E())[std::size_t(choice)];
}

/// What the word means; nothing when it is not one of E.
template <class E, if_choice<E> = 0> std::optional<E> choice_named(const std::string_view word)
{
  std::size_t i = 0;
  for (const char *one : words_of(E())) {
    if (word == one)
      return E(i);
    ++i;
  }
  return std::nullopt;
}

/// All of E, in their order.
template <class E, if_choice<E> = 0> constexpr auto every()
{
  std::array<E, words_of(E()).size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = E(i);
  return all;
}

/// The words as texts, for a suggestion or a list of what is known.
template <class E, if_choice<E> = 0> std::vector<std::string> word_list()
{
  const auto words = words_of(E());
  return {words.begin(), words.end()};
}

/// "open | closed"
template <class E, if_choice<E> = 0> std::string choices_of()
{
  std::string all;
  for (const char *word : words_of(E()))
    all += (all.empty() ? "" : " | ") + std::string(word);
  return all;
}
}  // namespace mill
