#pragma once
#include "core/records/campbell_record.h"
#include <map>
#include <string>
#include <vector>

namespace mill {
struct Case;

/// Natural frequencies of a stand from where they are to be had without computing for minutes.
struct KnownModes {
  std::vector<CampbellMode> modes;                         ///< rising
  std::map<std::string, std::vector<std::string>> inputs;  ///< keys of the case behind each, by its key
  std::string model;                                       ///< "of the run in out/stand", "by closed forms"
  std::string note;                                        ///< why not those of a run; empty: they are
};

/// Those of the last run of this very case, named ones first; else by closed forms.
/// @param folder  of the run; empty: out/<case name>
/// @throws InputError  a folder that was named and holds no such run
KnownModes known_modes(const Case &the_case, const std::string &folder);
}  // namespace mill
