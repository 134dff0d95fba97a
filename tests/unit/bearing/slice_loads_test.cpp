#include "core/base/errors.h"
#include "reduce/bearing/roller_law.h"
#include "reduce/bearing/roller_profile.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
RollerBearing with_profile(const RollerProfile profile)
{
  RollerBearing b = demo_bearing();
  b.profile       = profile;
  return b;
}

// Slices that feel each other: four half spaces pressed along a strip of the Hertz half width of `load`.  A slice
// of length h and half width b moves a point at x by (1 - nu^2)/(pi E h) int dx' / sqrt((x - x')^2 + (b/2)^2) per
// body.
RollerLaw connected(const RollerBearing &b, const double load)
{
  RollerLaw law           = elastic_law(b, {12e-3, 12e-3});
  law.reference_line_load = load / b.roller_length;
  const double E_plane    = b.youngs_modulus / (2 * (1 - b.poisson_ratio * b.poisson_ratio));
  const double half       = std::sqrt(4 * law.reference_line_load * effective_radius(b, true) / (M_PI * E_plane));
  const double c = half / 2, h = law.slice_length;
  for (Eigen::Index k = 0; k < law.position.size(); ++k)
    for (Eigen::Index l = 0; l < law.position.size(); ++l) {
      const double x      = law.position[k] - law.position[l];
      law.influence(k, l) = law.kappa / h * (std::asinh((x + h / 2) / c) - std::asinh((x - h / 2) / c));
    }
  return with_limits(law);
}

VectorXd approach(const RollerLaw &law, const double middle, const double tilt)
{
  return (middle + tilt * law.position.array()).matrix();
}

MatrixXd all_directions(const RollerLaw &law)
{
  return MatrixXd::Identity(law.position.size(), law.position.size());
}
}  // namespace

// Without neighbours every slice is the closed form for its own line load.
TEST(SliceLoads, ElasticSlicesAreTheClosedForm)
{
  const RollerBearing b = demo_bearing();
  const RollerLaw law   = elastic_law(b, {11e-3, 13e-3});
  for (const double load : {100.0, 10e3, 200e3}) {
    const double d  = roller_approach(law, load);
    const double by = (elastic_roller(b, load, 11e-3).approach + elastic_roller(b, load, 13e-3).approach) / 2;
    EXPECT_TRUE(near(d, by, within(1e-11, "one law in two forms, Newton to rounding")));
    EXPECT_TRUE(near(roller_load(law, d, 0).load, load, within(1e-11, "inverse")));
  }
}

// What the law promises: d = influence q + local where q > 0, nothing missing where q = 0.
TEST(SliceLoads, SatisfyTheContactConditions)
{
  for (const RollerProfile profile : {RollerProfile::none, RollerProfile::iso, RollerProfile::log})
    for (const double tilt : {0.0, 1e-3, -5e-3})
      for (const double middle : {1e-7, 5e-6, 4e-5}) {
        const RollerLaw law = connected(with_profile(profile), 50e3);
        const VectorXd d    = approach(law, middle, tilt);
        const auto loads    = slice_loads(law, d, all_directions(law));
        const VectorXd p    = loads.load / law.slice_length;
        if (p.maxCoeff() > law.separate_line_load)
          continue;  // the law goes on in another form there
        const VectorXd gap = d - law.drop - law.influence * loads.load;
        for (Eigen::Index k = 0; k < p.size(); ++k) {
          const double local = p[k] > 0 ? law.kappa * p[k] * std::log(law.reference_line_load / p[k]) : 0;
          EXPECT_GE(p[k], 0);
          if (p[k] > 0)
            EXPECT_TRUE(near(gap[k], local, within(1e-11, "Newton to rounding", d.cwiseAbs().maxCoeff())));
          else
            EXPECT_LE(gap[k], 1e-12 * d.cwiseAbs().maxCoeff());
        }
      }
}

TEST(SliceLoads, SlopeIsTheDerivative)
{
  for (const RollerLaw &law :
       {connected(with_profile(RollerProfile::iso), 50e3), connected(with_profile(RollerProfile::none), 10e3),
        roller_law(with_profile(RollerProfile::iso))})
    for (const double middle : {6e-6, 60e-6, 150e-6}) {  // 150 um: beyond the range of separate slices
      const VectorXd d = approach(law, middle, 3e-4);
      const auto loads = slice_loads(law, d, all_directions(law));
      const double eps = 1e-11;
      MatrixXd difference(d.size(), d.size());
      for (Eigen::Index k = 0; k < d.size(); ++k) {
        const VectorXd e = eps * VectorXd::Unit(d.size(), k);
        difference.col(k) =
            (slice_loads(law, d + e, e, loads.load).load - slice_loads(law, d - e, e, loads.load).load) /
            (2 * eps);
      }
      EXPECT_LT((difference - loads.slope).cwiseAbs().maxCoeff(), 1e-5 * loads.slope.cwiseAbs().maxCoeff());
      EXPECT_LT((loads.slope - loads.slope.transpose()).cwiseAbs().maxCoeff(),
                1e-10 * loads.slope.cwiseAbs().maxCoeff());
    }
}

