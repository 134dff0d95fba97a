#pragma once
#include "core/base/each_member.h"
#include "core/model/material.h"
#include <array>
#include <string>
#include <vector>

// Modes of a stand over the rolling speed with the orders of what turns: curves/campbell.json.  dynamics/ and app/
// fill the record, report/ draws it.  A number that is not known is NaN.
namespace mill {
/// A named mode; its frequency does not depend on the speed.
struct CampbellMode {
  std::string key;                    ///< "gap_first_kind"
  std::string name;                   ///< "gap mode, first kind (third octave)"
  double frequency      = not_given;  ///< Hz
  double error_estimate = not_given;  ///< relative
};

/// Something that happens so many times per turn of a roll.
struct CampbellLine {
  std::string name;               ///< "work-roll bearing, outer raceway, harmonic 2"
  std::string group;              ///< "work roll", "backup-roll bearing, cage", "drive"
  std::string shaft;              ///< "work roll": whose turns
  double per_turn   = not_given;  ///< -, events in one turn
  double per_length = not_given;  ///< 1/m, events per length of the roll's surface: frequency over speed
};

/// A speed at which a line meets a mode.
struct CampbellCrossing {
  int mode        = 0;          ///< place in the list of modes
  int line        = 0;          ///< place in the list of lines
  double speed    = not_given;  ///< m/s, of the rolls' surface
  double distance = not_given;  ///< -, from the nearer end of the working range, over that end; negative below it,
                                ///< 0 inside; NaN: no working range is known
};

struct CampbellRecord {
  std::string model;                                       ///< "craig-bampton": whose modes
  std::array<double, 2> speeds  = {not_given, not_given};  ///< m/s, range of the diagram
  std::array<double, 2> working = {not_given, not_given};  ///< m/s
  std::vector<CampbellMode> modes;
  std::vector<CampbellLine> lines;
  std::vector<CampbellCrossing> crossings;  ///< mode by mode, by the speed
  std::vector<std::string> notes;           ///< what could not be drawn, one sentence each
};

template <class Io, class R, if_record<R, CampbellMode> = 0> void each_member(Io &&io, R &record)
{
  auto &[key, name, frequency, error_estimate] = record;
  io("key", key);
  io("name", name);
  io("frequency", frequency);
  io("error_estimate", error_estimate);
}

template <class Io, class R, if_record<R, CampbellLine> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, group, shaft, per_turn, per_length] = record;
  io("name", name);
  io("group", group);
  io("shaft", shaft);
  io("per_turn", per_turn);
  io("per_length", per_length);
}

template <class Io, class R, if_record<R, CampbellCrossing> = 0> void each_member(Io &&io, R &record)
{
  auto &[mode, line, speed, distance] = record;
  io("mode", mode);
  io("line", line);
  io("speed", speed);
  io("distance", distance);
}

template <class Io, class R, if_record<R, CampbellRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[model, speeds, working, modes, lines, crossings, notes] = record;
  io("model", model);
  io("speeds", speeds);
  io("working", working);
  io("modes", modes);
  io("lines", lines);
  io("crossings", crossings);
  io("notes", notes);
}
}  // namespace mill
