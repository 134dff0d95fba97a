#pragma once
#include "core/base/choice.h"
#include "core/base/each_member.h"
#include "core/model/material.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

// Marks on a strip at equal distances, and what in a stand makes them: curves/marks.json.  dynamics/ and app/ fill
// the record, report/ draws it.  A number that is not known is NaN.  theory.md 40
namespace mill {
/// First part of the names of its results: "marks.work_roll.per_turn".
constexpr const char *marks_family = "marks";

/// How a number of marks on a turn lies to the whole ones.
enum class Wholeness { whole, between, unclear };
constexpr auto words_of(Wholeness)
{
  return choice_words<Wholeness>("whole", "between", "not distinguishable");
}

/// What was measured, and how.
struct MarksQuestion {
  double spacing      = not_given;  ///< m, of the marks along the strip
  double speed        = not_given;  ///< m/s, of the strip behind the stand
  double forward_slip = 0;          ///< -, of that speed over the one of the rolls' surface, less one
  double accuracy     = 0.01;       ///< -, of spacing and diameters together: a whole number within it is one
  double side_band    = not_given;  ///< Hz, distance of side bands in a spectrum; nan: none was measured
};

/// The marks on the surface of one roll.
struct RollMarks {
  std::string roll;
  double diameter = not_given;  ///< m
  double rotation = not_given;  ///< Hz
  double per_turn = not_given;  ///< -, marks on one turn, (40.2)
  double whole    = not_given;  ///< -, nearest whole number, at least one
  double off      = not_given;  ///< -, per_turn over it, less one
  double chance   = not_given;  ///< -, that any spacing is whole within the accuracy, (40.3)
  std::string verdict;          ///< word of a Wholeness
};

/// Something that happens at equal angles of a roll, against the marks.
struct EventMarks {
  std::string name;              ///< "work-roll bearing, cage"
  double frequency = not_given;  ///< Hz
  double multiple  = not_given;  ///< -, frequency of the marks over it
  double whole     = not_given;  ///< -, nearest whole number, at least one
  double off       = not_given;  ///< -
  double chance    = not_given;  ///< -
  std::string verdict;           ///< word of a Wholeness
};

/// A natural mode against the marks.
struct ModeMarks {
  std::string key, name;
  double frequency      = not_given;  ///< Hz
  double error_estimate = not_given;  ///< -
  double off            = not_given;  ///< -, over the frequency of the marks, less one
  double speed          = not_given;  ///< m/s, of the strip at which this mode makes this spacing
  bool near             = false;      ///< within accuracy and error
};

/// A speed at which waves around a roll excite a mode.
struct MarkMeeting {
  int mode = 0, roll = 0;       ///< places in the lists
  int waves       = 0;          ///< around the roll
  double speed    = not_given;  ///< m/s, of the strip
  double distance = not_given;  ///< -, from the speed asked for
};

/// Side bands that a roll's rotation gives.
struct SideBands {
  std::string roll;
  double below = not_given, above = not_given;  ///< Hz, first pair next to the frequency of the marks
  double off            = not_given;  ///< -, measured distance over the rotation, less one; nan: none measured
  double exact_speed    = not_given;  ///< m/s, of the strip at which the rotation is the measured distance
  double exact_diameter = not_given;  ///< m, of a roll that turns so often
};

/// How much the stand magnifies the waves of one roll.
struct MarkMap {
  std::string roll;
  Eigen::VectorXd speed;  ///< (n) m/s, of the strip
  Eigen::VectorXd waves;  ///< (m) around the roll
  Eigen::MatrixXd gain;   ///< (n, m) dB, motion of the nearest mode over its static deflection
};

struct MarksRecord {
  MarksQuestion question;
  double frequency = not_given;  ///< Hz, of the marks
  double damping   = not_given;  ///< -, modal, of the map
  std::string model;             ///< whose modes
  std::vector<RollMarks> rolls;
  std::vector<EventMarks> events;
  std::vector<ModeMarks> modes;
  std::vector<MarkMeeting> meetings;
  std::vector<SideBands> side_bands;
  std::vector<MarkMap> maps;
  std::vector<std::string> notes;  ///< what could not be determined, one sentence each
};

template <class Io, class R, if_record<R, MarksQuestion> = 0> void each_member(Io &&io, R &record)
{
  auto &[spacing, speed, forward_slip, accuracy, side_band] = record;
  io("spacing", spacing);
  io("speed", speed);
  io("forward_slip", forward_slip);
  io("accuracy", accuracy);
  io("side_band", side_band);
}

template <class Io, class R, if_record<R, RollMarks> = 0> void each_member(Io &&io, R &record)
{
  auto &[roll, diameter, rotation, per_turn, whole, off, chance, verdict] = record;
  io("roll", roll);
  io("diameter", diameter);
  io("rotation", rotation);
  io("per_turn", per_turn);
  io("whole", whole);
  io("off", off);
  io("chance", chance);
  io("verdict", verdict);
}

template <class Io, class R, if_record<R, EventMarks> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, frequency, multiple, whole, off, chance, verdict] = record;
  io("name", name);
  io("frequency", frequency);
  io("multiple", multiple);
  io("whole", whole);
  io("off", off);
  io("chance", chance);
  io("verdict", verdict);
}

template <class Io, class R, if_record<R, ModeMarks> = 0> void each_member(Io &&io, R &record)
{
  auto &[key, name, frequency, error_estimate, off, speed, near] = record;
  io("key", key);
  io("name", name);
  io("frequency", frequency);
  io("error_estimate", error_estimate);
  io("off", off);
  io("speed", speed);
  io("near", near);
}

template <class Io, class R, if_record<R, MarkMeeting> = 0> void each_member(Io &&io, R &record)
{
  auto &[mode, roll, waves, speed, distance] = record;
  io("mode", mode);
  io("roll", roll);
  io("waves", waves);
  io("speed", speed);
  io("distance", distance);
}

template <class Io, class R, if_record<R, SideBands> = 0> void each_member(Io &&io, R &record)
{
  auto &[roll, below, above, off, exact_speed, exact_diameter] = record;
  io("roll", roll);
  io("below", below);
  io("above", above);
  io("off", off);
  io("exact_speed", exact_speed);
  io("exact_diameter", exact_diameter);
}

template <class Io, class R, if_record<R, MarkMap> = 0> void each_member(Io &&io, R &record)
{
  auto &[roll, speed, waves, gain] = record;
  io("roll", roll);
  io("speed", speed);
  io("waves", waves);
  io("gain", gain);
}

template <class Io, class R, if_record<R, MarksRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[question, frequency, damping, model, rolls, events, modes, meetings, side_bands, maps, notes] = record;
  io("question", question);
  io("frequency", frequency);
  io("damping", damping);
  io("model", model);
  io("rolls", rolls);
  io("events", events);
  io("modes", modes);
  io("meetings", meetings);
  io("side_bands", side_bands);
  io("maps", maps);
  io("notes", notes);
}
}  // namespace mill
