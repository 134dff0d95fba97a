#pragma once
#include "core/model/material.h"
#include "tests/manual/peer/mesh.h"
#include <cstdio>
#include <string>

// CalculiX as a program: its decks, its runs, its results.
namespace mill::verify::peer {
/// "CalculiX 2.20, run on 2026-11-22".  @throws verify::Skipped  not installed; says which package has it
std::string program_and_date();

/// One deck in a folder of its own, which is removed with it.  SI throughout.
class Deck {
public:
  /// Writes nodes, elements (C3D20) and the material.  @throws verify::Skipped  CalculiX is not installed
  Deck(const Mesh &mesh, const Material &material);
  ~Deck();
  Deck(const Deck &)            = delete;
  Deck &operator=(const Deck &) = delete;

  /// Direction 1..3 of these nodes is held.
  void hold(const std::vector<int> &nodes, int direction);
  /// Sum of weight x displacement in `direction` is zero.
  void hold_mean(const Weights &weights, int direction);

  /// Frictionless contact of two sets of faces, face to face with a linear penalty of `stiffness` (Pa/m); several
  /// may be given.
  void touch(const std::vector<Face> &slave, const std::vector<Face> &master, double stiffness);

  /// N, force that moves these nodes in `direction` by `motion` (m) with everything else as held.
  /// Errors as displacement()
  double force_to_move(const std::vector<int> &nodes, int direction, double motion);
  /// (nodes, 3) m, under nodal forces (N) in `direction`.
  /// @throws SolverError  CalculiX stopped; with the end of what it printed
  Eigen::MatrixXd displacement(const Weights &forces, int direction);
  /// (n) Hz, the lowest; rigid motions are among them.  Errors as displacement()
  Eigen::VectorXd frequencies(int n);

private:
  void line(const std::string &text);
  std::string run();  // contents of the printed results
  std::string folder_;
  std::FILE *file_ = nullptr;
  int contacts_    = 0;
  Eigen::Index n_nodes_;
};

/// sum weight x displacement in `direction` / sum weight
double mean(const Weights &weights, const Eigen::MatrixXd &displacement, int direction);

/// Forces that add up to `force` (N), spread as the weights.
Weights spread(const Weights &weights, double force);
}  // namespace mill::verify::peer
