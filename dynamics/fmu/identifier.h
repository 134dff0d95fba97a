#pragma once
#include <string>

namespace mill::fmu {
/// An identifier of C from a name in UTF-8, at most 60 letters: "F-mill 4 (übung)" -> "F_mill_4_uebung".  Letters
/// of Latin with marks, Greek and Cyrillic are written with ASCII letters; from other scripts a number is made,
/// the same for the same name: "四辊" -> "stand_1f3a90c2".  A name that begins with a digit gets "stand_" in
/// front.
std::string identifier_of(const std::string &name);

/// Has the name letters that an identifier cannot have, so that the user should read what it becomes?
bool is_transliterated(const std::string &name);
}  // namespace mill::fmu
