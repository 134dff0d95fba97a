#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace mill::twin {
/// A line as families are looked for.
struct SeenLine {
  double frequency;  ///< Hz
  double deviation;  ///< Hz, standard deviation
  double power;      ///< squared amplitude in any one unit; ranks lines
};

/// A frequency of which a family may be made: a roll that turns, the mains.
struct KnownFundamental {
  std::string name;   ///< "mains", "turns of the work_roll"
  double frequency;   ///< Hz
  double tolerance;   ///< -, how far the real one may be off
  std::size_t least;  ///< lines that make a family of it
};

/// Lines that are multiples of one frequency.  theory.md (41.25)
struct LineFamily {
  double fundamental;                ///< Hz
  double deviation;                  ///< Hz
  std::vector<int> orders;           ///< ascending
  std::vector<std::size_t> members;  ///< of the lines, in the order of `orders`
  double chance;                     ///< -, probability that so many lines fit by chance
  std::string name;                  ///< of the known fundamental; empty: none
};

/// Lines at h c + j d: harmonics of a carrier with side bands.  theory.md (41.26)
struct SideBands {
  double carrier, spacing;  ///< Hz
  struct Place {
    int harmonic, side;
    std::size_t line;
  };
  std::vector<Place> places;
  double chance;  ///< -
};

/// Lines in families, those of most lines first; a line is of one family.
struct LinesInFamilies {
  std::vector<LineFamily> families;
  std::vector<SideBands> side_bands;  ///< of these families, and of carriers that make no family
  std::vector<std::size_t> free;      ///< lines of no family
};
LinesInFamilies lines_in_families(const std::vector<SeenLine> &lines, const std::vector<KnownFundamental> &known);

/// -, probability of k and more hits where `expected` are expected (Poisson).
double chance_of(std::size_t k, double expected);
}  // namespace mill::twin
