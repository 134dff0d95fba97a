#pragma once
#include "reduce/bearing/oil_film/band_matrix.h"
#include "reduce/bearing/oil_film/film_grid.h"
#include <functional>
#include <optional>

namespace mill::bearing {
/// Why a film has no pressure field.
enum class FilmFailure { none, touching, unbounded_pressure, no_convergence };

/// Pressure in a film with rupture: p >= 0, flow balance R >= 0, p R = 0 at every node, theory.md (29.3), by
/// Newton's method on the carrying nodes.  Keeps the factor, so that small motions cost one solution each.
class Film {
public:
  /// @param start  another film whose grid has the same columns and rows, or half as many: where to look first
  Film(const FilmProblem &problem, FilmGrid grid, const Film *start = nullptr);

  const FilmProblem &problem() const
  {
    return of;
  }
  const FilmGrid &grid() const
  {
    return mesh;
  }
  FilmFailure failure() const
  {
    return failed;
  }
  const Eigen::MatrixXd &pressure() const  ///< (rows, columns), unit as in FilmProblem
  {
    return p;
  }
  const Eigen::MatrixXd &thickness() const  ///< (rows, columns), with the deflection of the surfaces
  {
    return h;
  }
  bool carries(const Eigen::Index row, const Eigen::Index column) const
  {
    return active(row, column);
  }
  int iterations() const
  {
    return steps;
  }

  using Opening = std::function<double(double, double)>;
  /// Change of the pressure with the distance of the rigid surfaces, on the same rupture boundary: theory.md
  /// (29.7).
  /// @param opening   change of that distance at angle and z: (angle, z) -> value
  /// @param squeeze   (rows, columns) rate of change of the whole film, or empty
  Eigen::MatrixXd response(const Opening &opening, const Eigen::MatrixXd &squeeze) const;

  /// From now on the rupture boundary of response() lies between the nodes, where the parabola of the pressure
  /// touches zero, theory.md (29.8).  The change of the pressure is then that of the film and not of the grid.
  void place_rupture();

  /// Flow out of both ends, in R c w L/2.
  double side_flow() const;

private:
  /// One number for each face: around after the node's column, along after row - 1 (row 0: towards the first end).
  struct Faces {
    Eigen::MatrixXd around, along;
  };
  /// A place in the grid; rows -1 and rows() are the ends.
  struct Node {
    Eigen::Index row, column;
  };
  /// Flow from node a to node b: couette h - factor h^3 (q_b - q_a).
  struct Face {
    Node a, b;
    double rigid, factor, couette;
    bool around;
  };
  template <class Visit> void each_face(const Visit &visit) const;
  double at(const Eigen::MatrixXd &field, const Node &node) const;
  Eigen::Index place_of(const Node &node) const;
  double film_at(const Face &face) const;
  double nearer_rupture(const Face &face, const Node &last) const;
  Eigen::Index band_width() const;
  void set_rigid();
  double face_place(Eigen::Index j) const;
  void take_start(const Film &start);
  void guess();
  void solve();
  void order_nodes();
  void update_pressure();
  Eigen::MatrixXd balance() const;
  void factor_balance(bool between_nodes);
  bool move_boundary(const Eigen::MatrixXd &rest);
  void settle();
  Eigen::Index next(const Eigen::Index i) const
  {
    return i + 1 < mesh.columns() ? i + 1 : 0;
  }
  bool is_held(const Eigen::Index j, const Eigen::Index i) const
  {
    return !std::isnan(mesh.held(j, i));
  }

  FilmProblem of;
  FilmGrid mesh;
  Faces rigid;                                  // film without pressure
  Eigen::MatrixXd around_factor, along_factor;  // of the conductances of the faces
  Eigen::MatrixXd q, p, slope, h;               // reduced pressure, pressure, dp/dq, film
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> active;
  Eigen::Array<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic> place;  // of the active nodes in the band
  std::vector<std::pair<Eigen::Index, Eigen::Index>> nodes;          // (row, column) by place
  std::optional<BandMatrix> factored;
  FilmFailure failed = FilmFailure::none;
  int steps          = 0;
};
}  // namespace mill::bearing
