#include "core/base/note.h"
#include <stdexcept>
#include <utility>

namespace mill {
Note::Note(std::string remark) : id(NoteId::remark)
{
  parts.fact = std::move(remark);
}

Note::Note(const char *remark) : Note(std::string(remark)) {}

Note::Note(const NoteId id_of_note, std::string subject, std::string fact, std::string detail, std::string remedy,
           std::vector<std::string> concerns, std::string key)
    : id(id_of_note)
{
  parts.subject  = std::move(subject);
  parts.fact     = std::move(fact);
  parts.detail   = std::move(detail);
  parts.remedy   = std::move(remedy);
  parts.concerns = std::move(concerns);
  parts.key      = std::move(key);
}

Note::Note(Warning warning) : parts(std::move(warning)) {}

bool Note::is(const NoteId asked) const
{
  return id == asked;
}

const std::vector<NoteRow> &note_rows()
{
  using Id = NoteId;
  static const std::vector<NoteRow> rows{
      {Id::remark, "remark", "how something was computed; not among the records"},
      {Id::assumed, "assumed", "a value that the case does not give was assumed"},
      {Id::error_not_stated, "error-not-stated", "the case states no error of some numbers"},
      {Id::record_left_out, "record-left-out", "a record, a channel or a piece of one is not used"},
      {Id::clipped, "clipped", "samples are at a clip level"},
      {Id::band_limited, "band-limited", "a record ends, or its sensor does, below the band that was asked for"},
      {Id::mixed_units, "mixed-units", "the channels are of two quantities, one of which is used"},
      {Id::speed_not_usable, "speed-not-usable", "the speed was not recorded, or is never above zero"},
      {Id::force_not_measured, "force-not-measured", "a white force is taken: changes are given, no levels"},
      {Id::force_not_recorded, "force-not-recorded", "no force was recorded, so the fit eliminates it"},
      {Id::force_not_usable, "force-not-usable", "no response to the recorded force could be determined"},
      {Id::force_meaning, "force-meaning", "the case means another force than a record holds"},
      {Id::load_of_first_pass, "load-of-first-pass", "the contacts are those at the load of the first pass"},
      {Id::clock_delay, "clock-delay", "force and vibrations are apart in time"},
      {Id::delay_not_determined, "delay-not-determined", "a delay was asked for, and not seen or not determined"},
      {Id::level_off_record, "level-off-record", "the level of the model is far from that of the records"},
      {Id::modes_not_searched, "modes-not-searched", "why no modes were looked for"},
      {Id::bearing_not_computed, "bearing-not-computed", "why a bearing was not looked at"},
      {Id::list_cut, "list-cut", "more were found than are listed"},
      {Id::pass_not_judged, "pass-not-judged", "process actions and the critical speed are not judged"},
      {Id::springs_not_tried, "springs-not-tried", "only dampers are tried"},
      {Id::torque_not_limited, "torque-not-limited", "no limit of the torque is given"},
      {Id::no_critical_speed, "no-critical-speed", "no critical speed was found in the range searched"},
      {Id::tuning_at_edge, "tuning-at-edge", "the best tuning lies at the edge of what was searched"},
      {Id::band_above_model, "band-above-model", "the band goes beyond the modes of the model"},
      {Id::band_not_resolved, "band-not-resolved", "sums over the band may miss part of a peak"},
  };
  return rows;
}

const char *id_of(const Note &note)
{
  if (!note.id)
    return id_of(note.parts.id);
  const auto &rows = note_rows();
  const auto i     = std::size_t(*note.id);
  if (i >= rows.size() || rows[i].id != *note.id)
    throw std::logic_error("the rows of the notes are not in the order of their ids");
  return rows[i].word;
}

std::string text_of(const Note &note)
{
  return text_of(note.parts);
}

std::vector<std::string> texts_of(const std::vector<Note> &notes)
{
  std::vector<std::string> texts;
  for (const Note &note : notes)
    texts.push_back(text_of(note));
  return texts;
}
}  // namespace mill
