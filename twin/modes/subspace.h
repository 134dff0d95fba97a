#pragma once
#include "twin/modes/decimated.h"
#include "twin/modes/singular_value.h"
#include <Eigen/Core>
#include <vector>

// Modes from the response alone: covariance-driven subspace identification.  Chapter 42.
namespace mill::twin {
/// A pole of one model order.
struct SubspacePole {
  int order;
  double frequency;        ///< Hz
  double damping;          ///< -, of critical
  Eigen::VectorXcd shape;  ///< (p) of the channels, in their units
  bool stable    = false;  ///< the order before has it too: 1 % in frequency, 30 % in damping, MAC 0.98
  bool confirmed = false;  ///< stable, and of a mode that both halves of the record show
};

/// A band in which modes are looked for.
struct ModeBand {
  double low, high;  ///< Hz
};

/// Bands of section 2.6 of the description, cut at what the record holds.
/// @param highest  Hz
std::vector<ModeBand> mode_bands(double highest);

/// Poles of orders 12, 14, .. 40 within the band.  theory.md (42.1) to (42.5)
/// Cost: covariances p^2 n i, one eigenproblem of (i p), fifteen of the order.
std::vector<SubspacePole> subspace_poles(const DecimatedRecord &record, const ModeBand &band);

/// The same from any sequence R_1, R_2, .. whose poles they are: covariances (p, p) or impulse responses (p, 1).
/// @param R      [m] of lag m, [0] unused, channels divided by `scale`; 2 i - 1 lags
/// @param i      block rows
std::vector<SubspacePole> poles_of_blocks(const std::vector<Eigen::MatrixXd> &R, int i,
                                          const Eigen::VectorXd &scale, double rate, const ModeBand &band);

/// Block rows for a band that begins at `low` Hz: three of its periods, 40 .. 80.
int block_rows(double rate, double low);

/// -, |a'b|^2 / (a'a b'b)
double modal_assurance(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b);

/// A mode that half of the orders show.
struct IdentifiedMode {
  double frequency;        ///< Hz, median of its stable poles
  double damping;          ///< -, same
  Eigen::VectorXcd shape;  ///< (p) largest component 1
  int orders;              ///< of fifteen
  bool confirmed = false;  ///< both halves of the record show it
  double law_frequency;    ///< Hz, least standard deviation in a record of this length, (42.6)
  double law_damping;      ///< -, same
};

/// Modes of the stable poles of one band, ascending.
/// @param duration  s, of the record
std::vector<IdentifiedMode> modes_of_poles(const std::vector<SubspacePole> &poles, double duration);

/// All that a record says about its modes.
struct ModeSearch {
  std::vector<IdentifiedMode> modes;  ///< ascending, all bands; one that is found in two bands appears once
  std::vector<SubspacePole> poles;    ///< of all bands, for the diagram
  FirstSingularValue singular;        ///< of the channels, behind the diagram
};

/// Modes of all bands, each confirmed by both halves of the record: within 6 standard deviations of the law for
/// half the time, MAC 0.9.  This removes spurious poles that pass every criterion of stability.
/// @param channels  vibrations of one record, at least one
/// @param highest   Hz, above it nothing is looked for
ModeSearch find_modes(const std::vector<const CleanChannel *> &channels, double rate, double highest, int threads);
}  // namespace mill::twin
