#pragma once
#include "core/laws/flow_stress_law.h"
#include "core/numerics/derivative.h"
#include "fem/strip/rigid_plastic/strip_flow_grid.h"
#include <Eigen/SparseCore>

// The one residual of the rolled strip: all unknowns, all inputs, by automatic differentiation.  theory.md 18
namespace mill::fem {
/// A pass in numbers near one: lengths over the entry thickness, speeds over the roll's, stresses over a flow
/// stress.
struct StripPass {
  const bite::RollBite *bite              = nullptr;
  const bite::ArcFlexibility *flexibility = nullptr;  ///< only with Arc::elastic
  StripFlowModel model;
  double length     = 1;                 ///< m, of one unit
  double stress     = 1;                 ///< Pa, of one unit
  double speed      = 1;                 ///< m/s, of one unit; 1 where the roll's speed is not given
  double arc_length = 1;                 ///< -, geometric, rigid roll
  double mean_rate  = 1;                 ///< -, of shear, 2 ln(h1/h2) / arc length
  std::array<double, 3> mean_rate_by{};  ///< of it by entry and exit thickness and the radius of a rigid arc
  double exit_slip     = 0;              ///< -, forward slip of a slab theory, for the start
  double friction      = 0;              ///< -, coefficient of a slab theory, for the start
  double more_friction = 1;  ///< -, multiple of the friction with which a bite next to skidding is begun
  double start_radius  = 0;  ///< -, of the circle to begin with, that of a slab theory where the roll is flattened
  double held_radius   = not_given;  ///< -, while the shape of the arc is held
};
/// @throws InputError  as solve_strip_flow
StripPass strip_pass(const bite::RollBite &bite, const StripFlowModel &model,
                     const bite::ArcFlexibility *flexibility);

/// Where a continuation stands.
struct StripStage {
  double cutoff_strain_rate = 1;      ///< -, g0 over the mean rate of shear
  double cutoff_slip        = 0.3;    ///< -, d0
  bool picard               = true;   ///< viscosity and friction limit of the present state, not differentiated
  bool free_surface         = false;  ///< heights and entry are unknowns
  bool release              = false;  ///< exit is an unknown
  double end_pressure       = 0;      ///< -, of the roll at the exit where it is released
  double flexibility        = 0;      ///< -, share of the roll's flexibility that acts
  double tension            = 1;      ///< -, share of both tensions that acts
  double friction           = 1;      ///< -, multiple of the friction that acts
  bool arc_held             = false;  ///< the arc does not answer to pressure: for derivatives only
};

/// A sum over the contact with its derivatives by all columns.
struct StripSum {
  double value = 0;    ///< scaled
  Eigen::VectorXd by;  ///< (unknowns + inputs)
};

struct StripEquations {
  Eigen::VectorXd residual;                     ///< (unknowns)
  std::vector<Eigen::Triplet<double>> entries;  ///< of its derivatives by the unknowns
  Eigen::MatrixXd by_input;                     ///< (unknowns, n_inputs)
  StripSum force;                               ///< vertical, per width, on the roll
  StripSum traction;          ///< friction along the arc, per width: torque over the roll's radius
  double force_x        = 0;  ///< scaled, horizontal, of the roll on the strip
  double dissipation    = 0;  ///< scaled, of half the strip
  double friction_power = 0;  ///< scaled
  Eigen::MatrixXd nodes;      ///< (contact spines, 6) abscissa, pressure, shear, slip, weight, mu p
                              ///< over the limit
};
/// All equations at given unknowns.
/// @param before   of the last step, or null: tangent of the present state
/// @param after    filled for the next step, or null
/// @param longest  to which predicted directions of the rate of deformation are cut, 1 at the solution
/// Cost: 15 us an element.
StripEquations strip_equations(const StripPass &pass, const StripGrid &grid, const StripStage &stage,
                               const Eigen::VectorXd &unknowns, const StripDirections *before = nullptr,
                               StripDirections *after = nullptr, double longest = 1);

/// Height of the circle of the roll over the mid plane; T double or Dual.
template <class T> T circle_height(const T &exit_thickness, const T &offset, const T &radius, const T &x)
{
  using std::sqrt;
  return 0.5 * exit_thickness + offset + radius - sqrt(radius * radius - x * x);
}

/// The roll's surface under the pressures of the contact, relative to its axis, scaled.
struct FlattenedArc {
  Eigen::VectorXd displacement;  ///< (n) at the spines in contact, towards the axis
  Eigen::VectorXd slope;         ///< (n) of it along the strip
  Eigen::MatrixXd by_ends;       ///< (n, 2) by the abscissae of entry and exit
  Eigen::MatrixXd by_pressure;   ///< (n, n) by the pressures
};
/// All nan where the flexibility does not reach the ends of the contact.
FlattenedArc flattened_arc(const StripPass &pass, const StripGrid &grid, const Eigen::VectorXd &unknowns);

/// Start: even flow through the gap.
Eigen::VectorXd first_guess(const StripPass &pass, const StripGrid &grid);

/// Flow stress over the unit of stress at a strain.
template <class T> T scaled_flow_stress(const StripPass &pass, const T &strain);

/// Inside of strip_equations: the unknowns with the places their derivatives go to.
class StripAssembly {
public:
  StripAssembly(const StripPass &p, const StripGrid &g, const StripStage &s, const Eigen::VectorXd &u)
      : pass(p), grid(g), stage(s), unknowns(u)
  {
    out.residual = Eigen::VectorXd::Zero(g.n_unknowns);
    out.by_input = Eigen::MatrixXd::Zero(g.n_unknowns, bite::n_inputs);
    out.force.by = out.traction.by = Eigen::VectorXd::Zero(g.n_unknowns + bite::n_inputs);
    after.bulk.resize(7, 9 * g.n_along * g.n_through);
    after.slip.resize(3, g.last - g.first + 1);
    out.entries.reserve(std::size_t(800) * g.n_along * g.n_through);
  }
  double value(const int column) const;  ///< scaled, of an unknown, an input, or 0 where there is none
  void add(int row, double value)
  {
    out.residual[row] += grid.held[row] ? 0 : value;
  }
  void add(int row, int column, double derivative);
  /// Row of a sparse derivative: columns that are -1 do not exist.
  template <int n, std::size_t size>
  void add(const int row, const bite::Dual<n> &f, const std::array<int, size> &columns)
  {
    add(row, f.value);
    for (int i = 0; i < n; ++i)
      add(row, columns[i], f.by[i]);
  }
  template <int n, std::size_t size>
  static void add(StripSum &sum, const bite::Dual<n> &f, const std::array<int, size> &columns)
  {
    sum.value += f.value;
    for (int i = 0; i < n; ++i)
      if (columns[i] >= 0)
        sum.by[columns[i]] += f.by[i];
  }
  void bulk();         ///< equilibrium, incompressibility, strain
  void ends();         ///< inlet and outlet
  void streamlines();  ///< rows, free surfaces, entry
  void contact();      ///< friction, roll pressure
  void roll_shape();   ///< height of the surface in contact
  void whole();        ///< the remaining equations of the whole bite; after contact()
  void friction();     ///< its coefficient

  const StripPass &pass;
  const StripGrid &grid;
  const StripStage &stage;
  const Eigen::VectorXd &unknowns;
  const StripDirections *before = nullptr;
  double longest                = 1;  ///< -, predicted directions of the rate of deformation
  StripDirections after;
  StripEquations out;
};

template <class T> T scaled_flow_stress(const StripPass &pass, const T &strain)
{
  return bite::carried_flow_stress(pass.bite->strip.flow_stress, strain) / pass.stress;
}
}  // namespace mill::fem
