// Dampers of oil films in a unit: its motion against the integrator of the program, and the film that locks.
#include "dynamics/fmu/runtime/motion.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modal_model.h"
#include "dynamics/response/modes.h"
#include "dynamics/response/response.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <gtest/gtest.h>

using namespace mill;

namespace {
constexpr double film = 5e10;  // N/m, both films of a backup roll, of K2 = K6 = 2.5e10 or less

LumpedModel with_films(const double damper)
{
  LumpedModel model    = published_stand();
  model.film           = {ChainFilm{film, damper}, ChainFilm{film, damper}};
  model.film_frequency = 50;
  return model;
}

fmu::ModelData unit_of(const dynamics::MillModel &chain, const double damping)
{
  fmu::ModelData data;
  data.kind             = fmu::StandKind::chain;
  data.modal_damping    = damping;
  data.load_cell_spring = 6;
  data.points           = chain.labels;
  data.mass.assign(chain.M.begin(), chain.M.end());
  data.bite_row.assign(chain.b.begin(), chain.b.end());
  for (const dynamics::Spring &spring : chain.springs)
    data.springs.push_back({spring.name, spring.from, spring.to, spring.stiffness, false, spring.damper});
  return data;
}

// The same chain in its modes, as a detailed stand is exported.
fmu::ModelData modal_unit_of(const dynamics::MillModel &chain, const double damping)
{
  const auto modes        = dynamics::modes(chain);
  Eigen::MatrixXd dampers = Eigen::MatrixXd::Zero(6, 6);
  for (const dynamics::Spring &spring : chain.springs) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(6);
    if (spring.from != dynamics::ground)
      row += modes.shape.row(spring.from).transpose();
    if (spring.to != dynamics::ground)
      row -= modes.shape.row(spring.to).transpose();
    dampers += spring.damper * row * row.transpose();
  }
  const Eigen::MatrixXd rows = dynamics::damper_rows(dampers);
  EXPECT_LE(rows.rows(), 2) << "one for each roll";
  const Eigen::VectorXd bite = modes.shape.transpose() * chain.b;
  fmu::ModelData data;
  data.kind          = fmu::StandKind::modal;
  data.modal_damping = damping;
  data.points        = chain.labels;
  data.frequency.assign(modes.frequency.begin(), modes.frequency.end());
  data.bite_mode.assign(bite.begin(), bite.end());
  data.load_cell_mode.assign(6, 0);
  for (Eigen::Index j = 0; j < 6; ++j)
    for (Eigen::Index k = 0; k < 6; ++k)
      data.shape.push_back(modes.shape(j, k));
  for (Eigen::Index r = 0; r < rows.rows(); ++r)
    for (Eigen::Index k = 0; k < 6; ++k)
      data.damper_rows.push_back(rows(r, k));
  return data;
}

// (samples, 6) m/s2
Eigen::MatrixXd moved(const fmu::ModelData &data, const ForceRecord &record)
{
  const auto system = fmu::modal_system(data, fmu::start_of(data));
  fmu::Motion motion(system);
  const double step = record.time[1] - record.time[0], mean = record.force.mean();
  fmu::ModalState state = motion.equilibrium(record.force[0] - mean);
  Eigen::MatrixXd all(record.force.size(), 6);
  std::vector<double> q;
  for (Eigen::Index k = 0; k < record.force.size(); ++k) {
    if (k > 0) {
      motion.begin(state);
      motion.advance(state, step, {record.force[k - 1] - mean, (record.force[k] - record.force[k - 1]) / step});
      motion.end(state);
    }
    motion.acceleration(state, record.force[k] - mean, q);
    for (std::size_t i = 0; i < 6; ++i) {
      all(k, Eigen::Index(i)) = 0;
      for (std::size_t m = 0; m < 6; ++m)
        all(k, Eigen::Index(i)) += system.point(i, m) * q[m];
    }
  }
  return all;
}

double largest_difference(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

ForceRecord short_record()
{
  ForceRecord record = twelve_tones();
  record.time        = record.time.head(3000).eval();
  record.force       = record.force.head(3000).eval();
  return record;
}
}  // namespace

TEST(FilmDampers, AUnitMovesAsTheStandThatHasThem)
{
  const auto stated        = settings(ForceMeaning::measured, 0.01);
  const ForceRecord record = short_record();
  const double rate        = 1 / (record.time[1] - record.time[0]);
  const auto chain         = dynamics::mill_model(with_films(1e8), stated);
  const auto expected      = dynamics::mill_response(chain, record, rate).acceleration;
  EXPECT_LT(largest_difference(moved(unit_of(chain, 0.01), record), expected), 1e-9);
  EXPECT_LT(largest_difference(moved(modal_unit_of(chain, 0.01), record), expected), 1e-9);
  fmu::ModelData without = unit_of(chain, 0.01);
  for (fmu::SpringData &spring : without.springs)
    spring.damper = 0;
  EXPECT_GT(largest_difference(moved(without, record), expected), 0.01) << "the dampers move nothing";
}

TEST(FilmDampers, AFilmThatLocksIsTheRigidBearing)
{
  const auto stated        = settings(ForceMeaning::measured, 0.01);
  const ForceRecord record = short_record();
  LumpedModel rigid        = published_stand();
  for (const std::size_t j : {1, 5})
    rigid.K[j].value = 1 / (1 / rigid.K[j].value - 1 / film);
  const auto locked = moved(unit_of(dynamics::mill_model(with_films(1e14), stated), 0.01), record),
             other  = moved(unit_of(dynamics::mill_model(rigid, stated), 0.01), record);
  EXPECT_LT(largest_difference(locked, other), 5e-3);
}

// Two of its poles are real and rounding gives them imaginary parts: they are not a pair.
TEST(FilmDampers, AStrongDamperOfTheGapHasRealPoles)
{
  LumpedModel model        = published_stand();
  model.C.value            = 1e9;
  model.K[3].value         = 3e8;
  const auto chain         = dynamics::mill_model(model, settings(ForceMeaning::disturbance, 0));
  const ForceRecord record = short_record();
  const double rate        = 1 / (record.time[1] - record.time[0]);
  fmu::ModelData data      = unit_of(chain, 0);
  data.gap_damper          = 1e9;
  EXPECT_LT(largest_difference(moved(data, record), dynamics::mill_response(chain, record, rate).acceleration),
            1e-9);
}