TEST(SliceLoads, StartDoesNotMatter)
{
  const RollerLaw law = connected(with_profile(RollerProfile::log), 50e3);
  const MatrixXd none(law.position.size(), 0);
  const VectorXd d  = approach(law, 40e-6, 1e-3);
  const auto cold   = slice_loads(law, d, none);
  const auto other  = slice_loads(law, d, none, slice_loads(law, approach(law, 90e-6, -2e-3), none).load);
  const auto itself = slice_loads(law, d, none, cold.load);
  EXPECT_LT((cold.load - other.load).cwiseAbs().maxCoeff(), 1e-9 * cold.load.maxCoeff());
  EXPECT_LE(itself.iterations, 1);
}

// Up to 200 kN and 5 mrad, edge loads included; the load never falls with the approach.
TEST(SliceLoads, AlwaysConverge)
{
  int solved = 0, most = 0;
  for (const double reference : {10e3, 50e3, 200e3})
    for (const RollerProfile profile :
         {RollerProfile::none, RollerProfile::iso, RollerProfile::log, RollerProfile::lundberg}) {
      const RollerLaw law = connected(with_profile(profile), reference);
      const MatrixXd none(law.position.size(), 0);
      for (const double tilt : {0.0, 1e-4, 1e-3, -3e-3, 5e-3}) {
        double before = 0;
        for (double middle = 1e-9; middle < 300e-6; middle *= 2) {
          const auto slice_state = slice_loads(law, approach(law, middle, tilt), none);
          EXPECT_GE(slice_state.load.sum(), before);
          before = slice_state.load.sum();
          most   = std::max(most, slice_state.iterations);
          ++solved;
        }
        EXPECT_GT(before, 100e3);
      }
    }
  EXPECT_GT(solved, 1000);
  EXPECT_LE(most, 40);
}

// The half width is counted once: another reference line load gives the same roller.
TEST(SliceLoads, ReferenceLineLoadHardlyMatters)
{
  for (const double load : {2e3, 20e3, 100e3}) {
    const double a = roller_approach(connected(with_profile(RollerProfile::log), 10e3), load),
                 b = roller_approach(connected(with_profile(RollerProfile::log), 60e3), load);
    EXPECT_TRUE(
        near(a, b, within(5e-3, "neighbours at 2 b away feel the spread, which the local term leaves out")));
  }
}

TEST(SliceLoads, RefusesWhatDoesNotFit)
{
  RollerLaw law = connected(demo_bearing(), 50e3);
  EXPECT_THROW(slice_loads(law, VectorXd::Ones(3), MatrixXd::Ones(3, 1)), InputError);
  EXPECT_THROW(slice_loads(law, VectorXd::Ones(41), MatrixXd::Ones(41, 1), VectorXd::Ones(2)), InputError);
  law.influence *= -1;
  EXPECT_THROW(with_limits(law), InputError);
  law.influence.resize(2, 2);
  EXPECT_THROW(with_limits(law), InputError);
  RollerBearing fe = demo_bearing();
  fe.roller_law    = OneRollerLaw::fe;
  EXPECT_THROW(roller_law(fe), InputError);
  RollerBearing thin  = demo_bearing();
  thin.roller_law     = OneRollerLaw::elastic;
  thin.pitch_diameter = 0.28;  // the cone's raceway below the bore
  EXPECT_THROW(roller_law(thin), InputError);
}

// The same approaches, factor times the loads: what "the contact elements carry 2 % more" means for a bearing.
TEST(SliceLoads, AStiffenedLawCarriesMoreAtTheSameApproach)
{
  for (const OneRollerLaw kind : {OneRollerLaw::iso, OneRollerLaw::elastic}) {
    RollerBearing b = with_profile(RollerProfile::iso);
    b.roller_law    = kind;
    const auto law = with_limits(roller_law(b)), more = stiffened(law, 1.02);
    const VectorXd d = approach(law, 25e-6, 2e-4);
    const auto q = slice_loads(law, d, all_directions(law)), p = slice_loads(more, d, all_directions(law));
    EXPECT_LT((p.load - 1.02 * q.load).norm(), 1e-12 * q.load.norm()) << word_of(kind);
    EXPECT_LT((p.slope - 1.02 * q.slope).norm(), 1e-9 * q.slope.norm()) << word_of(kind);
  }
  EXPECT_THROW(stiffened(connected(demo_bearing(), 1e4), 0), InputError);
}
