#include "dynamics/response/mill_model.h"
#include "core/base/errors.h"
#include "core/base/require.h"
#include "dynamics/response/modes.h"
#include "reduce/chain/film_in_series.h"
#include "reduce/stand/gap_modes.h"
#include <Eigen/Cholesky>
#include <cmath>

namespace mill::dynamics {
namespace {
Eigen::MatrixXd assemble(const int n, const std::vector<Spring> &springs)
{
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (const Spring &spring : springs) {
    for (const int end : {spring.from, spring.to})
      if (end != ground)
        K(end, end) += spring.stiffness;
    if (spring.from != ground && spring.to != ground) {
      K(spring.from, spring.to) -= spring.stiffness;
      K(spring.to, spring.from) -= spring.stiffness;
    }
  }
  return K;
}

Eigen::MatrixXd spring_dampers(const int n, std::vector<Spring> springs)
{
  for (Spring &spring : springs)
    spring.stiffness = spring.damper;
  return assemble(n, springs);
}

// A spring of the chain with the oil film that is a part of it, at the frequency of the chain.
Spring with_film(Spring spring, const ChainFilm &film, const double frequency)
{
  if (!(film.damper > 0) || !(film.stiffness > spring.stiffness))
    return spring;
  const double rest = 1 / (1 / spring.stiffness - 1 / film.stiffness);
  const auto place =
      reduce::equivalent_in_series(rest, {film.stiffness, film.damper}, std::isnan(frequency) ? 0 : frequency);
  spring.stiffness = place.stiffness;
  spring.damper    = place.damper;
  return spring;
}

// C = M V diag(2 zeta w) V^T M with mass-normalised V  (6.4)
Eigen::MatrixXd modal_damping(const MillModel &model, const double zeta)
{
  const Modes undamped      = modes(model);
  const Eigen::MatrixXd MV  = model.M.asDiagonal() * undamped.shape;
  const Eigen::VectorXd rad = 2 * M_PI * undamped.frequency;
  return MV * (2 * zeta * rad).asDiagonal() * MV.transpose();
}

// The spring below the stack: K7 in the open frame; in the closed frame K7 only holds the mill to its foundation
// and the posts K1 carry the rolling force.  (6.8)
Eigen::VectorXd load_cell_row(const bool closed, const double K1, const double K7)
{
  Eigen::VectorXd row = Eigen::VectorXd::Zero(6);
  if (closed) {
    row[upper_frame] = K1;
    row[lower_frame] = -K1;
  } else
    row[lower_frame] = -K7;
  return row;
}
}  // namespace

MillModel mill_model(const LumpedModel &lumped, const DynamicsSettings &settings)
{
  const bool measured     = settings.force_meaning == ForceMeaning::measured;
  const bool closed       = settings.frame == FrameForm::closed;
  const auto K            = [&](const int i) { return lumped.K[std::size_t(i - 1)].value; };
  const double K4         = measured ? 0 : K(4);
  const double gap_damper = measured || std::isnan(lumped.C.value) ? 0 : lumped.C.value;

  MillModel model;
  model.labels  = {"upper frame",     "upper backup roll", "upper work roll",
                   "lower work roll", "lower backup roll", "lower frame"};
  model.springs = {{"K1", closed ? int(lower_frame) : ground, upper_frame, K(1)},
                   with_film({"K2", upper_frame, upper_backup_roll, K(2)}, lumped.film[0], lumped.film_frequency),
                   {"K3", upper_backup_roll, upper_work_roll, K(3)},
                   {"K4", upper_work_roll, lower_work_roll, K4},
                   {"K5", lower_work_roll, lower_backup_roll, K(5)},
                   with_film({"K6", lower_backup_roll, lower_frame, K(6)}, lumped.film[1], lumped.film_frequency),
                   {"K7", lower_frame, ground, K(7)}};
  model.M.resize(6);
  for (int i = 0; i < 6; ++i)
    model.M[i] = std::isnan(lumped.moving_mass[std::size_t(i)]) ? lumped.M[std::size_t(i)].value
                                                                : lumped.moving_mass[std::size_t(i)];
  require((model.M.array() > 0).all(), "a mass of the chain is not above zero");
  model.K = assemble(6, model.springs);  // (6.2)
  require(model.K.allFinite(), "a spring of the chain is not a finite number");
  model.b                  = Eigen::VectorXd::Zero(6);
  model.b[upper_work_roll] = 1;
  model.b[lower_work_roll] = -1;
  model.C                  = gap_damper * model.b * model.b.transpose();  // (6.3)
  if (settings.modal_damping > 0)
    model.C += modal_damping(model, settings.modal_damping);  // (6.4)
  model.C += spring_dampers(6, model.springs);
  model.load_cell = load_cell_row(closed, K(1), K(7));
  // A disturbance moves the rolls about a state whose mean force the stand carries whole; only the published
  // reading lets K4 take its share of the mean.
  model.load_cell_share =
      settings.force_meaning == ForceMeaning::published ? model.load_cell.dot(static_displacement(model)) : 1;
  return model;
}

namespace {
// Adds one roll on its bearings; for a work roll in series with its chock seat.  (6.9), (6.10)
struct HorizontalRoll {
  RollPlace place;
  std::string bearing, seat;
  double mass, bearing_stiffness, seat_stiffness, chock_mass;
};

void add_roll(const HorizontalRoll &roll, std::vector<double> &masses, MillModel &model)
{
  const int here          = int(masses.size());
  const std::string label = word_of(roll.place);
  masses.push_back(roll.mass);
  model.labels.push_back(label);
  model.rolls.push_back(roll.place);
  if (std::isnan(roll.seat_stiffness)) {
    model.springs.push_back({roll.bearing, here, ground, roll.bearing_stiffness});
  } else if (roll.chock_mass > 0) {
    masses.push_back(roll.chock_mass);
    model.labels.push_back("chocks of the " + label);
    model.rolls.push_back(roll.place);
    model.springs.push_back({roll.bearing, here, here + 1, roll.bearing_stiffness});
    model.springs.push_back({roll.seat, here + 1, ground, roll.seat_stiffness});
  } else {
    const double both   = roll.bearing_stiffness + roll.seat_stiffness;
    const double series = both > 0 ? roll.bearing_stiffness * roll.seat_stiffness / both : 0;
    model.springs.push_back({roll.bearing + " + " + roll.seat, here, ground, series});
  }
}
}  // namespace

MillModel horizontal_model(const LumpedModel &lumped, const ChockSeats &seats)
{
  const auto Kzc = [&](const int i) {
    const double across = lumped.Kzc_across[std::size_t(i - 1)].value;
    return seats.bearings_per_roll * (std::isnan(across) ? lumped.Kzc[std::size_t(i - 1)].value : across);
  };
  const auto M                            = [&](const int i) { return lumped.M[std::size_t(i - 1)].value; };
  const std::vector<HorizontalRoll> rolls = {
      {RollPlace::upper_backup, "Kzc1", "", M(2), Kzc(1), not_given, 0},
      {RollPlace::upper_work, "Kzc2", "Kx1", M(3), Kzc(2), seats.stiffness[0], seats.chock_mass[0]},
      {RollPlace::lower_work, "Kzc3", "Kx2", M(4), Kzc(3), seats.stiffness[1], seats.chock_mass[1]},
      {RollPlace::lower_backup, "Kzc4", "", M(5), Kzc(4), not_given, 0}};
  MillModel model;
  std::vector<double> masses;
  for (const HorizontalRoll &roll : rolls)
    if (!std::isnan(roll.bearing_stiffness))
      add_roll(roll, masses, model);
  const int n     = int(masses.size());
  model.M         = Eigen::Map<const Eigen::VectorXd>(masses.data(), n);
  model.K         = assemble(n, model.springs);
  model.C         = Eigen::MatrixXd::Zero(n, n);
  model.b         = Eigen::VectorXd::Zero(n);
  model.load_cell = Eigen::VectorXd::Zero(n);
  return model;
}

namespace {
// The gap mode of the first kind, or, where there is none, the mode of the largest share.  (22.23)
Eigen::Index gap_mode_of(const MillModel &chain, const Modes &all)
{
  const Eigen::VectorXd share = reduce::gap_shares(all.frequency, all.shape, chain.b);
  Eigen::Index best           = -1;
  for (Eigen::Index k = 0; k < share.size(); ++k) {
    const auto y       = all.shape.col(k);
    const auto kinetic = [&](const int from) {
      return y.segment(from, 3).cwiseAbs2().dot(chain.M.segment(from, 3));
    };
    const bool upper = kinetic(upper_frame) > kinetic(lower_work_roll);
    const bool with_backup =
        upper ? y[upper_backup_roll] * y[upper_work_roll] > 0 : y[lower_work_roll] * y[lower_backup_roll] > 0;
    if (with_backup && (best < 0 || share[k] > share[best]))
      best = k;
  }
  if (best < 0)
    share.maxCoeff(&best);
  return best;
}
}  // namespace

void take_films(LumpedModel &model, DynamicsSettings settings, const MassesOnBearings &masses)
{
  if (!(model.film[0].damper > 0 || model.film[1].damper > 0))
    return;
  settings.force_meaning = ForceMeaning::disturbance;
  settings.modal_damping = 0;
  LumpedModel rolling    = model;
  if (std::isnan(rolling.K[3].value))
    rolling.K[3].value = 0;
  rolling.film_frequency = 0;
  for (int i = 0; i < 100; ++i) {
    const auto stiffness = [&](const ChainFilm &film) {
      return std::hypot(film.stiffness, 2 * M_PI * rolling.film_frequency * film.damper);
    };
    rolling.moving_mass    = masses(stiffness(rolling.film[0]), stiffness(rolling.film[1]));
    const MillModel chain  = mill_model(rolling, settings);
    const Modes all        = modes(chain);
    const double f         = all.frequency[gap_mode_of(chain, all)];
    const bool settled     = std::abs(f - rolling.film_frequency) < 1e-9 * f;
    rolling.film_frequency = f;
    if (settled)
      break;
  }
  model.film_frequency = rolling.film_frequency;
  model.moving_mass    = rolling.moving_mass;
}

Eigen::VectorXd static_displacement(const MillModel &model)
{
  const Eigen::LLT<Eigen::MatrixXd> factor(model.K);
  // A mechanism leaves a pivot that is only rounding: n eps of the largest entry, taken a thousand times.
  const double smallest =
      factor.info() == Eigen::Success ? factor.matrixLLT().diagonal().array().square().minCoeff() : 0;
  if (!(smallest > 1e-12 * model.K.diagonal().maxCoeff()))
    throw SolverError({"static equilibrium of the lumped model: the stiffness matrix is singular",
                       "smallest pivot " + std::to_string(smallest) + " N/m",
                       "a part of the chain is not held to the ground: one of its stiffnesses is zero",
                       "give K1, K2, K3, K5, K6 and K7 values above zero", ""});
  return factor.solve(model.b);
}

double mill_modulus(const LumpedModel &lumped)
{
  double flexibility = 0;
  for (const std::size_t i : {1, 2, 3, 5, 6, 7})
    flexibility += 1 / lumped.K[i - 1].value;  // (6.6)
  return 1 / flexibility;
}
}  // namespace mill::dynamics
