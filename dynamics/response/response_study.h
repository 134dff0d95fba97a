#pragma once
#include "core/model/frequency_response.h"
#include "dynamics/response/response_band.h"
#include "reduce/stand/stand_comparison.h"
#include "reduce/stand/stand_errors.h"
#include <array>
#include <string>
#include <vector>

// Frequency responses of a stand with their error model: no text, no files.  theory.md 32
namespace mill::dynamics {
/// A stand by several models.
struct StandInModels {
  std::vector<const reduce::StandWithModes *> models;  ///< the best one first
  std::vector<reduce::ModalSensitivity> uncertain;     ///< inputs of the first one
  double gap_damper = 0;                               ///< N s/m
  double limit      = not_given;                       ///< Hz, up to which its modes are right; NaN: all are
};

/// One model in all its modes, seen at its m rolls and chocks; forces are the bite, then one at each of them.
struct RespondingModel {
  const StandModel *model = nullptr;
  std::vector<std::string> places;            ///< (m) reduce::measured_places()
  std::vector<Eigen::VectorXd> seen, pushed;  ///< (m), (1 + m) rows of places and forces
  ModalResponse modal;
  Eigen::VectorXd frequency;               ///< (f) Hz, where it is looked at
  std::vector<Eigen::MatrixXcd> response;  ///< by force, each (f, m) 1/kg; of a companion for the bite alone
};

/// The largest local maximum of a magnitude; NaN where it only rises or falls.
struct ResponsePeak {
  double frequency = not_given;  ///< Hz
  double magnitude = not_given;  ///< 1/kg
};

/// A peak of the first model with what it is compared with.
struct StudiedPeak {
  std::size_t force, place;  ///< of the first model
  ResponsePeak peak;
  double error;   ///< -, relative, of the magnitude: half the band; NaN: see ResponseStudy::lacks
  double direct;  ///< 1/kg, at the same frequency by a solution without modes (32.1)
  std::vector<ResponsePeak> others;  ///< (models - 1) of the same place, for the force in the bite; NaN: none
};

struct ResponseStudy {
  std::array<double, 2> range;  ///< Hz
  std::vector<RespondingModel> models;
  ResponseBand band;               ///< of the first model
  bool uncertain = false;          ///< something is, so that the band has a width
  std::vector<std::string> lacks;  ///< keys of inputs, and modes, that state no error
  std::vector<StudiedPeak> peaks;  ///< for the bite and for a force at the place itself; empty without damping
};
/// @param damping  -, ratio of critical of every mode; 0: responses without band and peaks
/// @throws InputError  a resolution that asks for too many frequencies
/// Cost: that of response_band(), and one solution of n equations for each peak.
ResponseStudy response_study(const StandInModels &stand, const FrequencyResponseSettings &settings,
                             double damping);
}  // namespace mill::dynamics
