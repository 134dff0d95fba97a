#pragma once
#include "core/base/errors.h"
#include "core/model/material.h"
#include "core/model/roller_bearing.h"
#include <string>
#include <vector>

// Bearings by their designation: the table that is part of the program (core/case/bearings.csv) and the user's
// own.
namespace mill {
/// One line of a catalogue.
struct CatalogueBearing {
  std::string designation;          ///< as written, "LM761649D/LM761610/LM761610D"
  std::optional<BearingType> type;  ///< absent: not a roller bearing, and reported
  double bore             = 0;      ///< m, d
  double outside_diameter = 0;      ///< m, D
  double width            = 0;      ///< m, B, over all rows
  int rows                = 0;
  double dynamic_rating   = not_given;  ///< N, C; absent: the source does not say
  double static_rating    = not_given;  ///< N, C0
  double e                = not_given;  ///< -, 1.5 tan(contact angle); the column may be left out
  std::string source;                   ///< where the figures come from
  Place place;                          ///< of the designation
};

/// Reads a catalogue: columns designation, type, d, D, B (lengths), rows, C, C0 (forces), source, and e where it
/// is known. C, C0 and e may be empty in a line.
/// @param file  named in messages
/// @throws InputError with file:line:column, every problem of the table at once: a column missing, unknown, twice
///         or with a wrong unit; a cell that is not a number or does not describe a bearing; a designation that
///         appears twice
std::vector<CatalogueBearing> catalogue_of(const std::string &file, const std::string &text);

/// The table the program brings along.
const std::vector<CatalogueBearing> &shipped_catalogue();

/// The bearing of this designation, capitals, blanks and signs not minded; what stands before the first slash is
/// enough where it names one bearing alone.  nullptr: none
const CatalogueBearing *find_bearing(const std::vector<CatalogueBearing> &catalogue,
                                     const std::string &designation);

/// The designations nearest to this word, at most `most` of them.
std::vector<std::string> nearest_designations(const std::vector<CatalogueBearing> &catalogue,
                                              const std::string &designation, std::size_t most = 3);
}  // namespace mill
