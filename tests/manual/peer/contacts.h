#pragma once
#include "tests/manual/check/verification.h"

// Contacts by the peer, face to face with a penalty: the checks of the cases of the same names.
namespace mill::verify {
std::vector<Check> peer_line();
std::vector<Check> peer_roll_pair();
std::vector<Check> peer_roller();
}  // namespace mill::verify
