#pragma once
#include "core/model/lumped.h"
#include "core/records/stand_model.h"
#include <Eigen/Core>
#include <string>

// A stand of any number of unknowns on disk: matrices as Matrix Market files, names as CSV, and a kind = "lumped"
// case that names them.
namespace mill {
struct Case;

/// (p + 1, n): rows of the points, m per unknown, then of the load cell, N per unknown.
Eigen::MatrixXd readings_of(const StandModel &stand);

/// CSV: of, number, name, coordinate, position [m], direction, unit; a row for each unknown and each reading.
std::string model_names_csv(const StandModel &stand);

/// The case that names the files of a model; its paths as they stand in `files`.
/// @param origin     passes and dynamics come from it
/// @param directory  that the paths of the passes are made relative to
std::string detailed_model_toml(const ModelFiles &files, const Case &origin, const std::string &directory);

/// Reads matrices and names; the springs between the parts are in K_parts, there are no connections and no lines.
/// @throws InputError  of a file with its place; sizes that do not fit, a matrix that is not symmetric, fewer than
///         six readings, names that do not fit the matrices
StandModel detailed_model_of(const ModelFiles &files);
}  // namespace mill
