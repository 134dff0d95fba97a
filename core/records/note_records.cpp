#include "core/records/note_records.h"
#include "core/records/json_archive.h"
#include <filesystem>
#include <nlohmann/json.hpp>

namespace mill {
void write_notes(nlohmann::ordered_json &document, const std::vector<Note> &notes)
{
  document["notes"] = texts_of(notes);
  auto &records     = document["note_records"];
  records           = nlohmann::ordered_json::array();
  for (const Note &note : notes)
    if (!note.is(NoteId::remark)) {
      auto &record = records.emplace_back();
      json::Writer(record).write(with_file_names(note.parts));
      record["id"] = id_of(note);
    }
}

Warning with_file_names(Warning warning)
{
  const auto shorten = [](Place &place) { place.file = std::filesystem::path(place.file).filename().string(); };
  shorten(warning.place);
  for (Place &place : warning.related)
    shorten(place);
  return warning;
}
}  // namespace mill
