#pragma once
#include "app/command/described_verbs.h"

namespace mill::help {
/// What the program knows of a topic: a page of docs/howto or the tutorial by its name, a verb, a term of the
/// glossary, a result, a key; of a name with several meanings all of them.
/// @param topic  "crown-study", "sweep", "gap mode", "K3", "work_roll.crown", "crown"; empty: the list of topics
/// @throws InputError  an unknown topic, with the nearest ones
std::string topic_text(const std::string &topic, const std::vector<DescribedVerb> &verbs);
}  // namespace mill::help
