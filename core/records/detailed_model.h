#pragma once
#include "core/model/lumped.h"
#include "core/records/stand_model.h"
#include <Eigen/Core>
#include <map>
#include <string>

// A stand of any number of unknowns on disk: matrices as Matrix Market files, names as CSV, and a kind = "lumped"
// case that names them.
namespace mill {
struct Case;

/// (p + 1, n): rows of the points, m per unknown, then of the load cell, N per unknown.
Eigen::MatrixXd readings_of(const StandModel &stand);

/// CSV: of, number, name, coordinate, position [m], direction, unit; a row for each unknown and each reading.
std::string model_names_csv(const StandModel &stand);

/// CSV: connection, stiffness [N/m], error_estimate; a row for each spring of each connection, in the order of
/// strains_of(); an error that is not known is empty.
std::string connections_csv(const StandModel &stand);
/// (r, n): rows of all springs of all connections.
Eigen::MatrixXd strains_of(const StandModel &stand);

/// Names of the files of a model in a folder, "models/beam-mass.mtx"; those of the connections only where it has
/// some.
ModelFiles named_files(const StandModel &stand, const std::string &folder);
/// What stands in them, by the names they have in `files`.
std::map<std::string, std::string> texts_of(const StandModel &stand, const ModelFiles &files);

/// The case that names the files of a model; its paths as they stand in `files`.
/// @param origin     passes and dynamics come from it
/// @param directory  that the paths of the passes are made relative to
std::string detailed_model_toml(const ModelFiles &files, const Case &origin, const std::string &directory);

/// Reads matrices and names.  Where files say the connections, these leave K_parts; else they stay in it.  There
/// are no lines.
/// @throws InputError  of a file with its place; sizes that do not fit, a matrix that is not symmetric, fewer than
///         six readings, names that do not fit the matrices; connections that the stiffness does not hold
StandModel detailed_model_of(const ModelFiles &files);
}  // namespace mill
