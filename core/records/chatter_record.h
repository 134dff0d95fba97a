#pragma once
#include "core/base/choice.h"
#include "core/base/each_member.h"
#include "core/model/material.h"
#include <array>
#include <optional>
#include <string>
#include <vector>

// What a run stores about chatter in addition to its tables: curves/chatter-<slug>.json holds a ChatterCondition,
// curves/chatter-tandem.json a ChatterTandem.  dynamics/ and app/ fill the records, report/ draws them.  A number
// that is not known is NaN, a text or list empty.
namespace mill {
/// Speeds of the histories of a condition: 2 % below the critical one, at it, 2 % above.
enum class HistorySpeed { below, at, above };
constexpr auto words_of(HistorySpeed)
{
  return choice_words<HistorySpeed>("below", "at", "above");
}

/// Whether vibration of a condition begins to grow, and where.
struct ChatterCritical {
  std::string verdict;                                      ///< word of a StabilityFinding; empty: not stored
  double speed                   = not_given;               ///< m/s, of the crossing
  double frequency               = not_given;               ///< Hz
  double growth_at_working       = not_given;               ///< 1/s, at the working speed
  double margin                  = not_given;               ///< 1/s, growth rate nearest to the other verdict
  double margin_speed            = not_given;               ///< m/s, where that is
  std::array<double, 2> searched = {not_given, not_given};  ///< m/s, range
  std::string sentence;                                     ///< the same in words
};

struct ChatterHistoryInfo {
  std::string file;             ///< "response/chatter-2-below"
  double speed    = not_given;  ///< m/s
  double growth   = not_given;  ///< 1/s, real part of the eigenvalue
  double measured = not_given;  ///< 1/s, from the record
};

struct ChatterEventInfo {
  double time = not_given;  ///< s
  std::string what;         ///< "entry strip slack"
};

struct LimitCycleInfo {
  double speed     = not_given;  ///< m/s
  bool settled     = false;      ///< the amplitude no longer changes
  double amplitude = not_given;  ///< um, half the gap's peak to peak
  double frequency = not_given;  ///< Hz
  std::string stopped;           ///< why the run ended early
  std::string limited_by;        ///< what keeps it from growing on
  std::vector<ChatterEventInfo> events;
};

/// Motion of one point of the stand in a mode, away from the strip positive.
struct ChatterPoint {
  std::string label;
  double amplitude = 0;          ///< m per m of gap; of a tandem over the largest
  double phase     = not_given;  ///< deg, -180..180, against the gap; 0: away from the strip while the gap opens
};

/// Phases against the gap, deg, positive ahead of it.
struct ChatterPhases {
  double frequency     = not_given;  ///< Hz
  double ratio         = not_given;  ///< -, amplitude of the upper over that of the lower work roll
  double force         = not_given;  ///< deg
  double entry_tension = not_given;  ///< deg
  double exit_tension  = not_given;  ///< deg
  double friction      = not_given;  ///< deg
  std::vector<ChatterPoint> shape;
};

/// Outcome of one finite change of an input.
struct FiniteChange {
  double friction       = not_given;  ///< -, relative change at the working speed; nan: no bite there
  double critical_speed = not_given;  ///< -, relative change; nan: no critical speed
  double slope          = not_given;  ///< -, d ln v_crit/d ln p at the changed input; nan: not known
  std::string outcome;                ///< why one is nan; empty otherwise
};

/// One input and what it moves.  With friction held: under Coulomb friction of the working point, theory.md 27.4.
struct ChatterSensitivity {
  std::string key, name, unit;
  double value                           = 0;          ///< SI
  double friction                        = not_given;  ///< -, d ln mu/d ln p at the working speed
  double force                           = not_given;  ///< -, d ln F/d ln p there
  double growth                          = not_given;  ///< 1/s, d(growth rate)/d ln p there
  double critical_speed                  = not_given;  ///< -, d ln v_crit/d ln p; nan: no critical speed
  double critical_speed_at_held_friction = not_given;  ///< -, the same with friction held
  FiniteChange lowered, raised;                        ///< by the finite change
  bool monotone = true;                                ///< critical speed: slopes and finite changes go one way
};

/// One way of linearising, one reading or model of the stand.
struct ChatterVariantInfo {
  std::string name, verdict;
  double critical_speed      = not_given;  ///< m/s
  double frequency           = not_given;  ///< Hz
  double growth              = not_given;  ///< 1/s at the working speed
  double ratio               = not_given;  ///< -, upper over lower work roll
  double force_phase         = not_given;  ///< deg against the gap
  double entry_tension_phase = not_given;  ///< deg against the gap
  bool upper_moves_more      = false;      ///< upper work roll more than the lower one; meaningless without ratio
};

/// A conclusion that was tried on every variant.
struct ChatterConclusion {
  std::string text;  ///< "Which work roll moves more"
  bool holds = false;
  std::string detail;
};

/// A value of a condition with a published and a measured one.
struct ChatterPublished {
  std::string quantity, unit;
  double here      = not_given;  ///< in unit
  double published = not_given;  ///< in unit, of a published model
  double measured  = not_given;  ///< in unit
  std::string note;
};

struct ChatterCondition {
  std::string name;          ///< as the case calls it
  std::string slug;          ///< curves/chatter-<slug>-*.csv
  double speed = not_given;  ///< m/s, working speed
  std::string scheme;
  double reduction = not_given;  ///< %, of the condition
  double viscosity = not_given;  ///< mPa s, of the condition
  std::string structure;         ///< where the stand comes from
  ChatterCritical critical;
  std::vector<ChatterHistoryInfo> histories;
  LimitCycleInfo limit_cycle;
  ChatterPhases phases;
  std::vector<ChatterSensitivity> sensitivities;
  std::vector<ChatterVariantInfo> schemes, variants, structures;
  std::vector<ChatterConclusion> conclusions;
  std::vector<ChatterPublished> published;
};

/// Several stands with the strip that runs from one to the next.
struct ChatterTandem {
  std::vector<std::string> stands;
  std::string verdict;
  std::string sentence;                    ///< the result in words
  double critical_speed  = not_given;      ///< m/s
  double frequency       = not_given;      ///< Hz
  double without_delay   = not_given;      ///< m/s, thickness waves forgotten on the way
  double without_tension = not_given;      ///< m/s, least of the stands alone
  double any_delay       = not_given;      ///< m/s, stable below whatever the distances
  std::vector<ChatterVariantInfo> single;  ///< each stand alone
  std::vector<ChatterPoint> shape;
  std::vector<std::string> sentences;  ///< what it means
};

template <class Io, class R, if_record<R, ChatterCritical> = 0> void each_member(Io &&io, R &record)
{
  auto &[verdict, speed, frequency, growth_at_working, margin, margin_speed, searched, sentence] = record;
  io("verdict", verdict);
  io("speed", speed);
  io("frequency", frequency);
  io("growth_at_working_speed", growth_at_working);
  io("margin", margin);
  io("margin_speed", margin_speed);
  io("searched", searched);
  io("sentence", sentence);
}

template <class Io, class R, if_record<R, ChatterHistoryInfo> = 0> void each_member(Io &&io, R &record)
{
  auto &[file, speed, growth, measured] = record;
  io("file", file);
  io("speed", speed);
  io("growth_rate", growth);
  io("measured_growth", measured);
}

template <class Io, class R, if_record<R, ChatterEventInfo> = 0> void each_member(Io &&io, R &record)
{
  auto &[time, what] = record;
  io("time", time);
  io("what", what);
}

template <class Io, class R, if_record<R, LimitCycleInfo> = 0> void each_member(Io &&io, R &record)
{
  auto &[speed, settled, amplitude, frequency, stopped, limited_by, events] = record;
  io("speed", speed);
  io("settled", settled);
  io("amplitude_um", amplitude);
  io("frequency", frequency);
  io("stopped", stopped);
  io("limited_by", limited_by);
  io("events", events);
}

template <class Io, class R, if_record<R, ChatterPoint> = 0> void each_member(Io &&io, R &record)
{
  auto &[label, amplitude, phase] = record;
  io("label", label);
  io("amplitude", amplitude);
  io("phase", phase);
}

template <class Io, class R, if_record<R, ChatterPhases> = 0> void each_member(Io &&io, R &record)
{
  auto &[frequency, ratio, force, entry_tension, exit_tension, friction, shape] = record;
  io("frequency", frequency);
  io("ratio", ratio);
  io("force", force);
  io("entry_tension", entry_tension);
  io("exit_tension", exit_tension);
  io("friction", friction);
  io("shape", shape);
}

template <class Io, class R, if_record<R, FiniteChange> = 0> void each_member(Io &&io, R &record)
{
  auto &[friction, critical_speed, slope, outcome] = record;
  io("friction", friction);
  io("critical_speed", critical_speed);
  io("slope", slope);
  io("outcome", outcome);
}

template <class Io, class R, if_record<R, ChatterSensitivity> = 0> void each_member(Io &&io, R &record)
{
  auto &[key, name, unit, value, friction, force, growth, critical_speed, critical_speed_at_held_friction, lowered,
         raised, monotone] = record;
  io("key", key);
  io("name", name);
  io("unit", unit);
  io("value", value);
  io("friction", friction);
  io("force", force);
  io("growth", growth);
  io("critical_speed", critical_speed);
  io("critical_speed_at_held_friction", critical_speed_at_held_friction);
  io("lowered", lowered);
  io("raised", raised);
  io("monotone", monotone);
}

template <class Io, class R, if_record<R, ChatterVariantInfo> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, verdict, critical_speed, frequency, growth, ratio, force_phase, entry_tension_phase,
         upper_moves_more] = record;
  io("name", name);
  io("verdict", verdict);
  io("critical_speed", critical_speed);
  io("frequency", frequency);
  io("growth_rate", growth);
  io("ratio", ratio);
  io("force_phase", force_phase);
  io("entry_tension_phase", entry_tension_phase);
  io("upper_moves_more", upper_moves_more);
}

