#include "reduce/bearing/assembly.h"
#include "reduce/bearing/geometry.h"
#include <Eigen/LU>
#include <cmath>
#include <sstream>

// What is asked of an assembled bearing, and what is read from its states.
namespace mill::bearing {
BearingModel rigid_model(const RollerBearing &bearing)
{
  BearingModel model;
  model.bearing = bearing;
  model.roller  = roller_law(bearing);
  return model;
}

RingLoading radial_drive(const double load, const double tilt)
{
  RingLoading loading;
  loading.value << load, 0, 0, 0, tilt;
  return loading;
}

std::string loading_text(const RingLoading &loading)
{
  static const char *load[5]   = {"F_x", "F_y", "F_z", "M_x", "M_y"};
  static const char *motion[5] = {"x", "y", "z", "tilt about x", "tilt about y"};
  std::ostringstream text;
  const char *between = "";
  for (std::size_t i = 0; i < 5; ++i) {
    const double value = loading.value[Eigen::Index(i)];
    if (value == 0)
      continue;
    text << between;
    if (loading.prescribed[i])
      text << motion[i] << " = " << (i < 3 ? value * 1e6 : value * 1e3) << (i < 3 ? " um" : " mrad");
    else
      text << load[i] << " = " << value / 1e3 << (i < 3 ? " kN" : " kN m");
    between = ", ";
  }
  return *between ? text.str() : "no load";
}

double radial_tangent(const AssemblyState &state, const RingLoading &loading)
{
  const double radial = state.load.head<2>().norm();
  // x and y always follow the load; with them the components that a load loadings.
  std::vector<Eigen::Index> follow{0, 1};
  for (std::size_t i = 2; i < 5; ++i)
    if (!loading.prescribed[i])
      follow.push_back(Eigen::Index(i));
  Eigen::VectorXd towards = Eigen::VectorXd::Zero(Eigen::Index(follow.size()));
  // The rounding of rollers that balance each other has no direction.
  towards[0] = 1;
  if (radial > 1e-9 * state.roller_load.sum())
    towards.head(2) = state.load.head<2>() / radial;
  const Eigen::MatrixXd K = state.tangent(follow, follow);
  return 1 / towards.dot(K.fullPivLu().solve(towards));
}

double stiffness_along(const AssemblyState &state, const RingLoading &loading, const int axis)
{
  std::vector<Eigen::Index> free;
  Eigen::Index place = 0;
  for (int i = 0; i < 5; ++i)
    if (!loading.prescribed[std::size_t(i)] || i == axis) {
      if (i == axis)
        place = Eigen::Index(free.size());
      free.push_back(i);
    }
  const Eigen::VectorXd along = Eigen::VectorXd::Unit(Eigen::Index(free.size()), place);
  const Eigen::MatrixXd K     = state.tangent(free, free);
  return 1 / K.fullPivLu().solve(along)[place];
}

double radial_secant(const AssemblyState &state)
{
  const double radial = state.load.head<2>().norm();
  return radial > 0 ? radial * radial / state.load.head<2>().dot(state.motion.head<2>()) : 0;
}

CageVariation cage_variation(const BearingModel &model, const RingLoading &loading, const int n)
{
  if (n < 1)
    throw InputError("bearing." + model.bearing.name + ": the variation over a pitch needs at least one angle");
  const double pitch = 2 * M_PI / model.bearing.rollers_per_row;
  CageVariation out{pitch / n * Eigen::VectorXd::LinSpaced(n, 0, n - 1), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  BearingAssembly assembly(model);
  for (int i = 0; i < n; ++i) {
    assembly.turn_cage(model.cage_angle + out.angle[i]);
    const AssemblyState state = assembly.solve(loading);
    out.tangent[i]            = radial_tangent(state, loading);
    out.secant[i]             = radial_secant(state);
  }
  return out;
}
}  // namespace mill::bearing
