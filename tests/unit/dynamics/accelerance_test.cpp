// Accelerance by modes and without them, and its band.
#include "core/base/errors.h"
#include "dynamics/response/accelerance.h"
#include "dynamics/response/frequency_response.h"
#include "dynamics/response/modes.h"
#include "dynamics/response/response_band.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <cmath>
#include <complex>

using namespace mill;
using namespace mill::dynamics;
using Complex = std::complex<double>;

namespace {
constexpr double mass = 250, frequency_0 = 40, damping = 0.02;

/// One mass on a spring.
ModalResponse oscillator(const double gap_damper = 0)
{
  const Eigen::MatrixXd v = Eigen::MatrixXd::Constant(1, 1, 1 / std::sqrt(mass));
  return {Eigen::VectorXd::Constant(1, frequency_0), v, v, v.row(0), damping, gap_damper};
}

double stiffness()
{
  return mass * std::pow(2 * M_PI * frequency_0, 2);
}

/// -w^2 / (k + i w c - m w^2), written down.
Complex closed_form(const double f, const double gap_damper)
{
  const double w = 2 * M_PI * f, c = 2 * damping * std::sqrt(stiffness() * mass) + gap_damper;
  return -w * w / Complex(stiffness() - mass * w * w, w * c);
}
}  // namespace

TEST(Accelerance, OneMassHasTheClosedForm)
{
  for (const double gap_damper : {0., 3000.})
    for (const double f : {1., 39.9, 40., 41., 500.}) {
      const Complex computed = accelerance(oscillator(gap_damper), f)(0, 0), wanted = closed_form(f, gap_damper);
      EXPECT_LT(std::abs(computed - wanted), 1e-13 * std::abs(wanted)) << f << " Hz, " << gap_damper << " N s/m";
    }
}

TEST(Accelerance, AChainSatisfiesItsEquationOfMotion)
{
  const MillModel chain = mill_model(published_stand(), settings(ForceMeaning::published, 0.01));
  StandModel stand;
  stand.M             = chain.M.asDiagonal();
  stand.K_parts       = chain.K;
  stand.b             = chain.b;
  const Modes natural = modes(chain);
  const auto s        = damped_stand(stand, 0.01, 0);
  const auto f        = frequencies_around(natural.frequency, 0.01, 10, 1000);
  const auto sum =
      modal_response(stand, natural.frequency, natural.shape, {Eigen::VectorXd::Unit(6, 2)}, {chain.b}, 0.01, 0);
  const FrequencyResponse by_matrices = frequency_response(chain, f);  // its damping is made from the modes
  const double largest                = by_matrices.acceleration.col(2).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < f.size(); i += 7) {
    EXPECT_LT(std::abs(accelerance(sum, f[i])(0, 0) - by_matrices.acceleration(i, 2)), 1e-11 * largest) << f[i];
    EXPECT_LT(std::abs(direct_accelerance(s, Eigen::VectorXd::Unit(6, 2), chain.b, f[i]) -
                       by_matrices.acceleration(i, 2)),
              1e-10 * largest)
        << f[i];
  }
}

TEST(Accelerance, DampingByTheRootOfAMatrixHasTheRatioInEveryMode)
{
  const MillModel chain          = mill_model(published_stand(), settings(ForceMeaning::measured, 0));
  const Eigen::MatrixXd M        = chain.M.asDiagonal();
  const Eigen::MatrixXd C        = modal_damping_matrix(M, chain.K, 0.03);
  const Modes natural            = modes(chain);
  const Eigen::MatrixXd in_modes = natural.shape.transpose() * C * natural.shape;
  const Eigen::MatrixXd wanted   = (0.06 * 2 * M_PI * natural.frequency).asDiagonal();
  EXPECT_LT((in_modes - wanted).norm(), 1e-11 * wanted.norm());
  EXPECT_THROW(modal_damping_matrix(M, -chain.K, 0.03), SolverError) << "a stiffness that is not positive";
}

