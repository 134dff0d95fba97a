#pragma once
#include "core/base/each_member.h"
#include "core/base/warning.h"
#include "core/model/material.h"
#include <string>
#include <vector>

// A pass driven on the curves of its contacts: curves/nonlinear-<pass>.json.  dynamics/ and app/ fill the record,
// report/ draws it.  A number that is not known is NaN.  theory.md 36
namespace mill {
/// A spring that follows a curve.
struct NonlinearSpring {
  std::string name;              ///< "K3"
  double rest      = not_given;  ///< N, at rest
  double stiffness = not_given;  ///< N/m, slope at rest: that of the linear run
  double corrected = not_given;  ///< -, what was added to the slope of the samples so that it is that one
  double smoothed  = not_given;  ///< -, largest deviation of the curve from the computed samples
  double low       = not_given;  ///< N, least load of the samples
  double high      = not_given;  ///< N, largest
  double least     = not_given;  ///< -, smallest force in the run over that at rest
  double least_at  = not_given;  ///< s
  double largest   = not_given;  ///< -
  int parted       = 0;          ///< how often a place of it parted
};

/// Accelerations of a roll on the curves and on their slopes.
struct NonlinearRoll {
  std::string name;                ///< "upper work roll"
  double peak        = not_given;  ///< m/s2
  double rms         = not_given;  ///< m/s2
  double linear_peak = not_given;  ///< m/s2
  double linear_rms  = not_given;  ///< m/s2
  double fixed_peak  = not_given;  ///< m/s2, by fixed steps
  double fixed_rms   = not_given;  ///< m/s2
};

/// Free vibration in one mode over its amplitude, points in increasing amplitude, and its answer to a harmonic
/// force.
struct NonlinearMode {
  int number = 0;                        ///< from 1
  std::string name;                      ///< "gap mode, first kind (third octave)"; empty: not named
  double frequency = not_given;          ///< Hz, of vanishing amplitude
  std::string mover;                     ///< place that the amplitude is of
  std::string opens;                     ///< spring that parts first
  std::vector<double> amplitude;         ///< m, first harmonic of the mover
  std::vector<double> followed;          ///< Hz, frequency at that amplitude
  std::vector<double> least;             ///< -, smallest force of the spring that parts first, over that at rest
  double parting_amplitude = not_given;  ///< m, of the mover, where the first spring parts
  double bend              = not_given;  ///< -, frequency there over that of vanishing amplitude, less 1
  double bend_in_run       = not_given;  ///< -, the same at the largest amplitude of this run
  double parting_force     = not_given;  ///< N, amplitude of a harmonic bite force at the mode that parts a spring
  double force             = not_given;  ///< N, amplitude of the force behind the harmonics
  std::vector<double> harmonics;         ///< m/s2, work roll that moves most, at f, 2f, 3f
};

struct NonlinearRecord {
  std::string pass, model;           ///< "pass 1", "six-mass chain"
  double load          = not_given;  ///< N, at rest
  double force_range   = not_given;  ///< N, peak to peak of the record
  double scale_to_part = not_given;  ///< -, times the fluctuation of the record until a spring parts
  double balance       = not_given;  ///< -, energy that is missing at the end over the work of the force
  double duration      = not_given;  ///< s
  bool linear_enough   = false;
  std::string verdict;  ///< a sentence
  std::string found;    ///< the numbers in it
  std::vector<NonlinearSpring> springs;
  std::vector<NonlinearRoll> rolls;
  std::vector<NonlinearMode> modes;  ///< those that strain a spring with a curve
  std::vector<Warning> notes;        ///< without subject
};

template <class Io, class R, if_record<R, NonlinearSpring> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, rest, stiffness, corrected, smoothed, low, high, least, least_at, largest, parted] = record;
  io("name", name);
  io("rest", rest);
  io("stiffness", stiffness);
  io("corrected", corrected);
  io("smoothed", smoothed);
  io("low", low);
  io("high", high);
  io("least", least);
  io("least_at", least_at);
  io("largest", largest);
  io("parted", parted);
}

template <class Io, class R, if_record<R, NonlinearRoll> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, peak, rms, linear_peak, linear_rms, fixed_peak, fixed_rms] = record;
  io("name", name);
  io("peak", peak);
  io("rms", rms);
  io("linear_peak", linear_peak);
  io("linear_rms", linear_rms);
  io("fixed_peak", fixed_peak);
  io("fixed_rms", fixed_rms);
}

template <class Io, class R, if_record<R, NonlinearMode> = 0> void each_member(Io &&io, R &record)
{
  auto &[number, name, frequency, mover, opens, amplitude, followed, least, parting_amplitude, bend, bend_in_run,
         parting_force, force, harmonics] = record;
  io("number", number);
  io("name", name);
  io("frequency", frequency);
  io("mover", mover);
  io("opens", opens);
  io("amplitude", amplitude);
  io("followed", followed);
  io("least", least);
  io("parting_amplitude", parting_amplitude);
  io("bend", bend);
  io("bend_in_run", bend_in_run);
  io("parting_force", parting_force);
  io("force", force);
  io("harmonics", harmonics);
}

template <class Io, class R, if_record<R, NonlinearRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[pass, model, load, force_range, scale_to_part, balance, duration, linear_enough, verdict, found, springs,
         rolls, modes, notes] = record;
  io("pass", pass);
  io("model", model);
  io("load", load);
  io("force_range", force_range);
  io("scale_to_part", scale_to_part);
  io("balance", balance);
  io("duration", duration);
  io("linear_enough", linear_enough);
  io("verdict", verdict);
  io("found", found);
  io("springs", springs);
  io("rolls", rolls);
  io("modes", modes);
  io("notes", notes);
}
}  // namespace mill
