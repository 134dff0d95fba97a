#pragma once
#include "fem/stack/contact_stations.h"
#include "fem/stack/roll_kernel.h"
#include <Eigen/LU>
#include <memory>
#include <vector>

namespace mill::fem {
/// The pressure on a contact line: what the roll feels of it next to the line itself.
struct LinePatch {
  double half_width      = 0;  ///< m
  PatchPressure pressure = PatchPressure::semi_ellipse;
};

/// What forces on a roll do, the contacts left out: (N) m towards the axis for each of its lines, and for a roll
/// that nothing holds their resultants, (k) N and N m.
struct RollAnswer {
  std::vector<Eigen::VectorXd> offset;
  Eigen::VectorXd resultant;
};

/// One roll at its place in a stack: flexibility between its contact lines at all their angles.  A roll on two or
/// more supports is held by them; any other has the motions of a rigid roll as unknowns, for each plane a
/// translation and a rotation about z = 0 of the mill frame.  theory.md 51.4
class StackedRoll {
public:
  /// @param planes  1: y alone; 2: x and y
  StackedRoll(const StackRoll &roll, std::shared_ptr<const RollKernel> kernel, int planes);

  /// A line that bears load, or (`watched`) where the displacement next to an earlier line is read.
  /// @param outward  from the axis to the line
  std::size_t add_line(const std::array<double, 2> &outward, const ContactStations &stations,
                       const LinePatch &patch);
  std::size_t watch_line(std::size_t next_to, const ContactStations &stations);
  void forget_lines();
  void finish();
  /// Loads and motions of the supports as they are now in the roll; finish() takes them too.
  void take_loads();

  bool has_surface() const
  {
    return kernel->has_surface();
  }
  Eigen::Index motions() const
  {
    return held ? 0 : 2 * planes;
  }
  /// (N_i, N_j) m/N, displacement of line i towards the axis under forces on line j.
  const Eigen::MatrixXd &flexibility(std::size_t i, std::size_t j) const
  {
    return pairs[i * lines.size() + j];
  }
  /// (N, motions) displacement of a line away from the axis per unit of the motions.
  const Eigen::MatrixXd &motion(const std::size_t line) const
  {
    return lines[line].motion;
  }
  const RollAnswer &unloaded() const
  {
    return by_loads;
  }
  RollAnswer answer_to(const std::vector<StackLoad> &loads) const;

  struct Deflection {
    Eigen::VectorXd z;              ///< (M) m, mill frame
    Eigen::VectorXd x, y;           ///< (M) m, of the axis
    std::vector<double> reactions;  ///< N, along y, of the supports
    std::vector<double> across;     ///< N, along x
  };
  /// @param force   N, on the stations of each line
  /// @param motion  (motions)
  Deflection deflection(const std::vector<Eigen::VectorXd> &force, const Eigen::VectorXd &motion) const;

private:
  struct Line {
    std::array<double, 2> outward;
    ContactStations stations;
    Eigen::SparseMatrix<double> spread;
    Eigen::MatrixXd motion;
    std::size_t next_to;  // itself, unless it is watched
    LinePatch patch;
    bool bears;
  };
  // One plane with its supports: flexibility of stations and points, and what the supports and the rigid motions
  // add: unknowns are the reactions, then translation and rotation.
  struct Plane {
    Eigen::MatrixXd flexibility;
    Eigen::MatrixXd by_force;     // (supports + 2, M + P)
    Eigen::VectorXd by_supports;  // (supports + 2), by their own motions
    Eigen::VectorXd moved;        // (M + P) m, by these
    Eigen::MatrixXd G;            // (M + P, supports + 2), what the unknowns do
    Eigen::PartialPivLU<Eigen::MatrixXd> factor;
    std::vector<std::size_t> support;
  };
  std::size_t axis_of(const int plane) const
  {
    return plane == 0 ? 1 : 0;  // y first
  }
  Eigen::Index stations() const
  {
    return kernel->edge.size() - 1;
  }
  void hold(Plane &plane, std::size_t axis) const;
  void move_feet(Plane &plane, std::size_t axis) const;
  Eigen::MatrixXd half_space(const Line &line, const Line &loaded) const;
  Eigen::MatrixXd lever_columns() const;  // (M + P, 2): 1, z

  const StackRoll &roll;
  std::shared_ptr<const RollKernel> kernel;
  int planes;
  bool held = true;
  std::vector<Line> lines;
  std::vector<Plane> in_plane;
  std::vector<Eigen::MatrixXd> pairs;
  RollAnswer by_loads;
};
}  // namespace mill::fem
