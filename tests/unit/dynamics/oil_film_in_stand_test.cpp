// Oil films of the backup rolls in chain and detailed stands: k + i w b in series with the rest, locked at high
// frequency.
#include "dynamics/chatter/stand_structure.h"
#include "dynamics/response/accelerance.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modal_model.h"
#include "dynamics/response/modes.h"
#include "reduce/chain/film_in_series.h"
#include "reduce/stand/beam_stand.h"
#include "reduce/stand/stand_modes.h"
#include "tests/manual/stand/demo_drawing.h"
#include "tests/support/near.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <fmt/format.h>

using namespace mill;

namespace {
const auto one_formula = within(1e-12, "the same number by another formula");
constexpr double film  = 6e9;  // N/m, both films of a backup roll

// The demo stand on backup bearings of this stiffness, N/m both of a roll.
reduce::LumpedStand chain_on(const FourHigh &stand, const double K_Zy)
{
  const auto spring = [](const double value) {
    Parameter p;
    p.value = value;
    p.unit  = "N/m";
    return p;
  };
  reduce::ChainInputs in;
  in.K3 = in.K5 = spring(4.02e10);
  in.K4         = spring(1.2e10);
  in.K_Zy_upper = in.K_Zy_lower = spring(K_Zy);
  in.Kzc                        = {spring(K_Zy / 2), spring(1.9e10), spring(1.9e10), spring(K_Zy / 2)};
  return reduce::lumped_stand(stand, in);
}

DynamicsSettings undamped(const ForceMeaning meaning)
{
  DynamicsSettings settings;
  settings.force_meaning = meaning;
  settings.modal_damping = 0;
  return settings;
}

// The same with a damper in each film, N s/m both of a roll.
reduce::LumpedStand chain_with_films(const FourHigh &stand, const double damper, const double stiffness = film)
{
  reduce::LumpedStand chain = chain_on(stand, stiffness);
  chain.model.film          = {ChainFilm{stiffness, damper}, ChainFilm{stiffness, damper}};
  dynamics::take_films(chain.model, undamped(ForceMeaning::disturbance), [&](const double upper, double) {
    std::array<double, 6> masses{};
    for (std::size_t i = 0; i < masses.size(); ++i)
      masses[i] = chain_on(stand, upper).model.M[i].value;
    return masses;
  });
  return chain;
}
}  // namespace

TEST(OilFilmInStand, SeriesIsTheStaticOneAtRestAndTheRestWhereTheFilmLocks)
{
  const reduce::SpringAndDamper f{6e9, 2e8};
  EXPECT_TRUE(near(reduce::film_in_series(3e9, f, 0).real(), 2e9, one_formula));
  EXPECT_TRUE(near(reduce::film_in_series(3e9, f, 1e12).real(), 3e9, one_formula));
  const std::complex<double> k(6e9, 2 * M_PI * 100 * 2e8);
  const std::complex<double> series = 1. / (1 / 3e9 + 1. / k);
  const auto at                     = reduce::equivalent_in_series(3e9, f, 100);
  EXPECT_TRUE(near(at.stiffness, series.real(), one_formula));
  EXPECT_TRUE(near(at.damper * 2 * M_PI * 100, series.imag(), one_formula));
  EXPECT_TRUE(near(reduce::equivalent_in_series(3e9, f, 1e-6).damper,
                   reduce::equivalent_in_series(3e9, f, 0).damper, within(1e-9, "limit of low frequency")));
}

TEST(OilFilmInStand, WithoutADamperTheChainIsThatOfTheSpring)
{
  const FourHigh stand = verify::demo_stand();
  const auto plain     = dynamics::mill_model(chain_on(stand, film).model, undamped(ForceMeaning::disturbance));
  const auto none = dynamics::mill_model(chain_with_films(stand, 0).model, undamped(ForceMeaning::disturbance));
  EXPECT_EQ((plain.K - none.K).cwiseAbs().maxCoeff(), 0);
  EXPECT_TRUE(none.C.isZero(0));
}

// given.Kzc1 = given.Kzc4 = 1e9 kN/mm: a rigid bearing.
TEST(OilFilmInStand, AFilmThatLocksGivesTheModesOfARigidBearing)
{
  const FourHigh stand = verify::demo_stand();
  for (const ForceMeaning meaning : {ForceMeaning::measured, ForceMeaning::disturbance}) {
    const auto rigid = chain_on(stand, 2e15), films = chain_with_films(stand, 1e15);
    const auto of = [&](const reduce::LumpedStand &chain) {
      return dynamics::modes(dynamics::mill_model(chain.model, undamped(meaning))).frequency;
    };
    EXPECT_TRUE(near(of(films), of(rigid), within(5e-3, "1e9 kN/mm is not without bound")));
    FourHigh drawn               = stand;
    drawn.dynamics.force_meaning = meaning;
    const auto beams             = [&](const reduce::LumpedStand &chain) {
      return reduce::stand_modes(reduce::beam_stand(drawn, reduce::stand_springs(drawn, chain), 8), 1000)
          .frequency;
    };
    EXPECT_TRUE(near(beams(films), beams(rigid), within(5e-3, "1e9 kN/mm is not without bound")));
  }
}

