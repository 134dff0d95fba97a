// Springs of the screw-down: what replaces what in the frame, and what is refused.
#include "reduce/chain/screwdown.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>

using namespace mill;

namespace {
const Material steel;
const auto rounding = within(1e-14, "the same product in another order");

Screwdown hydraulic()
{
  Screwdown s;
  s.piston_diameter = 0.8;
  s.stroke          = 0.04;
  return s;
}
Screwdown with_screw()
{
  Screwdown s      = hydraulic();
  s.screw_diameter = 0.44;
  s.screw_length   = 0.6;
  return s;
}
std::string refused(const Screwdown &s)
{
  return refusal([&] { reduce::screwdown_springs(s, steel); });
}
}  // namespace

TEST(Screwdown, NothingDrawnReplacesNothing)
{
  Frame frame;
  frame.piston_stiffness = 4e11;
  const auto out         = reduce::frame_with_screwdown(frame, Screwdown(), steel);
  EXPECT_TRUE(out.replaced.empty());
  EXPECT_EQ(out.frame.piston_stiffness, 4e11);
  EXPECT_TRUE(std::isnan(out.frame.load_cell_stiffness));
}

TEST(Screwdown, OilColumnReplacesItsSpringOnly)
{
  Frame frame;
  frame.oil_column_stiffness = 1.8e10;
  frame.piston_stiffness     = 4e11;
  const auto out             = reduce::frame_with_screwdown(frame, hydraulic(), steel);
  ASSERT_EQ(out.replaced.size(), 1u);
  const auto &r = out.replaced[0];
  EXPECT_EQ(r.key, "frame.oil_column_stiffness");
  EXPECT_EQ(r.parts, "oil column");
  EXPECT_EQ(r.before, 1.8e10);
  EXPECT_EQ(r.after, out.frame.oil_column_stiffness);
  EXPECT_EQ(r.member, &Frame::oil_column_stiffness);
  EXPECT_EQ(out.frame.piston_stiffness, 4e11);
}

TEST(Screwdown, ScrewNutAndPistonAreInSeriesAsFarAsDrawn)
{
  Screwdown s    = with_screw();
  const auto one = reduce::frame_with_screwdown(Frame(), s, steel);
  ASSERT_EQ(one.replaced.size(), 2u);
  EXPECT_EQ(one.replaced[1].parts, "screw");
  s.nut_outside_diameter = 0.7;
  s.nut_height           = 0.9;
  s.piston_length        = 0.3;
  const auto all         = reduce::frame_with_screwdown(Frame(), s, steel);
  ASSERT_EQ(all.replaced.size(), 2u);
  EXPECT_EQ(all.replaced[1].key, "frame.piston_stiffness");
  EXPECT_EQ(all.replaced[1].parts, "screw, nut, piston in series");
  const auto k = reduce::screwdown_springs(s, steel);
  EXPECT_TRUE(near(1 / all.frame.piston_stiffness, 1 / k.screw + 1 / k.nut + 1 / k.piston, rounding));
  EXPECT_LT(all.frame.piston_stiffness, one.frame.piston_stiffness);
}

TEST(Screwdown, ThreadIsFiveTimesAsStiffAsTheSameLengthOfScrewAndNutInSeries)
{
  EXPECT_TRUE(near(reduce::thread_flexibility(2, 3, 4), (2. / 3 + 2. / 4) / 5, rounding));
}

TEST(Screwdown, LoadCellIsARing)
{
  Screwdown s;
  s.load_cell_diameter = 0.5;
  s.load_cell_height   = 0.1;
  const double solid   = reduce::screwdown_springs(s, steel).load_cell;
  s.load_cell_bore     = 0.3;
  const auto out       = reduce::frame_with_screwdown(Frame(), s, steel);
  EXPECT_TRUE(near(out.frame.load_cell_stiffness / solid, 1 - 0.36, rounding));
  EXPECT_TRUE(std::isnan(out.replaced.at(0).before));
}

TEST(Screwdown, HalfADrawingIsRefusedInWords)
{
  Screwdown s;
  s.screw_diameter = 0.44;
  EXPECT_EQ(refused(s),
            "screwdown.screw_diameter = \"440 mm\" is given without screwdown.screw_length, how long the "
            "screw is between nut and piston: give it, or leave both out");
  s        = Screwdown();
  s.stroke = 0.04;
  EXPECT_EQ(refused(s), "screwdown.stroke = \"40 mm\" is given without screwdown.piston_diameter, the area of the "
                        "oil: give it, or leave both out");
  s                 = Screwdown();
  s.piston_diameter = 0.8;
  EXPECT_EQ(refused(s), "screwdown.piston_diameter = \"800 mm\" is given without screwdown.stroke (oil column) or "
                        "screwdown.piston_length (piston): give one of them, or leave it out");
  s                      = Screwdown();
  s.nut_outside_diameter = 0.7;
  s.nut_height           = 0.9;
  EXPECT_EQ(refused(s), "screwdown.nut_height = \"900 mm\" is given without screwdown.screw_diameter, the bore of "
                        "the nut: give it, or leave both out");
  s                  = Screwdown();
  s.load_cell_height = 0.1;
  EXPECT_EQ(refused(s),
            "screwdown.load_cell_height = \"100 mm\" is given without screwdown.load_cell_diameter, its "
            "section: give it, or leave both out");
}

TEST(Screwdown, SizesThatDoNotFitAreRefused)
{
  Screwdown s            = with_screw();
  s.nut_outside_diameter = 0.4;
  s.nut_height           = 0.9;
  EXPECT_EQ(refused(s),
            "screwdown.nut_outside_diameter = \"400 mm\" is not larger than screwdown.screw_diameter = "
            "\"440 mm\": the nut goes around the screw; exchange them or correct one");
  s                    = Screwdown();
  s.load_cell_diameter = 0.2;
  s.load_cell_height   = 0.1;
  s.load_cell_bore     = 0.25;
  EXPECT_EQ(refused(s), "screwdown.load_cell_bore = \"250 mm\" is not smaller than screwdown.load_cell_diameter = "
                        "\"200 mm\": nothing would carry the load; correct one of them");
  s        = hydraulic();
  s.stroke = -0.04;
  EXPECT_EQ(refused(s), "screwdown.stroke = \"-40 mm\" must be positive: give the length of the drawing, or leave "
                        "the key out");
  s             = hydraulic();
  s.oil_modulus = 0;
  EXPECT_EQ(refused(s), "screwdown.oil_modulus = \"0 MPa\" must be positive");
}

TEST(Screwdown, AllMistakesComeAtOnce)
{
  Screwdown s;
  s.screw_length     = 0.6;
  s.load_cell_height = 0.1;
  try {
    reduce::screwdown_springs(s, steel);
    FAIL() << "accepted";
  } catch (const InputError &error) {
    EXPECT_EQ(error.problems.size(), 2u);
  }
}
