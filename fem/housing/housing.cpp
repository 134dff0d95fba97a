#include "fem/housing/housing.h"
#include "core/base/errors.h"
#include "core/numerics/mesh_pair.h"
#include "fem/body/held_stiffness.h"
#include <cmath>
#include <stdexcept>

namespace mill::fem {
namespace {
// Quarters that the two housings consist of.
constexpr double n_quarters = 8;

// Energy and masses of the parts, from the quadrature of the assembly.
void add_parts(HousingStatics &out, const MillHousing &h, const ElasticBody &quarter)
{
  const double E = h.steel.youngs_modulus, nu = h.steel.poisson_ratio;
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  std::array<double, n_housing_parts> moving{}, rising{};
  quarter.each_cell([&](const std::vector<int> &nodes, const std::vector<SolidPoint> &points) {
    Eigen::Matrix3Xd u(3, Eigen::Index(nodes.size()));
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      u.col(Eigen::Index(a)) = out.displacement.segment<3>(3 * nodes[a]);
      middle += quarter.nodes().row(nodes[a]) / double(nodes.size());
    }
    const auto part = std::size_t(housing_part(h, middle));
    for (std::size_t q = 0; q < points.size(); ++q) {
      const Eigen::Matrix3d gradient = u * points[q].gradient.transpose();
      const Eigen::Matrix3d strain   = 0.5 * (gradient + gradient.transpose());
      const Eigen::Vector3d position = u * points[q].value;
      const double weight            = n_quarters * points[q].weight;
      out.energy[part] += weight * (lambda * strain.trace() * strain.trace() + 2 * mu * strain.squaredNorm());
      out.mass[part] += weight * h.steel.density;
      moving[part] += weight * h.steel.density * position.squaredNorm();
      rising[part] += weight * h.steel.density * position[1] * position[1];
    }
  });
  for (std::size_t p = 0; p < n_housing_parts; ++p) {
    const double reference = p == upper_post || p == upper_beam ? out.u_screw : out.u_seat;
    out.reduced_mass[p]    = moving[p] / (reference * reference);  // (23.8)
    out.vertical_mass[p]   = rising[p] / (reference * reference);
  }
}

// Shares of the two flexibilities by strain energy.
void share_flexibility(HousingStatics &out)
{
  const auto &e = out.energy;
  out.exchanged = e[upper_post] + e[upper_beam] - out.u_screw;  // (23.6)
  for (const auto &[post, beam, whole] :
       {std::tuple{upper_post, upper_beam, out.u_screw}, std::tuple{lower_post, lower_beam, -out.u_seat}})
    for (const HousingPart part : {post, beam})
      out.flexibility[part] = whole * e[part] / (e[post] + e[beam]);  // (23.7)
}
}  // namespace

HousingPart housing_part(const MillHousing &h, const Eigen::RowVector3d &middle)
{
  const double x = middle[0], y = middle[1], a = 0.5 * h.window_width, r = h.fillet_radius;
  const bool upper    = y > h.foot_height;
  const double beam   = upper ? h.upper_beam_height : h.lower_beam_height;
  const double inward = upper ? h.window_height - y : y;  // from the end of the window
  // Side of the line from the outer corner (a + b, -beam) to the middle of the fillet.
  const double bisector = r * (1 - std::sqrt(0.5));
  const double corner_x = a + h.post_width, fillet_x = a - bisector, fillet_y = bisector;
  const double side = (fillet_x - corner_x) * (inward + beam) - (fillet_y + beam) * (x - corner_x);
  const bool post   = inward > r || (x > a - r && side < 0);
  return upper ? (post ? upper_post : upper_beam) : (post ? lower_post : lower_beam);
}

std::vector<char> held_housing(const ElasticBody &quarter)
{
  std::vector<char> held(std::size_t(3 * quarter.nodes().rows()), 0);
  for (const int node : quarter.group("symmetry.x"))
    held[std::size_t(3 * node)] = 1;
  for (const int node : quarter.group("symmetry.z"))
    held[std::size_t(3 * node + 2)] = 1;
  mean_vertical(quarter, HousingGroup::foot);
  held[std::size_t(3 * quarter.group(word_of(HousingGroup::foot)).front() + 1)] = 1;
  return held;
}