// Of beams, whose masses are those of the bodies: by Rayleigh's principle a stiffer spring lowers no frequency.
// The equivalent masses of the chain follow the shape, which a stiffer film changes.
TEST(OilFilmInStand, FrequenciesRiseFromTheSpringToTheLockedFilm)
{
  FourHigh stand               = verify::demo_stand();
  stand.dynamics.force_meaning = ForceMeaning::disturbance;
  double before                = 0;
  for (const double damper : {0., 1e6, 1e7, 1e8, 1e9, 1e12}) {
    const auto chain = chain_with_films(stand, damper);
    const double f =
        reduce::stand_modes(reduce::beam_stand(stand, reduce::stand_springs(stand, chain), 8), 1000).frequency[0];
    EXPECT_GE(f, before) << damper;
    before = f;
  }
}

// The quadratic eigenvalue problem with the film as a spring and a damper on a point of its own without mass:
// at the frequency of the gap mode the chain with equivalent springs is that one.
TEST(OilFilmInStand, AtItsFrequencyTheChainIsTheOneWithTheWholeFilm)
{
  const FourHigh stand = verify::demo_stand();
  const auto films     = chain_with_films(stand, 3e6);
  const auto settings  = undamped(ForceMeaning::disturbance);
  const auto chain     = dynamics::mill_model(films.model, settings);
  const double w       = 2 * M_PI * films.model.film_frequency;
  const double rest[2] = {1 / (1 / films.model.K[1].value - 1 / film),
                          1 / (1 / films.model.K[5].value - 1 / film)};
  LumpedModel bare     = films.model;
  bare.film            = {};
  bare.K[1].value = bare.K[5].value = 0;
  const auto open                   = dynamics::mill_model(bare, settings);
  // Points 6 and 7: between the rest of K2 and the upper film, between the lower film and the rest of K6.
  Eigen::MatrixXcd Z    = Eigen::MatrixXcd::Zero(8, 8);
  Z.topLeftCorner(6, 6) = (open.K - w * w * Eigen::MatrixXd(open.M.asDiagonal())).cast<std::complex<double>>();
  const auto join       = [&](const int a, const int b, const std::complex<double> k) {
    Z(a, a) += k;
    Z(b, b) += k;
    Z(a, b) -= k;
    Z(b, a) -= k;
  };
  const std::complex<double> dynamic(film, w * 3e6);
  join(dynamics::upper_frame, 6, rest[0]);
  join(6, dynamics::upper_backup_roll, dynamic);
  join(dynamics::lower_backup_roll, 7, dynamic);
  join(7, dynamics::lower_frame, rest[1]);
  Eigen::VectorXcd b           = Eigen::VectorXcd::Zero(8);
  b.head(6)                    = chain.b.cast<std::complex<double>>();
  const Eigen::VectorXcd whole = Z.partialPivLu().solve(b).head(6);
  Eigen::MatrixXcd reduced(6, 6);
  reduced.real()               = chain.K - w * w * Eigen::MatrixXd(chain.M.asDiagonal());
  reduced.imag()               = w * chain.C;
  const Eigen::VectorXcd equal = reduced.partialPivLu().solve(Eigen::VectorXcd(b.head(6)));
  EXPECT_LT((whole - equal).norm(), 1e-9 * whole.norm());
}

