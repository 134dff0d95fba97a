#pragma once
#include "app/study/study_folder.h"
#include <string>
#include <vector>

namespace mill {
/// All rows of a study in the order of its design, with the results that are there.
struct StudyRows {
  std::vector<DesignRow> design;
  std::vector<std::vector<double>> results;  ///< (rows) of (watched); empty: not computed yet, or failed
  std::vector<std::string> failures;         ///< (rows) sentence; empty: not failed
  long finished = 0, failed = 0;
};

/// @throws InputError, SystemError  study.db or finished.db cannot be read
StudyRows study_rows(const Study &study);

/// A number with its 95 % interval.
struct Estimated {
  double value = not_given, low = not_given, high = not_given;
};

/// What a sample says of one result.  theory 52.1, 52.2
struct ResultStatistics {
  long n = 0;
  Estimated mean, sd, q025, median, q975;  ///< in the unit of the result; quantiles by order statistics
  std::vector<double> shares;      ///< (keys) -, of the variance by linear regression, squared coefficients
  double explained = not_given;    ///< -, R2 of that regression
  std::vector<double> bin_edges;   ///< of a histogram, in the unit of the result
  std::vector<double> bin_shares;  ///< (bins) -, of the rows
};

/// @param place  of the result among the watched ones
/// @param rows   number of rows from the start that are a sample of the inputs (Saltelli: two groups); 0: all
/// @throws InputError  fewer than three finished rows
ResultStatistics statistics_of(const Study &study, const StudyRows &rows, std::size_t place, long sample_rows = 0);

/// Mean and standard deviation of one input by its distribution, in its unit.
double mean_of(const Spread &spread);
double deviation_of(const Spread &spread);
}  // namespace mill
