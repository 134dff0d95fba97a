// Six masses from any model, routes to M2..M5, parts of the masses.
#include "reduce/stand/fe_masses.h"
#include "reduce/stand/mass_breakdown.h"
#include "reduce/stand/six_masses.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>

using namespace mill;
using namespace mill::reduce;

TEST(SixMasses, AChainGivesItself)
{
  const LumpedModel model = demo_chain(demo_drawing(), 3e8).model;
  for (const FrameForm frame : every<FrameForm>())
    for (const MassReference reference : every<MassReference>()) {
      const SixMasses six = six_masses(chain_stand(model, frame), {}, reference);
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_TRUE(near(six.M[i], model.M[i].value, within(1e-12, "identity, one small solve")));
      for (std::size_t i = 0; i < 7; ++i)
        EXPECT_TRUE(near(six.K[i], model.K[i].value, within(1e-12, "identity, one small solve")));
    }
}

TEST(SixMasses, FrameOfTheBeamStandIsTheChains)
{
  const FourHigh drawing = demo_drawing();
  for (const FrameForm frame : every<FrameForm>()) {
    FourHigh stand       = drawing;
    stand.dynamics.frame = frame;
    const SixMasses six  = six_masses(demo_beams(stand), riders_of(stand));
    EXPECT_TRUE(near(six.M[0], 9320, within(1e-9, "lumps of the frame")));
    EXPECT_TRUE(near(six.M[5], 4660, within(1e-9, "the chocks ride on it and belong to M5")));
    EXPECT_TRUE(near(six.K[0], demo_chain(stand).model.K[0].value, within(1e-9, "first spring")));
    EXPECT_GT(six.M[4], 38000);
  }
}

// The mean of the backup roll's deflection under its load is less than that of mid-length, (4.8a).
TEST(SixMasses, MeanReference)
{
  const FourHigh drawing = demo_drawing();
  const StandModel stand = demo_beams(drawing);
  const SixMasses mid    = six_masses(stand, riders_of(drawing)),
                  mean   = six_masses(stand, riders_of(drawing), MassReference::mean);
  EXPECT_LT(mean.displacement[1], mid.displacement[1]);
  EXPECT_GT(mean.displacement[4], mid.displacement[4]);
  EXPECT_TRUE(near(mean.M[1] * std::pow(mean.displacement[1], 2), mid.M[1] * std::pow(mid.displacement[1], 2),
                   within(1e-12, "the same energy")));
  EXPECT_EQ(mean.displacement[2], mid.displacement[2]);
  // 1/K of the whole path does not depend on where the backup rolls are read.
  const auto path = [](const SixMasses &s) { return 1 / s.K[0] + 1 / s.K[1] + 1 / s.K[2]; };
  EXPECT_TRUE(near(path(mean), path(mid), within(1e-12, "sum of differences")));
}

TEST(SixMasses, RefusesWhatIsNoStand)
{
  StandModel stand     = demo_beams(demo_drawing());
  stand.points[2].name = "strip";
  EXPECT_EQ(refusal([&] { six_masses(stand); }), "stand model \"beam\": point 3 must be the upper work roll");
  stand = demo_beams(demo_drawing());
  EXPECT_EQ(refusal([&] {
              six_masses(stand, {{"hook", "roof", 0, 1, 10}});
            }),
            "stand model \"beam\" has no point \"roof\" for the hook");
}

TEST(SixMasses, GivenValuesStay)
{
  LumpedModel chain = demo_chain(demo_drawing(), 3e8).model;
  chain.M[1].source = Source::published;
  SixMasses values;
  values.M.fill(1);
  values.K.fill(2);
  const LumpedModel made = with_six_masses(chain, values, "static shape of the beam stand");
  EXPECT_EQ(made.M[1].value, chain.M[1].value);
  EXPECT_EQ(made.M[2].value, 1);
  EXPECT_EQ(made.M[2].method, "static shape of the beam stand");
  EXPECT_EQ(made.M[2].inputs, chain.M[2].inputs);
  EXPECT_EQ(made.K[2].value, 2);
  EXPECT_EQ(made.K[3].value, 3e8) << "the bite does not belong to the stand";
}

TEST(MassBreakdown, PartsAddUpInBothRoutes)
{
  FourHigh drawing = demo_drawing();
  for (const MassReference reference : every<MassReference>()) {
    drawing.dynamics.mass_reference = reference;
    const LumpedStand chain         = demo_chain(drawing);
    const StandModel stand          = demo_beams(drawing);
    const auto closed = chain_breakdown(drawing, chain), model = model_breakdown(drawing, stand, reference);
    const FeMasses routes = fe_masses(drawing, stand, reference);
    for (std::size_t i = 0; i < 6; ++i) {
      double closed_sum = 0, model_sum = 0;
      for (const PartMass &part : closed[i].parts) {
        closed_sum += part.equivalent;
        EXPECT_LE(part.equivalent, part.mass * 1.001) << closed[i].mass << " " << part.name;
      }
      for (const PartMass &part : model[i].parts)
        model_sum += part.equivalent;
      EXPECT_TRUE(near(closed_sum, chain.model.M[i].value, within(1e-12, "the same integrals")));
      EXPECT_EQ(closed[i].mass, "M" + std::to_string(i + 1));
      EXPECT_EQ(model[i].route, "finite elements");
      EXPECT_TRUE(near(model_sum, model[i].value, within(1e-14, "a sum")));
      if (i > 0 && i < 5) {
        EXPECT_EQ(routes.integral[i - 1], model[i].value);
        EXPECT_TRUE(near(model[i].value, closed[i].value,
                         within(0.03, "uneven contact load on the backup roll, shear of the work roll")));
        EXPECT_TRUE(near(routes.solid[i - 1], closed[i].value, within(0.03, "necks end beyond the bearings")));
      }
    }
  }
}

TEST(MassBreakdown, GivenRollStiffnessScalesTheRoll)
{
  FourHigh drawing = demo_drawing();
  Parameter K;
  K.value                 = 9e10;
  K.source                = Source::measured;
  drawing.given["K_ZW"]   = {K, {}};
  const LumpedStand chain = demo_chain(drawing);
  const auto parts        = chain_breakdown(drawing, chain);
  EXPECT_TRUE(near(parts[1].value, chain.model.M[1].value, within(1e-12, "the same integrals")));
  const StandModel stand = demo_beams(drawing, 24);
  const SixMasses six    = six_masses(stand, riders_of(drawing));
  EXPECT_TRUE(near(six.K[5], chain.model.K[5].value, within(0.02, "the contact does not load the roll evenly")));
}

TEST(ShapeValue, CubicOnEitherSideOfTheKink)
{
  RollShape shape;
  shape.x = Eigen::VectorXd::LinSpaced(9, 0, 2);
  shape.value.resize(9);
  const auto exact = [](const double x) { return x <= 1 ? 1 + x * x * x : 2 - 4 * (x - 1); };
  for (Eigen::Index i = 0; i < 9; ++i)
    shape.value[i] = exact(shape.x[i]);
  for (const double x : {0., 0.1, 0.77, 0.999, 1., 1.01, 1.6, 2.})
    EXPECT_TRUE(
        near(value_at(shape, x, 1), exact(x), within_absolute(1e-13, "a cubic is exact for a cubic, rounding")))
        << x;
}
