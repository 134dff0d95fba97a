#include "app/stages/stand/models_file.h"
#include "reduce/stand/mass_breakdown.h"
#include <algorithm>

namespace mill {
namespace {
ModelMode mode_of(const reduce::StandWithModes &s, const Eigen::Index i, const Eigen::VectorXd &in_chain,
                  const reduce::ModeName &name)
{
  const Eigen::VectorXd shape = s.modes.shape.col(i);
  ModelMode mode;
  mode.frequency      = s.modes.frequency[i];
  mode.name           = name.name;
  mode.own_name       = name.own_name;
  mode.decided        = name.decided;
  mode.gap_share      = name.gap_share;
  mode.listed         = name.listed;
  mode.error_estimate = s.modes.error_estimate.size() > i ? s.modes.error_estimate[i] : not_given;
  mode.in_chain       = in_chain.size() > i ? in_chain[i] : not_given;
  mode.kinetic        = s.modes.kinetic.col(i);
  mode.strain         = s.modes.strain.col(i);
  mode.points.resize(Eigen::Index(s.model.points.size()));
  for (std::size_t p = 0; p < s.model.points.size(); ++p)
    mode.points[Eigen::Index(p)] = s.model.points[p].row.dot(shape);
  double largest = mode.points.cwiseAbs().maxCoeff();
  for (const StandLine &line : s.model.lines) {
    mode.lines.push_back(line.rows * shape);
    largest = std::max(largest, mode.lines.back().cwiseAbs().maxCoeff());
  }
  mode.points /= largest;
  for (Eigen::VectorXd &line : mode.lines)
    line /= largest;
  return mode;
}

Eigen::Index shown_modes(const reduce::StandWithModes &s, const double limit)
{
  const auto below =
      std::upper_bound(s.modes.frequency.begin(), s.modes.frequency.end(), limit) - s.modes.frequency.begin();
  return std::min<Eigen::Index>(below + 1, s.modes.frequency.size());
}
}  // namespace

ComparedModel compared_model(const reduce::StandWithModes &s, const std::string &title, const std::string &source,
                             const double limit, const Eigen::VectorXd &in_chain)
{
  ComparedModel model;
  model.name     = s.model.name;
  model.title    = title;
  model.unknowns = int(s.model.M.rows());
  model.source   = source;
  model.parts    = s.model.parts;
  for (const StandPoint &point : s.model.points)
    model.points.push_back(point.name);
  for (const Connection &spring : s.model.connections)
    model.springs.push_back(spring.name);
  for (const StandLine &line : s.model.lines)
    model.lines.push_back({line.name, line.z});
  for (Eigen::Index i = 0; i < shown_modes(s, limit); ++i)
    model.modes.push_back(mode_of(s, i, in_chain, s.names.at(std::size_t(i))));
  return model;
}

std::vector<ModePartners> mode_partners(const StandModels &m)
{
  std::vector<ModePartners> pairs;
  for (const auto *other : {&m.beam, &m.craig_bampton}) {
    const auto modes = reduce::pair_modes(reduce::mac_with_chain(*other, m.chain), other->modes.frequency,
                                          m.chain.modes.frequency);
    pairs.resize(modes.size());
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const auto &[mode, partner, mac, difference] = modes[i];
      pairs[i].mode                                = mode + 1;
      pairs[i].six_mass                            = m.chain.modes.frequency[mode];
      if (partner >= 0)
        pairs[i].partner[other->model.name] = {partner + 1, other->modes.frequency[partner], mac};
    }
  }
  return pairs;
}

MacTable mac_table(const StandModels &m, const double limit)
{
  const Eigen::MatrixXd mac  = reduce::mac_between(m.craig_bampton, m.beam);
  const Eigen::Index rows    = std::min(shown_modes(m.craig_bampton, limit), mac.rows());
  const Eigen::Index columns = std::min(shown_modes(m.beam, limit), mac.cols());
  return {"craig-bampton", "beam", m.craig_bampton.modes.frequency.head(rows),
          m.beam.modes.frequency.head(columns), mac.topLeftCorner(rows, columns)};
}

std::vector<MassRoutes> mass_routes(const FourHigh &stand, const reduce::LumpedStand &chain,
                                    const reduce::FeMasses &masses)
{
  std::vector<MassRoutes> routes;
  const auto closed = reduce::chain_breakdown(stand, chain);
  for (std::size_t i = 0; i < 6; ++i) {
    MassRoutes row;
    row.mass             = "M" + std::to_string(i + 1);
    const auto published = stand.published.find(row.mass);
    for (const MassBreakdown &mass : closed)
      if (mass.mass == row.mass)
        row.chain = mass.value;
    if (i > 0 && i < 5) {
      row.fe_integral = masses.integral[i - 1];
      row.fe_solid    = masses.solid[i - 1];
    }
    if (published != stand.published.end())
      row.published = published->second.parameter.value;
    routes.push_back(row);
  }
  return routes;
}
}  // namespace mill
