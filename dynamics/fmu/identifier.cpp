#include "dynamics/fmu/identifier.h"
#include <cctype>
#include <cstdint>
#include <fmt/format.h>

namespace mill::fmu {
namespace {
// ASCII letters for the letters of a block, from its first code point on.
constexpr const char *latin[]    = {  // U+00C0 to U+017F
    "A",  "A", "A",  "A",  "Ae", "A", "Ae", "C",  "E",  "E", "E",  "E", "I",  "I",  "I", "I", "D", "N",
    "O",  "O", "O",  "O",  "Oe", "x", "Oe", "U",  "U",  "U", "Ue", "Y", "Th", "ss", "a", "a", "a", "a",
    "ae", "a", "ae", "c",  "e",  "e", "e",  "e",  "i",  "i", "i",  "i", "d",  "n",  "o", "o", "o", "o",
    "oe", "",  "oe", "u",  "u",  "u", "ue", "y",  "th", "y", "A",  "a", "A",  "a",  "A", "a", "C", "c",
    "C",  "c", "C",  "c",  "C",  "c", "D",  "d",  "D",  "d", "E",  "e", "E",  "e",  "E", "e", "E", "e",
    "E",  "e", "G",  "g",  "G",  "g", "G",  "g",  "G",  "g", "H",  "h", "H",  "h",  "I", "i", "I", "i",
    "I",  "i", "I",  "i",  "I",  "i", "Ij", "ij", "J",  "j", "K",  "k", "k",  "L",  "l", "L", "l", "L",
    "l",  "L", "l",  "L",  "l",  "N", "n",  "N",  "n",  "N", "n",  "n", "Ng", "ng", "O", "o", "O", "o",
    "O",  "o", "Oe", "oe", "R",  "r", "R",  "r",  "R",  "r", "S",  "s", "S",  "s",  "S", "s", "S", "s",
    "T",  "t", "T",  "t",  "T",  "t", "U",  "u",  "U",  "u", "U",  "u", "U",  "u",  "U", "u", "U", "u",
    "W",  "w", "Y",  "y",  "Y",  "Z", "z",  "Z",  "z",  "Z", "z",  "s"};
constexpr const char *greek[]    = {  // U+0386 to U+03CE
    "A", "",  "E", "I", "I", "",  "O", "",  "Y",  "O",  "i", "A", "B",  "G", "D",  "E",  "Z", "I", "Th",
    "I", "K", "L", "M", "N", "X", "O", "P", "R",  "",   "S", "T", "Y",  "F", "Ch", "Ps", "O", "I", "Y",
    "a", "e", "i", "i", "y", "a", "b", "g", "d",  "e",  "z", "i", "th", "i", "k",  "l",  "m", "n", "x",
    "o", "p", "r", "s", "s", "t", "y", "f", "ch", "ps", "o", "i", "y",  "o", "y",  "o"};
constexpr const char *cyrillic[] = {  // U+0400 to U+045F
    "E", "Yo", "Dj", "G", "Ye", "Dz", "I",  "Yi", "J",  "Lj",   "Nj", "C", "K", "I", "U",  "Dz",
    "A", "B",  "V",  "G", "D",  "E",  "Zh", "Z",  "I",  "J",    "K",  "L", "M", "N", "O",  "P",
    "R", "S",  "T",  "U", "F",  "Kh", "Ts", "Ch", "Sh", "Shch", "",   "Y", "",  "E", "Yu", "Ya",
    "a", "b",  "v",  "g", "d",  "e",  "zh", "z",  "i",  "j",    "k",  "l", "m", "n", "o",  "p",
    "r", "s",  "t",  "u", "f",  "kh", "ts", "ch", "sh", "shch", "",   "y", "",  "e", "yu", "ya",
    "e", "yo", "dj", "g", "ye", "dz", "i",  "yi", "j",  "lj",   "nj", "c", "k", "i", "u",  "dz"};

template <std::size_t n>
const char *letters_from(const char *const (&block)[n], const std::uint32_t first, const std::uint32_t point)
{
  return point >= first && point - first < n ? block[point - first] : nullptr;
}

// ASCII letters for a code point; null where the tables have none.
const char *letters_of(const std::uint32_t point)
{
  if (const char *letters = letters_from(latin, 0xC0, point))
    return letters;
  if (const char *letters = letters_from(greek, 0x386, point))
    return letters;
  return letters_from(cyrillic, 0x400, point);
}

// The code point of two bytes of UTF-8, which all tables lie in; 0 for any other byte.
std::uint32_t two_byte_point(const std::string &name, const std::size_t position)
{
  const auto byte = [&](const std::size_t i) {
    return i < name.size() ? static_cast<unsigned char>(name[i]) : 0u;
  };
  return (byte(position) & 0xE0) == 0xC0 && (byte(position + 1) & 0xC0) == 0x80
             ? (byte(position) & 0x1F) << 6 | (byte(position + 1) & 0x3F)
             : 0;
}

bool is_letter_or_digit(const char c)
{
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x80 && std::isalnum(byte);
}

// A number for a name of which no letter can be written.
std::string number_of(const std::string &name)
{
  std::uint32_t hash = 2166136261u;  // FNV-1a
  for (const char c : name)
    hash = (hash ^ std::uint32_t(static_cast<unsigned char>(c))) * 16777619u;
  return fmt::format("{:08x}", hash);
}
}  // namespace

std::string identifier_of(const std::string &name)
{
  std::string identifier;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool ascii = static_cast<unsigned char>(name[i]) < 0x80;
    if (is_letter_or_digit(name[i]))
      identifier += name[i];
    else if (const char *letters = letters_of(two_byte_point(name, i)))
      identifier += letters;
    else if (ascii && !identifier.empty() && identifier.back() != '_')
      identifier += '_';
  }
  while (!identifier.empty() && identifier.back() == '_')
    identifier.pop_back();
  if (identifier.empty())
    identifier = number_of(name);
  if (std::isdigit(static_cast<unsigned char>(identifier[0])) || identifier == number_of(name))
    identifier = "stand_" + identifier;
  return identifier.substr(0, 60);
}

bool is_transliterated(const std::string &name)
{
  for (const char c : name)
    if (static_cast<unsigned char>(c) >= 0x80)
      return true;
  return false;
}
}  // namespace mill::fmu
