#include "twin/live/engine/detailed_twin.h"
#include "core/base/require.h"
#include "core/records/stand_place.h"
#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace mill::live {
namespace {
constexpr Eigen::Index most_unknowns = 64;

// Shapes change within the span of the lowest modes when a spring does, as in a calibration.  theory.md (44.15)
StandModel in_modes(const StandModel &whole, const Eigen::MatrixXd &V)
{
  StandModel stand;
  stand.name    = whole.name;
  stand.M       = Eigen::MatrixXd::Identity(V.cols(), V.cols());
  stand.K_parts = V.transpose() * whole.K_parts * V;
  for (Connection connection : whole.connections) {
    connection.rows = connection.rows * V;
    stand.connections.push_back(std::move(connection));
  }
  stand.b     = V.transpose() * whole.b;
  stand.parts = {"stand"};
  stand.unknowns.assign(std::size_t(V.cols()), {"mode", std::numeric_limits<double>::quiet_NaN(), "kg^0.5 m"});
  stand.part_of.assign(std::size_t(V.cols()), 0);
  for (const StandPoint &point : whole.points)
    stand.points.push_back({point.name, V.transpose() * point.row});
  stand.load_cell       = V.transpose() * whole.load_cell;
  stand.load_cell_share = whole.load_cell_share;
  return stand;
}

const Connection *connection_of(const StandModel &stand, const std::string &name)
{
  const auto &all = stand.connections;
  const auto connection =
      std::find_if(all.begin(), all.end(), [&](const Connection &c) { return c.name == name; });
  return connection == all.end() ? nullptr : &*connection;
}
// The rolls bend by themselves: what is left of K2 and K6 are the bearings of the backup rolls in their chocks, in
// series with parts of the frame that have no mass ("oil column + cylinder body + upper chock and K_Zy").
std::string connection_name(const StandModel &stand, const std::size_t spring)
{
  std::optional<SeatSpring> seat;
  if (spring == 1 || spring == 5)
    seat = spring == 1 ? SeatSpring::upper : SeatSpring::lower;
  for (const Connection &c : stand.connections)
    if (seat ? has_spring(c.name, *seat) : c.name == fmt::format("K{}", spring + 1))
      return c.name;
  return "";
}
}  // namespace

DetailedTwin detailed_twin(StandModel whole, const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                           const double limit, const double gap_damper)
{
  require(frequency.size() == shape.cols(), "every shape needs a frequency");
  DetailedTwin twin;
  twin.whole      = std::move(whole);
  twin.stand      = in_modes(twin.whole, shape.leftCols(std::min(most_unknowns, shape.cols())));
  twin.highest    = 2 * limit;
  twin.watched    = limit;
  twin.gap_damper = gap_damper;
  for (std::size_t j = 0; j < twin.connection.size(); ++j) {
    twin.connection[j] = connection_name(twin.whole, j);
    twin.stiffness[j]  = stiffness_of_connection(twin.whole, twin.connection[j]);
  }
  return twin;
}

double stiffness_of_connection(const StandModel &stand, const std::string &name)
{
  const Connection *connection = name.empty() ? nullptr : connection_of(stand, name);
  return connection ? connection->stiffness.sum() : 0;
}

void take_springs(const DetailedTwin &detailed, LumpedModel &chain)
{
  for (std::size_t j = 0; j < chain.K.size(); ++j) {
    chain.K[j].value             = detailed.stiffness[j];
    const Connection *connection = connection_of(detailed.whole, detailed.connection[j]);
    if (connection && !std::isnan(connection->error_estimate))
      chain.K[j].error_estimate = connection->error_estimate;
  }
}

StandModel with_springs(StandModel stand, const DetailedTwin &detailed, const LumpedModel &chain)
{
  for (std::size_t j = 0; j < chain.K.size(); ++j)
    for (Connection &connection : stand.connections)
      if (detailed.stiffness[j] > 0 && connection.name == detailed.connection[j]) {
        connection.stiffness *= chain.K[j].value / detailed.stiffness[j];
        connection.error_estimate = chain.K[j].error_estimate;
      }
  return stand;
}
}  // namespace mill::live
