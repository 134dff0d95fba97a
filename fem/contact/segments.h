#pragma once
#include "core/model/surface.h"
#include <Eigen/Core>
#include <vector>

// Faces of contact surfaces, and quadrature over the parts of them that face another surface.  theory.md 12
namespace mill::contact {
/// Quadrature over the covered part of one slave face; q points, m nodes per face.
struct FaceRule {
  Eigen::VectorXd weight;       ///< (q) m2 (m in plane strain; times 2 pi r of a body of revolution)
  Eigen::MatrixXd slave;        ///< (q, m) shape functions of the slave face
  Eigen::MatrixXd hat;          ///< (q, m) piecewise linear functions of the same nodes
  Eigen::MatrixXd master;       ///< (q, m') shape functions of the master face met there
  Eigen::MatrixXi master_node;  ///< (q, m') its nodes
  Eigen::MatrixXd points;       ///< (q, d) m
  Eigen::MatrixXd normals;      ///< (q, d) outward, of the slave face itself
  Eigen::VectorXd gap;          ///< (q) m, along the slave's normal
  double measure = 0;           ///< m2, of the whole face
  Eigen::VectorXd whole_hat;    ///< (m) m2, integral of the hats over the whole face
};

/// (m, 1 or 2) parameters 0..1 of the nodes of a face.
Eigen::MatrixXd node_parameters(const Surface &surface);
/// Outward normal at a point of a face, as long as the face's measure per unit of its parameters.
Eigen::VectorXd area_vector(const Surface &surface, Eigen::Index face, const Eigen::VectorXd &position);

/// One rule per slave face; empty where nothing faces it.
std::vector<FaceRule> line_overlaps(const Surface &slave, const Surface &master, double reach);
std::vector<FaceRule> polygon_overlaps(const Surface &slave, const Surface &master, double reach);
/// Rules over the whole faces, no master.
std::vector<FaceRule> whole_faces(const Surface &slave);
}  // namespace mill::contact
