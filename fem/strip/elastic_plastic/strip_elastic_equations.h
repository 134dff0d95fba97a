#pragma once
#include "fem/strip/elastic_plastic/strip_elastic_grid.h"
#include <Eigen/SparseCore>
#include <string>
#include <vector>

// The equations of the elastic-plastic strip with their exact tangent.  theory.md 19.4
namespace mill::fem {
/// A pass in numbers near one: lengths over the entry thickness, speeds over the roll's, stresses over a flow
/// stress.
struct ElasticPass {
  const bite::RollBite *bite = nullptr;
  StripElasticModel model;
  double length           = 1;      ///< m, of one unit
  double stress           = 1;      ///< Pa, of one unit
  double speed            = 1;      ///< m/s, of one unit; 1 where the roll's speed is not given
  double exit             = 1;      ///< -, exit thickness
  double radius           = 1;      ///< -, of the roll
  double arc_length       = 1;      ///< -, geometric, rigid roll
  double reduction        = 1;      ///< -, ln(h1/h2)
  double mean_rate        = 1;      ///< -, of shear, 2 ln(h1/h2) / arc length
  double shear_compliance = 0;      ///< -, 1/(2 G) of the strip
  double bulk_compliance  = 0;      ///< -, 1/K of the strip
  double inlet_strain     = 0;      ///< -
  bool film               = false;  ///< friction answers to the speeds of the strip
};
/// @throws InputError  as solve_elastic_strip
ElasticPass elastic_pass(const bite::RollBite &bite, const StripElasticModel &model);

/// Where a continuation stands.
struct ElasticStage {
  double cutoff_strain_rate = 1;  ///< -, g0 over the mean rate of shear
  double cutoff_slip        = 1;  ///< -, d0 over ln(h1/h2)
  double softness = 1e-2;  ///< -, roll pressure times gap (over a hundredth of h1) that is taken as zero, (19.12)
  double compliance = 0;   ///< -, share of the strip's elasticity that acts
  double flattening = 0;   ///< -, share of the roll's flexibility that acts
  bool held_shape   = true;   ///< rows stay; the roll presses from its geometric entry to the line of centres
  bool held_arc     = false;  ///< the roll's surface does not answer to pressure: for derivatives only
  int thinnest      = 0;      ///< spine whose thickness is the exit thickness, elastic roll only
};

/// Flexibility of the roll at the spines that may touch, per nodal force, scaled.
struct ElasticRoll {
  Eigen::MatrixXd displacement, slope;  ///< (spines, spines); empty: rigid
};
/// @throws InputError  the given flexibility does not reach the spines
ElasticRoll elastic_roll(const ElasticPass &pass, const ElasticGrid &grid,
                         const bite::ArcFlexibility *flexibility);

/// State at a point of the mesh: row r of element (I, J) at its Radau point k.
struct ElasticPoint {
  double xx = 0, yy = 0, xy = 0;  ///< -, deviatoric stress
  double shear  = 0;              ///< -, plastic, over the element at the rate there
  double strain = 0;              ///< -, thickness strain
  double rate   = 0;              ///< -, plastic, of shear
  bool yields   = false;
};
/// Contact at a spine.
struct ElasticContact {
  double pressure = 0, shear = 0;  ///< -
  double slip    = 0;              ///< -, strip speed over roll speed - 1
  double gap     = 0;              ///< -
  double limited = 0;              ///< -, mu p over the limit of friction
  double surface = 0;              ///< -, height of the roll
};

struct ElasticEquations {
  Eigen::VectorXd residual;                     ///< (unknowns)
  std::vector<Eigen::Triplet<double>> entries;  ///< of its derivatives
  Eigen::VectorXd force_by, traction_by;        ///< (unknowns)
  double force          = 0;                    ///< -, vertical, on the roll
  double traction       = 0;                    ///< -, friction along the arc
  double force_x        = 0;                    ///< -, horizontal, of the roll on the strip
  double friction_power = 0;                    ///< -
  double plastic_power  = 0;                    ///< -, of half the strip
  std::vector<ElasticPoint> points;             ///< (2 (3 (I n_through + J) + r) + k)
  std::vector<ElasticContact> contacts;         ///< (spines)
  bool solved = true;                           ///< false: a row of points found no stress
};
/// Stress along the rows as it came out last, where the next solution is looked for first; empty: nowhere yet.
using RowMemory = std::vector<Eigen::Matrix<double, 2 * n_row_state, 1>>;
/// All equations.  Stress and strain behind the elements follow from the upstream ones: those unknowns are set
/// here.
/// @param tangent  false: residual only
/// Cost: 20 us an element, 80 us with the tangent.
ElasticEquations elastic_equations(const ElasticPass &pass, const ElasticGrid &grid, const ElasticRoll &roll,
                                   const ElasticStage &stage, Eigen::VectorXd &unknowns, RowMemory &memory,
                                   bool tangent);

/// Start: even flow through the gap.
Eigen::VectorXd first_guess(const ElasticPass &pass, const ElasticGrid &grid);

/// Inside of elastic_equations.
class ElasticAssembly {
public:
  ElasticAssembly(const ElasticPass &p, const ElasticGrid &g, const ElasticRoll &r, const ElasticStage &s,
                  Eigen::VectorXd &u, RowMemory &memory, bool with_tangent);
  void element(int I, int J);     ///< stress along its rows, equilibrium, volume
  void streamline(int I, int J);  ///< upper line of an element
  void contact();
  void bulk();  ///< both ends, what is given
  ElasticEquations out;
  RowMemory solved_rows;

private:
  static constexpr int n_local = 45;
  using Row                    = Eigen::Matrix<double, 1, n_local>;
  /// Along a Gauss row at a share t of the element: velocity derivatives by the element's coordinates, speed
  /// along, slope and height of the row.
  struct Flow {
    double u_along, u_through, v_along, v_through, u, slope, height;  ///< scaled
  };
  struct Local;
  Flow flow(const Local &e, int r, double t) const;
  Eigen::Matrix<double, 8, n_local> stresses(Local &e, int r, RowSolution &rows) const;
  void equilibrium(Local &e, int r, int k, const ElasticPoint &p, const Eigen::Matrix<double, 3, n_local> &by);
  void volume(Local &e, int r, int k);
  void upstream_face(Local &e, int r);
  void spine_contact(int i);
  /// Length of a column of elements and its derivatives by the ends of the contact.
  std::pair<double, std::array<double, 2>> element_length(int I) const;
  double value(const int id) const
  {
    return id < 0 ? 0 : unknowns[id];
  }
  void add(const int row, const int column, const double derivative)
  {
    if (tangent && row >= 0 && column >= 0)
      out.entries.emplace_back(row, column, derivative);
  }

  const ElasticPass &pass;
  const ElasticGrid &grid;
  const ElasticRoll &roll;
  const ElasticStage &stage;
  Eigen::VectorXd &unknowns;
  RowMemory &memory;
  const bool tangent;
  StripMaterial material;
  double bulk_compliance = 0;    ///< -, of the stage
  Eigen::VectorXd lifted_slope;  // (spines) of the flattening
};
}  // namespace mill::fem