// A film turns at half the speed of its journal: k/b is a few rad/s, far below every mode, and the film of the gap
// mode gives the frequencies of all of them; its damper is right there and grows with the square of the frequency
// above.  Compared with the state matrix in which each film is a state of its own,
// b y' = r (x_frame - y) - k (y - x_roll) + b x_roll'.
TEST(OilFilmInStand, FilmsOfAMillAreLockedInEveryModeAndTheirDamperIsThatOfTheGapMode)
{
  constexpr double k = 2.06e11, b = 2.73e10;  // both bearings of 950 x 700 mm at 5 MN each and 66 rpm
  const FourHigh stand = verify::demo_stand();
  const auto films     = chain_with_films(stand, b, k);
  const auto settings  = undamped(ForceMeaning::disturbance);
  const auto chain     = dynamics::mill_model(films.model, settings);
  LumpedModel bare     = films.model;
  bare.film            = {};
  const double rest[2] = {1 / (1 / bare.K[1].value - 1 / k), 1 / (1 / bare.K[5].value - 1 / k)};
  bare.K[1].value = bare.K[5].value = 0;
  const auto open                   = dynamics::mill_model(bare, settings);
  const Eigen::VectorXd by_mass     = chain.M.cwiseInverse();
  const auto first_order            = [&](const Eigen::MatrixXd &K, const Eigen::MatrixXd &C, const int own) {
    Eigen::MatrixXd A   = Eigen::MatrixXd::Zero(12 + own, 12 + own);
    A.block(0, 6, 6, 6) = Eigen::MatrixXd::Identity(6, 6);
    A.block(6, 0, 6, 6) = by_mass.asDiagonal() * -K;
    A.block(6, 6, 6, 6) = by_mass.asDiagonal() * -C;
    return A;
  };
  Eigen::MatrixXd whole = first_order(open.K, Eigen::MatrixXd::Zero(6, 6), 2);
  const int frame[2]    = {dynamics::upper_frame, dynamics::lower_frame},
            roll[2]     = {dynamics::upper_backup_roll, dynamics::lower_backup_roll};
  for (const int i : {0, 1}) {
    const int y = 12 + i;
    for (const auto &[end, sign] : {std::pair(frame[i], -1.), {roll[i], 1.}}) {  // the same force on both ends
      whole(6 + end, frame[i]) += sign * by_mass[end] * rest[i];
      whole(6 + end, y) -= sign * by_mass[end] * rest[i];
    }
    whole(y, frame[i])    = rest[i] / b;
    whole(y, y)           = -(rest[i] + k) / b;
    whole(y, roll[i])     = k / b;
    whole(y, 6 + roll[i]) = 1;
  }
  const auto vibrations = [](const Eigen::MatrixXd &A) {
    std::vector<std::complex<double>> roots;
    const Eigen::VectorXcd all = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
    for (const std::complex<double> &root : all)
      if (root.imag() > 0)
        roots.push_back(root);
    std::sort(roots.begin(), roots.end(), [](const auto a, const auto c) { return a.imag() < c.imag(); });
    return roots;
  };
  const auto exact = vibrations(whole), equal = vibrations(first_order(chain.K, chain.C, 0));
  ASSERT_EQ(exact.size(), 6u);
  ASSERT_EQ(equal.size(), 6u);
  const double at_film = 2 * M_PI * films.model.film_frequency;
  for (std::size_t i = 0; i < 6; ++i) {
    const double w = exact[i].imag(), damping = -exact[i].real() / w, stated = -equal[i].real() / w;
    EXPECT_LT(std::max(rest[0], rest[1]) / (w * b), 0.02) << "r over |k + i w b|: locked";
    EXPECT_TRUE(near(equal[i].imag(), w, within(1e-4, "second order in r/(w b) and in the damping")));
    EXPECT_TRUE(near(stated / damping, std::pow(w / at_film, 2), within(0.03, "first order in k/(w b), (29.19)")));
    RecordProperty("mode_" + std::to_string(i + 1),
                   fmt::format("{:.1f} Hz, stated {:+.1e}; damping {:.2e}, stated {:.2e}", w / (2 * M_PI),
                               equal[i].imag() / w - 1, damping, stated));
  }
}

TEST(OilFilmInStand, DetailedStandsHaveItsDamperInResponseAndStructure)
{
  FourHigh stand               = verify::demo_stand();
  stand.dynamics.force_meaning = ForceMeaning::measured;
  const auto films             = chain_with_films(stand, 3e6);
  const StandModel beams       = reduce::beam_stand(stand, reduce::stand_springs(stand, films), 4);
  EXPECT_FALSE(dampers_of(beams).isZero(0));
  const auto modes = reduce::stand_modes(beams);
  const auto all   = dynamics::modal_response(beams, modes.frequency, modes.shape, {beams.b}, {beams.b}, 0, 0);
  const double f   = 0.9 * modes.frequency[0];
  const std::complex<double> by_modes = dynamics::accelerance(all, f)(0, 0);
  const dynamics::DampedStand direct{beams.M, stiffness_of(beams), dampers_of(beams)};
  const std::complex<double> by_matrices = dynamics::direct_accelerance(direct, beams.b, beams.b, f);
  EXPECT_LT(std::abs(by_modes - by_matrices), 1e-8 * std::abs(by_matrices));
  EXPECT_GT(std::abs(by_matrices.imag()), 1e-6 * std::abs(by_matrices));
  const auto modal     = dynamics::modal_model(beams, modes.frequency, modes.shape, 0, 1000);
  const auto structure = dynamics::structure_of(modal);
  EXPECT_EQ((structure.C - modal.dampers).cwiseAbs().maxCoeff(), 0);
  EXPECT_GT(modal.dampers.diagonal().maxCoeff(), 0);
}
