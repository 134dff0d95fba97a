#pragma once
#include "core/base/note.h"
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace mill {
/// Adds the members "notes", whole texts, and "note_records", the same in the form of warning_records of
/// results.json; remarks are among the texts alone.
void write_notes(nlohmann::ordered_json &document, const std::vector<Note> &notes);

/// A place has the name of its file, not the way there: results of one case are the same from wherever it was run.
Warning with_file_names(Warning warning);
}  // namespace mill
