#pragma once
#include "tests/support/random_record.h"
#include "twin/analysis/analysis.h"
#include <string>

// What an analysis says of a record of known content.
namespace detection_score {
struct Score {
  long records = 0;
  long lines = 0, lines_found = 0, false_lines = 0;  ///< of 12 dB and more
  long modes = 0, modes_found = 0, false_modes = 0;  ///< of 20 dB and more
  long calm = 0, false_growth = 0;     ///< records without growth; of them with an alarm or a warning
  long growing = 0, growth_found = 0;  ///< records with growth; of them reported with its sign
  double account_error = 0;            ///< -, largest distance of the sum of shares from one
  long fateless        = 0;            ///< candidates whose fate has no reason
  std::string missed;                  ///< what was wrong, a line each
  void add(const Score &other);
  std::string table() const;  ///< rows of markdown
};

/// Makes the record of a seed, analyses it and compares.
Score score_of(std::uint64_t seed, const random_record::Wish &wish);
}  // namespace detection_score
