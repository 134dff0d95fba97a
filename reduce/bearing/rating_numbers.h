#pragma once
#include "core/model/bearing_ratings.h"
#include "reduce/bearing/bearing_numbers.h"
#include "reduce/bearing/rating_life.h"
#include <optional>

// Ratings and lives of one solved bearing with their errors and what they are compared with: no text, no files.
namespace mill::bearing {
/// What the standards give for the load of the whole bearing.
struct RatedLoad {
  double P;               ///< N, equivalent load, (5.32)
  double P_error;         ///< -, relative: against the life by slices
  double S0;              ///< -, static safety C0/P0, (5.33)
  double S0_error;        ///< -, relative: against S0_by_pressure
  double S0_by_pressure;  ///< -, (4000 MPa over the pressure of the heaviest roller)^2
  double S0_by_yield;     ///< -, (yield_pressure over that pressure)^2
  double C_by_slices;     ///< N, load for 1e6 revolutions by slices
  double L10;             ///< revolutions, (5.34)
  double L10_error;       ///< -, relative: against the life by slices, and that of C
  double L10mr;           ///< revolutions, a_ISO L10
};

/// ISO 281 and ISO 76, with lives by slices of every roller.  theory.md 5.8
struct RatingNumbers {
  Ratings by_formula;
  double C, C0;              ///< N, of the maker where they are given, else by_formula
  double C_error, C0_error;  ///< -, relative: formula against maker, C0 else against C0_by_pressure; NaN: unknown
  double C0_by_pressure;     ///< N, 4000 MPa under the heaviest roller
  std::optional<RatedLoad> load;  ///< nothing without radial and axial load
  ReferenceLife slices;           ///< L10r
  double L10r_error;              ///< -, relative; NaN: unknown
  double L10r_standard;           ///< revolutions, ISO law and rigid rings
  double L10r_without_edge;       ///< revolutions, without the factor of the ends
  double L10r_thin_slices;        ///< revolutions, with the factor of the ends of thin slices
  double viscosity_ratio;         ///< -, kappa, 1 where it is not given
  double contamination;           ///< -, e_C, 0.3 where it is not given
  double L10mr;                   ///< revolutions, (5.39)
  double L10mr_error;             ///< -, relative; NaN: unknown
};
/// Error of a life: what companions of the state and ISO 281 change in it, of a life by slices also what thin
/// slices do; for L10mr also kappa within a factor of two and e_C within 0.2 .. 0.4 where they are not given; and
/// the error of C, with which a life goes by the power 10/3.  NaN where that of C is.
/// @throws InputError  roller or pitch diameter missing
RatingNumbers rating_numbers(const RollerBearing &bearing, const ComparedStates &states);

/// Smallest and largest number among the candidates of estimated rollers and the one taken.
struct CandidateRange {
  double low, high;  ///< unit of the number
  double error;      ///< -, relative, of the one taken
};
CandidateRange candidate_range(const std::vector<RollerCandidate> &candidates, double taken,
                               const std::function<double(const RollerCandidate &)> &number);
}  // namespace mill::bearing
