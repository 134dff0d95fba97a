#pragma once
#include "core/base/warning.h"
#include <optional>
#include <string>
#include <vector>

namespace mill {
/// What advise, calibrate and analyse note; note_rows() has a row for each, in this order.
enum class NoteId {
  remark,
  assumed,
  error_not_stated,
  // records
  record_left_out,
  clipped,
  band_limited,
  mixed_units,
  speed_not_usable,
  force_not_measured,
  force_not_recorded,
  force_not_usable,
  force_meaning,
  load_of_first_pass,
  clock_delay,
  delay_not_determined,
  level_off_record,
  // analyse
  modes_not_searched,
  bearing_not_computed,
  list_cut,
  // advise
  pass_not_judged,
  springs_not_tried,
  torque_not_limited,
  no_critical_speed,
  tuning_at_edge,
  band_above_model,
  band_not_resolved
};

/// A note in the parts of a warning: what decides something has an id, all else is a remark.
struct Note {
  std::optional<NoteId> id;  ///< nothing: parts.id says it, of a warning that a run may have too
  Warning parts;  ///< subject, fact, detail, remedy, concerns, key; parts.id is read where `id` is empty

  Note(std::string remark);
  Note(const char *remark);
  Note(NoteId id, std::string subject, std::string fact, std::string detail = "", std::string remedy = "",
       std::vector<std::string> concerns = {}, std::string key = "");
  Note(Warning warning);

  bool is(NoteId asked) const;
};

struct NoteRow {
  NoteId id;
  const char *word;     ///< "error-not-stated": in JSON files, never changed
  const char *meaning;  ///< one sentence without full stop
};
const std::vector<NoteRow> &note_rows();

/// "error-not-stated"; that of the warning where the note is one.
const char *id_of(const Note &note);

/// The parts joined as text_of(Warning) does.
std::string text_of(const Note &note);
std::vector<std::string> texts_of(const std::vector<Note> &notes);
}  // namespace mill
