#pragma once
#include <Eigen/Core>
#include <string>

namespace mill {
/// A real matrix in Matrix Market coordinate form: entries that are not zero, column by column, with the digits
/// that read back as the same double; of a symmetric matrix the lower triangle ("symmetric").
/// @param comment  one line, what it is and in which unit
/// Source: R. F. Boisvert, R. Pozo, K. A. Remington, The Matrix Market Exchange Formats, NISTIR 5935 (1996).
std::string matrix_market_text(const Eigen::MatrixXd &matrix, const std::string &comment);

/// Reads what matrix_market_text() wrote, and any real or integer matrix, coordinate or array, general or
/// symmetric, of at most 10 000 rows and columns.
/// @throws InputError with file:line  another header, a size or an entry that is none, an entry twice or outside
/// the
///         matrix, one that is not finite, fewer or more entries than the header says
Eigen::MatrixXd read_matrix_market(const std::string &path);
}  // namespace mill
