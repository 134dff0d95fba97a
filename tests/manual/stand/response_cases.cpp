#include "tests/manual/stand/response_cases.h"
#include "core/base/require.h"
#include "dynamics/response/accelerance.h"
#include "fem/roll/roll_component.h"
#include "reduce/stand/component_stand.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_modes.h"
#include "tests/manual/solvers/whole_stand.h"
#include "tests/manual/stand/component_models.h"
#include "tests/manual/stand/mass_models.h"
#include <cmath>
#include <complex>
#include <fmt/format.h>

// Frequency response of the six masses and of component modes.  theory.md 32
namespace mill::verify {
namespace {
using Complex            = std::complex<double>;
constexpr double damping = 0.01, limit = 1000;

/// Largest distance of two responses over the largest of the second, both over the same frequencies.
double distance(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

// ---- frf-six-mass ---------------------------------------------------------------------------------------------

std::vector<Check> six_masses()
{
  const reduce::LumpedStand demo = demo_chain(demo_stand());
  std::vector<Check> checks;
  for (const double gap_damper : {0., 2e5})
    for (const FrameForm frame : every<FrameForm>()) {
      const StandModel chain = reduce::chain_stand(demo.model, frame);
      const auto modes       = reduce::stand_modes(chain);
      std::vector<Eigen::VectorXd> rows;
      for (const StandPoint &point : chain.points)
        rows.push_back(point.row);
      std::vector<Eigen::VectorXd> forces = rows;
      forces.push_back(chain.b);
      const auto modal =
          dynamics::modal_response(chain, modes.frequency, modes.shape, rows, forces, damping, gap_damper);
      const auto direct       = dynamics::damped_stand(chain, damping, gap_damper);
      const Eigen::VectorXd f = dynamics::frequencies_around(modes.frequency, damping, 5, 2000);
      double worst            = 0;
      for (std::size_t q = 0; q < forces.size(); ++q)
        for (std::size_t p = 0; p < rows.size(); ++p) {
          Eigen::VectorXcd sum(f.size()), solved(f.size());
          for (Eigen::Index i = 0; i < f.size(); ++i) {
            sum[i]    = dynamics::accelerance(modal, f[i])(Eigen::Index(p), Eigen::Index(q));
            solved[i] = dynamics::direct_accelerance(direct, rows[p], forces[q], f[i]);
          }
          if (sum.cwiseAbs().maxCoeff() >
              1e-12)  // in an open frame without bite the halves do not feel each other
            worst = std::max(worst, distance(solved, sum));
        }
      checks.push_back(at_most(fmt::format("{} frame, gap damper {:g} N s/m, 42 pairs, {} frequencies: largest "
                                           "distance over the peak",
                                           word_of(frame), gap_damper, f.size()),
                               "-", worst, 1e-10));
    }
  return checks;
}

// ---- frf-components -------------------------------------------------------------------------------------------

bool is_roll(const std::string &part)
{
  return part.size() > 4 && part.compare(part.size() - 4, 4, "roll") == 0;
}

/// A stand of components with its rolls meshed again: the interface of every roll and the lumps stay.
class Unreduced {
public:
  Unreduced(const StandModel &reduced, const RollPart &work, const RollPart &backup,
            const reduce::StandComponents &components)
      : stand(reduced)
  {
    std::vector<Eigen::Index> lumps;
    for (std::size_t p = 0; p < stand.parts.size(); ++p) {
      const Eigen::Index first =
          std::find(stand.part_of.begin(), stand.part_of.end(), int(p)) - stand.part_of.begin();
      if (!is_roll(stand.parts[p])) {
        lumps.push_back(first);
        continue;
      }
      const bool is_work   = stand.parts[p].find("work") != std::string::npos;
      const RollPart &roll = is_work ? work : backup;
      whole.bodies.push_back({roll.part.get(), &roll.interface});
      first_of.push_back(first);
      for (Eigen::Index i = 0; i < roll.interface.weights.cols(); ++i)
        kept.push_back(first + i);
    }
    whole.n_lumps = int(lumps.size());
    kept.insert(kept.end(), lumps.begin(), lumps.end());
    // What sits on a roll beyond its own mass.
    Eigen::MatrixXd added = stand.M;
    for (std::size_t b = 0; b < first_of.size(); ++b) {
      const Component &local =
          whole.bodies[b].part == work.part.get() ? components.work_roll : components.backup_roll;
      added.block(first_of[b], first_of[b], local.M.rows(), local.M.rows()) -= local.M;
    }
    whole.mass = added(kept, kept);
    for (const Connection &c : stand.connections)
      whole.connections.push_back({c.name, on_interfaces(c.rows), c.stiffness});
  }

  /// Rows of the reduced stand that know no mode of a roll.
  Eigen::MatrixXd on_interfaces(const Eigen::MatrixXd &rows) const
  {
    Eigen::MatrixXd left = rows;
    left(Eigen::all, kept).setZero();
    require(left.isZero(0), "the row of an interface has a part in the modes of a roll");
    return rows(Eigen::all, kept);
  }

  /// Mean displacement of the barrel of roll b, in the unknowns of the reduced stand.
  Eigen::VectorXd barrel(const std::size_t b) const
  {
    return Eigen::VectorXd::Unit(stand.M.rows(), first_of[b]);
  }

  const StandModel &stand;
  fem::WholeStand whole;

private:
  std::vector<Eigen::Index> first_of, kept;
};

std::vector<Check> components()
{
  const RollPart work   = roll_part("work roll", demo_work_roll),
                 backup = roll_part("backup roll", demo_backup_roll);
  fem::RollComponentOptions options;
  options.frequency_limit = limit;
  const auto reduced_roll = [&](const std::string &name, const RollPart &roll) {
    return fem::roll_component(name, *roll.body, roll.geometry, demo_roll_steel, options).component;
  };
  const reduce::StandComponents parts{reduced_roll("work roll", work), reduced_roll("backup roll", backup),
                                      std::nullopt};
  const FourHigh drawing = demo_stand();
  auto springs           = reduce::stand_springs(drawing, demo_chain(drawing));
  springs.Kzc_upper = springs.Kzc_lower = 2.01e10;
  const StandModel reduced              = reduce::component_stand(drawing, springs, parts);
  const Unreduced full(reduced, work, backup, parts);

  std::vector<std::pair<std::string, Eigen::VectorXd>> seen{
      {"upper backup roll, mean of the barrel", full.barrel(0)},
      {"upper work roll, mean of the barrel", full.barrel(1)},
      {"lower work roll, mean of the barrel", full.barrel(2)}};
  std::vector<std::pair<std::string, Eigen::VectorXd>> pushed{{"bite", reduced.b}};
  for (const StandPoint &point : reduced.points)
    if (point.name == "upper backup chock" || point.name == "lower work-roll chock") {
      seen.emplace_back(point.name, point.row);
      pushed.emplace_back(point.name, point.row);
    }
  const auto rows_of = [](const auto &places) {
    std::vector<Eigen::VectorXd> rows;
    for (const auto &[name, row] : places)
      rows.push_back(row);
    return rows;
  };
  const auto all_modes  = reduce::stand_modes(reduced);
  const auto of_reduced = dynamics::modal_response(reduced, all_modes.frequency, all_modes.shape, rows_of(seen),
                                                   rows_of(pushed), damping, 0);

  // (32.12)
  constexpr int n_modes = 28;
  const auto modes      = fem::whole_modes(full.whole, n_modes);
  const auto rows_on    = [&](const auto &places) {
    Eigen::MatrixXd rows(Eigen::Index(places.size()), fem::n_coordinates(full.whole));
    for (std::size_t p = 0; p < places.size(); ++p)
      rows.row(Eigen::Index(p)) = full.on_interfaces(places[p].second.transpose());
    return rows;
  };
  const Eigen::MatrixXd P = rows_on(seen), B = rows_on(pushed);
  const dynamics::ModalResponse of_whole{modes.frequency, P * modes.y, B * modes.y, {}, damping, 0};
  const auto remainder_beyond = [&](const Eigen::Index n) -> Eigen::MatrixXd {
    const Eigen::VectorXd stiffness = (2 * M_PI * modes.frequency.head(n)).cwiseAbs2();
    return P * fem::whole_static(full.whole, B.transpose()) - of_whole.seen.leftCols(n) *
                                                                  stiffness.cwiseInverse().asDiagonal() *
                                                                  of_whole.pushed.leftCols(n).transpose();
  };
  const Eigen::MatrixXd rest = remainder_beyond(n_modes), rest_of_fewer = remainder_beyond(n_modes - 6);
  const auto fewer = dynamics::first_modes(
      {of_whole.frequency, of_whole.seen, of_whole.pushed, Eigen::VectorXd::Zero(n_modes), damping, 0},
      n_modes - 6);

  const Eigen::VectorXd f = dynamics::frequencies_around(modes.frequency, damping, 15, limit);
  std::vector<Check> checks;
  double truncated = 0;
  for (std::size_t q = 0; q < pushed.size(); ++q)
    for (std::size_t p = 0; p < seen.size(); ++p) {
      const Eigen::Index i = Eigen::Index(p), j = Eigen::Index(q);
      Eigen::VectorXcd by_components(f.size()), by_all(f.size()), by_fewer(f.size());
      for (Eigen::Index k = 0; k < f.size(); ++k) {
        const double minus_squared = -std::pow(2 * M_PI * f[k], 2);
        by_components[k]           = dynamics::accelerance(of_reduced, f[k])(i, j);
        by_all[k]                  = dynamics::accelerance(of_whole, f[k])(i, j) + minus_squared * rest(i, j);
        by_fewer[k] = dynamics::accelerance(fewer, f[k])(i, j) + minus_squared * rest_of_fewer(i, j);
      }
      if (by_all.cwiseAbs().maxCoeff() < 1e-9)  // in an open frame the halves do not feel each other
        continue;
      checks.push_back(
          at_most(fmt::format("force: {}; {}: largest distance over the peak", pushed[q].first, seen[p].first),
                  "-", distance(by_components, by_all), 0.01));
      truncated = std::max(truncated, distance(by_fewer, by_all));
    }
  checks.push_back(at_most(fmt::format("reference with {} and {} modes, up to {:.0f} Hz", n_modes, n_modes - 6,
                                       modes.frequency[n_modes - 1]),
                           "-", truncated, 1e-3));
  return checks;
}
}  // namespace

std::vector<Case> response_cases()
{
  return {
      {"frf-six-mass", "verification",
       "PL-4: accelerance of the six masses of the demo stand, every mass for a force on every mass and in the "
       "bite, "
       "1 % damping in every mode, with and without a damper in the gap: solution of the damped system, its "
       "damping made by a matrix square root, against the sum over the modes.",
       "Sum of modes in closed form, "
       "theory (32.3); no mode enters the solution.",
       "1e-10 of the peak, as asked: both ways are exact but for rounding.", six_masses},
      {"frf-components", "verification",
       "PL-5: accelerance of the demo stand of component modes kept for 1 kHz, 15 to 1000 Hz, for forces in the "
       "bite "
       "and at two chocks, against the same stand with all four rolls on their meshes.",
       "Full finite elements on the same meshes joined by the same springs: their modes by Lanczos and the static "
       "remainder of all others, theory (32.12).",
       "1 % of the peak, as asked. The reference is to be ten times as sure, judged by "
       "leaving out six of its modes.",
       components}};
}
}  // namespace mill::verify
