#include "fem/housing/housing_component.h"
#include "core/numerics/root_search.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
PartSupport housing_support(const ElasticBody &quarter)
{
  PartSupport support;
  support.held  = held_housing(quarter);
  support.rigid = Eigen::MatrixXd::Zero(3 * quarter.nodes().rows(), 1);
  for (Eigen::Index i = 1; i < support.rigid.rows(); i += 3)
    support.rigid(i, 0) = 1;
  support.rigid_names = {"along y"};
  support.copies      = 8;
  return support;
}

PartInterface housing_interface(const ElasticBody &quarter)
{
  PartInterface interface;
  interface.names = word_list<HousingGroup>();
  interface.weights.resize(3 * quarter.nodes().rows(), Eigen::Index(interface.names.size()));
  for (const HousingGroup group : every<HousingGroup>())
    interface.weights.col(Eigen::Index(group)) = mean_vertical(quarter, group);
  return interface;
}

namespace {
// Of bending waves of post and beams with elements of these lengths; twice the radius of gyration is decisive.
double reach_of(const MillHousing &h, const double along_post, const double along_beam)
{
  const auto reach = [&](const double element, const double height) {
    return mesh_reach(element, height / std::sqrt(3), h.steel);
  };
  return std::min({reach(along_post, h.post_width), reach(along_beam, h.upper_beam_height),
                   reach(along_beam, h.lower_beam_height)});
}
}  // namespace

double housing_reach(const MillHousing &h, const ElasticBody &quarter)
{
  double along_post = 0, along_beam = 0;
  quarter.each_cell([&](const std::vector<int> &nodes, const std::vector<SolidPoint> &points) {
    const auto corners           = quarter.nodes()(nodes, Eigen::all).eval();
    const Eigen::RowVector3d box = corners.colwise().maxCoeff() - corners.colwise().minCoeff();
    double volume                = 0;
    for (const SolidPoint &point : points)
      volume += point.weight;
    // Mean length along the frame: in a corner the cells are wedges, longer outside.
    const HousingPart part = housing_part(h, corners.colwise().mean());
    if (part == upper_post || part == lower_post)
      along_post = std::max(along_post, volume / (box[0] * box[2]));
    else
      along_beam = std::max(along_beam, volume / (box[1] * box[2]));
  });
  return reach_of(h, along_post, along_beam);
}

double longest_housing_element(const MillHousing &h, const double frequency_limit)
{
  const auto reaches = [&](const double element) { return reach_of(h, element, element) > frequency_limit; };
  return border_between(0, 10 * (h.window_height + h.window_width), reaches)
      .holds;  // reach falls with the element
}

Component housing_component(const MillHousing &housing, const ElasticBody &quarter,
                            const HousingComponentOptions &options, ComponentBasis *basis)
{
  const double reach = housing_reach(housing, quarter);
  ModeChoice choice;
  choice.n_modes         = options.n_modes;
  choice.frequency_limit = options.frequency_limit;
  choice.residual_share  = options.residual_share;
  choice.reach           = options.n_modes < 0 ? reach : 0;
  const PartModel part("housing", quarter, housing_support(quarter));
  Component c = component_modes(part, housing_interface(quarter), choice, basis);

  // The feet do not move: their row and column go, the third of the interface.
  const Eigen::Index n = c.M.rows(), foot = 2;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < n; ++i)
    if (i != foot)
      kept.push_back(i);
  const auto without = [&](const Eigen::MatrixXd &A) -> Eigen::MatrixXd { return A(kept, kept); };
  c.M                = without(c.M);
  c.K                = without(c.K);
  c.residual         = c.residual.topLeftCorner(foot, foot).eval();
  c.interface.resize(std::size_t(foot));
  c.source = std::string("finite elements, ") + std::to_string(part.n_unknowns()) +
             " unknowns of a quarter of one housing";
  c.mass  = part.mass();
  c.reach = reach;
  if (basis)
    basis->constraint = basis->constraint.leftCols(foot).eval();
  return c;
}
}  // namespace mill::fem