TEST(Accelerance, IsReciprocal)
{
  const MillModel chain = mill_model(published_stand(), settings(ForceMeaning::published, 0.01));
  StandModel stand;
  stand.M                                      = chain.M.asDiagonal();
  stand.K_parts                                = chain.K;
  stand.b                                      = chain.b;
  const Modes natural                          = modes(chain);
  const std::vector<Eigen::VectorXd> positions = {Eigen::VectorXd::Unit(6, 0), Eigen::VectorXd::Unit(6, 2),
                                                  Eigen::VectorXd::Unit(6, 4)};
  const auto a =
      accelerance(modal_response(stand, natural.frequency, natural.shape, positions, positions, 0.01, 1e5), 200);
  EXPECT_LT((a - a.transpose()).norm(), 1e-14 * a.norm());
}

TEST(Accelerance, FrequenciesAreCloseWithinAResonance)
{
  const Eigen::VectorXd f = frequencies_around(Eigen::Vector2d(50, 300), 0.01, 20, 400);
  EXPECT_EQ(f[0], 20);
  EXPECT_EQ(f[f.size() - 1], 400);
  for (Eigen::Index i = 1; i < f.size(); ++i) {
    EXPECT_GT(f[i], f[i - 1]);
    EXPECT_LE(f[i] - f[i - 1], 0.0201 * f[i]);
    if (std::abs(f[i] / 300 - 1) < 0.01)
      EXPECT_LE(f[i] - f[i - 1], 0.3 * 0.01 * 300) << "a quarter of the half width";
  }
}

TEST(ResponseBand, BelowTheResonanceTheBandIsTheErrorOfTheSpring)
{
  ModalResponse one = oscillator();
  const double e    = 0.2;
  UncertainInput spring{e, Eigen::MatrixXd::Constant(1, 1, std::pow(2 * M_PI * frequency_0, 2)),
                        Eigen::MatrixXd::Zero(1, 1)};
  const Eigen::VectorXd f = Eigen::Vector2d(0.4, 60);
  BandSettings settings;
  settings.samples       = 4000;
  const auto band        = response_band(one, 1, {spring}, Eigen::VectorXd::Zero(1), f, settings);
  const double magnitude = std::abs(accelerance(one, f[0])(0, 0));
  const Tolerance of_sampling =
      within(0.05, "a 2.5 % quantile of 4000 draws scatters by 3 % of e, of its logarithm");
  EXPECT_TRUE(near(std::log(band.high(0, 0) / magnitude), e, of_sampling));
  EXPECT_TRUE(near(std::log(band.low(0, 0) / magnitude), -e, of_sampling));
  // At the resonance of every draw 1 / (2 zeta m), whatever the spring.
  EXPECT_TRUE(near(band.peak_high(0, 0), 1 / (2 * damping * mass), within(1e-12, "no draw changes it")));
  EXPECT_TRUE(near(band.peak_low(0, 0), 1 / (2 * damping * mass), within(1e-12, "no draw changes it")));
  const auto again = response_band(one, 1, {spring}, Eigen::VectorXd::Zero(1), f, settings);
  EXPECT_EQ(again.high, band.high) << "one seed, one band";
}

TEST(ResponseBand, AtThePeakTheBandIsTheErrorOfTheDamping)
{
  BandSettings settings;
  settings.samples       = 4000;
  settings.damping_error = 0.3;
  const auto band =
      response_band(oscillator(), 1, {}, Eigen::VectorXd::Zero(1), Eigen::Vector2d(20, 60), settings);
  const double peak           = 1 / (2 * damping * mass);
  const Tolerance of_sampling = within(0.05, "quantiles of 4000 draws");
  EXPECT_TRUE(near(std::log(band.peak_high(0, 0) / peak), 0.3, of_sampling));
  EXPECT_TRUE(near(std::log(band.peak_low(0, 0) / peak), -0.3, of_sampling));
}

TEST(ResponseBand, WithoutErrorsTheBandIsTheResponse)
{
  const auto f    = Eigen::Vector2d(20, 60);
  const auto band = response_band(oscillator(), 1, {}, Eigen::VectorXd::Zero(1), f);
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double wanted = std::abs(closed_form(f[i], 0));
    EXPECT_TRUE(near(band.low(i, 0), wanted, within(1e-12, "closed form")));
    EXPECT_TRUE(near(band.high(i, 0), wanted, within(1e-12, "closed form")));
  }
}
