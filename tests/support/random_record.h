#pragma once
#include "twin/cleaning/clean_record.h"
#include <cstdint>
#include <vector>

// Records of known content for the campaign of detection: seeded, by formulas of their own.
namespace random_record {
struct Content {
  struct Line {
    double frequency;  ///< Hz
    double decibel;    ///< power over (density of all noise there times the noise bandwidth of the spectrum)
    int channel;       ///< where it has this level
    bool modulated;    ///< in amplitude or frequency: its side bands are lines too
  };
  struct Mode {
    double frequency, damping;  ///< Hz, -
    double decibel;             ///< peak of its density over the noise
    double decays;  ///< -, decays exp(-1) in the record: below some ten it cannot be separated from a line
  };
  std::vector<Line> lines;
  std::vector<double> side_bands;  ///< Hz, lines that modulation makes
  std::vector<Mode> modes;
  double impacts     = 0;  ///< Hz, rate of impacts; 0: none
  double ring        = 0;  ///< Hz, what the impacts ring
  double growth      = 0;  ///< 1/s, of a mode that grows for 3 s and more; 0: none
  double growth_from = 0, growth_to = 0, growth_frequency = 0;  ///< s, s, Hz
  double drift = 0;  ///< -, by which the frequencies of orders of a drifting speed change; 0: steady
};

struct Record {
  mill::twin::RawRecord raw;
  Content content;
};

/// What is drawn.
struct Wish {
  double most_samples = 4e6;  ///< of all channels together
  bool growth         = false;
  bool modes = true, lines = true, impacts = true;
};

/// One record of a seed.
Record make(std::uint64_t seed, const Wish &wish);
}  // namespace random_record