template <class Io, class R, if_record<R, ChatterConclusion> = 0> void each_member(Io &&io, R &record)
{
  auto &[text, holds, detail] = record;
  io("text", text);
  io("holds", holds);
  io("detail", detail);
}

template <class Io, class R, if_record<R, ChatterPublished> = 0> void each_member(Io &&io, R &record)
{
  auto &[quantity, unit, here, published, measured, note] = record;
  io("quantity", quantity);
  io("unit", unit);
  io("here", here);
  io("published", published);
  io("measured", measured);
  io("note", note);
}

// The slug is in the name of the file.
template <class Io, class R, if_record<R, ChatterCondition> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, slug, speed, scheme, reduction, viscosity, structure, critical, histories, limit_cycle, phases,
         sensitivities, schemes, variants, structures, conclusions, published] = record;
  io("condition", name);
  io("speed", speed);
  io("scheme", scheme);
  io("reduction", reduction);
  io("viscosity", viscosity);
  io("structure", structure);
  io("critical", critical);
  io("histories", histories);
  io("limit_cycle", limit_cycle);
  io("phases", phases);
  io("sensitivities", sensitivities);
  io("schemes", schemes);
  io("variants", variants);
  io("structures", structures);
  io("conclusions", conclusions);
  io("published", published);
}

template <class Io, class R, if_record<R, ChatterTandem> = 0> void each_member(Io &&io, R &record)
{
  auto &[stands, verdict, sentence, critical_speed, frequency, without_delay, without_tension, any_delay, single,
         shape, sentences] = record;
  io("stands", stands);
  io("verdict", verdict);
  io("sentence", sentence);
  io("critical_speed", critical_speed);
  io("frequency", frequency);
  io("without_delay", without_delay);
  io("without_tension", without_tension);
  io("any_delay", any_delay);
  io("single", single);
  io("shape", shape);
  io("sentences", sentences);
}
}  // namespace mill