Eigen::VectorXd mean_vertical(const ElasticBody &quarter, const HousingGroup group)
{
  Eigen::VectorXd weights;
  try {
    weights = quarter.face_weights(word_of(group));
  } catch (const std::out_of_range &) {
    throw InputError(std::string("housing: nothing ") + (group == HousingGroup::foot ? "holds" : "loads") +
                     " it in the direction y (vertical), its mesh has no group \"" + word_of(group) +
                     "\": mesh it with feet and both pads");
  }
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3 * weights.size());
  for (Eigen::Index n = 0; n < weights.size(); ++n)
    out[3 * n + 1] = weights[n] / weights.sum();
  return out;
}

HousingStatics housing_statics(const MillHousing &housing, const ElasticBody &quarter)
{
  const Eigen::VectorXd screw  = mean_vertical(quarter, HousingGroup::screw),
                        seat   = mean_vertical(quarter, HousingGroup::seat),
                        foot   = mean_vertical(quarter, HousingGroup::foot);
  const std::vector<char> held = held_housing(quarter);
  const HeldStiffness stiffness(quarter.unit_stiffness(), held);
  const Eigen::VectorXd load = (screw - seat) / n_quarters;  // in balance: the pin carries nothing
  HousingStatics out;
  out.n_unknowns   = stiffness.n_unknowns();
  out.displacement = stiffness.displacement(load) / quarter.stiffness_unit();
  const double up  = foot.dot(out.displacement);
  for (Eigen::Index i = 1; i < out.displacement.size(); i += 3)
    out.displacement[i] -= up;
  out.u_screw = screw.dot(out.displacement);
  out.u_seat  = seat.dot(out.displacement);
  if (!(out.u_screw > 0 && out.u_seat < 0))
    throw SolverError(
        {"housing: under a force that opens the window the screw pad moves " + std::to_string(1e12 * out.u_screw) +
             " pm/N and the seat " + std::to_string(1e12 * out.u_seat) + " pm/N upwards",
         "", "the feet stand where the bending of a post lifts them more than the load moves the pad",
         "check housing.foot_height and the heights of the beams", ""});
  const Eigen::VectorXd force =
      quarter.unit_stiffness().selfadjointView<Eigen::Upper>() * out.displacement * quarter.stiffness_unit() -
      load;
  for (Eigen::Index i = 0; i < force.size(); ++i)
    if (i % 3 == 1 || !held[std::size_t(i)])  // the planes of symmetry carry reactions, the pin must not
      out.force_error = std::max(out.force_error, std::abs(force[i]) * n_quarters);
  add_parts(out, housing, quarter);
  share_flexibility(out);
  return out;
}

void estimate_error(HousingStatics &fine, const HousingStatics &coarse, const double ratio)
{
  const auto share = [&](const double a, const double b) { return mesh_pair_error(a, b, ratio * ratio); };
  const auto mass  = [](const HousingStatics &s, const HousingPart post, const HousingPart beam) {
    return s.reduced_mass[post] + s.reduced_mass[beam];
  };
  fine.error = {share(fine.u_screw, coarse.u_screw), share(fine.u_seat, coarse.u_seat),  // (23.9)
                share(mass(fine, upper_post, upper_beam), mass(coarse, upper_post, upper_beam)),
                share(mass(fine, lower_post, lower_beam), mass(coarse, lower_post, lower_beam))};
  for (std::size_t i = 0; i < n_housing_parts; ++i) {
    fine.flexibility_error[i] = share(fine.flexibility[i], coarse.flexibility[i]);
    fine.mass_error[i]        = share(fine.reduced_mass[i], coarse.reduced_mass[i]);
  }
}

Frame frame_with_housing(Frame frame, const HousingStatics &h)
{
  frame.upper_post_stiffness = 1 / h.flexibility[upper_post];
  frame.upper_beam_stiffness = 1 / h.flexibility[upper_beam];
  frame.lower_post_stiffness = 1 / h.flexibility[lower_post];
  frame.lower_beam_stiffness = 1 / h.flexibility[lower_beam];
  frame.upper_post_mass      = h.reduced_mass[upper_post];
  frame.upper_beam_mass      = h.reduced_mass[upper_beam];
  frame.lower_post_mass      = h.reduced_mass[lower_post];
  frame.lower_beam_mass      = h.reduced_mass[lower_beam];
  return frame;
}

void write_housing_vtu(const std::string &path, const ElasticBody &quarter, const HousingStatics &housing,
                       const double force)
{
  quarter.write_vtu(path, force * housing.displacement, Eigen::VectorXd::Zero(quarter.nodes().rows()));
}
}  // namespace mill::fem
