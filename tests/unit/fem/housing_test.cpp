// Mesh, statics and component of a mill housing: sizes, groups, what is refused.
#include "core/base/errors.h"
#include "fem/housing/housing_component.h"
#include "meshes/housing/housing.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace mill;

namespace {
struct Scratch {
  explicit Scratch(const std::string &ending)
      : path((std::filesystem::temp_directory_path() / ("millstand-housing-" + std::to_string(getpid()) + ending))
                 .string())
  {
  }
  ~Scratch()
  {
    std::filesystem::remove(path);
  }
  std::string path;
};

MillHousing small()
{
  MillHousing h;
  h.thickness         = 0.5;
  h.post_width        = 0.4;
  h.window_width      = 1.2;
  h.window_height     = 3;
  h.upper_beam_height = 0.7;
  h.lower_beam_height = 0.6;
  h.fillet_radius     = 0.15;
  h.foot_height       = 0.8;
  h.screw_pad         = 0.3;
  h.seat_pad          = 0.4;
  return h;
}

fem::ElasticBody meshed(const MillHousing &h, const meshes::HousingMeshSize &size = {2, 1, 0})
{
  const Scratch file(".msh");
  return {meshes::mesh_housing(h, size, file.path), h.steel, 2};
}

std::string refused(const MillHousing &h)
{
  return refusal([&] { meshes::require_housing(h); });
}
}  // namespace

TEST(HousingMesh, QuarterHasItsSizeItsPadsAndItsFeet)
{
  const MillHousing h = small();
  const auto body     = meshed(h);
  const auto exact    = within(1e-12, "coordinates are written with 16 digits");
  EXPECT_TRUE(near(body.face_weights("screw").sum(), 0.15 * 0.15, exact));
  EXPECT_TRUE(near(body.face_weights("seat").sum(), 0.2 * 0.2, exact));
  EXPECT_TRUE(near(body.face_weights("foot").sum(), 2 * meshes::foot_half_height(h) * 0.25, exact));
  EXPECT_TRUE(near(body.face_weights("symmetry.x").sum(), (0.7 + 0.6) * 0.25, exact));
  const double r = h.fillet_radius, section = (0.6 + 0.4) * (3 + 0.7 + 0.6) - 0.6 * 3 + 2 * r * r * (1 - M_PI / 4);
  EXPECT_TRUE(near(body.volume(), section * 0.25,
                   within(1e-3, "a fillet of chords fills the corner a little more than its arc")));
  EXPECT_TRUE(near(body.nodes().col(1).minCoeff(), -0.6, exact));
  EXPECT_TRUE(near(body.nodes().col(1).maxCoeff(), 3.7, exact));
}

TEST(HousingMesh, NoElementIsLongerThanAsked)
{
  const MillHousing h  = small();
  const double longest = fem::longest_housing_element(h, 2000);
  const auto body      = meshed(h, {2, 4, longest});
  EXPECT_GE(fem::housing_reach(h, body), 2000 * (1 - 1e-9));
  EXPECT_LT(fem::housing_reach(h, meshed(h, {2, 4, 0})), 2000);
}

TEST(HousingMesh, PadsAsWideAsTheFlatOfTheWindow)
{
  MillHousing h = small();
  h.thickness   = 1;
  h.screw_pad   = h.window_width - 2 * h.fillet_radius;
  EXPECT_TRUE(near(meshed(h).face_weights("screw").sum(), 0.45 * 0.45, within(1e-12, "written with 16 digits")));
}

TEST(HousingMesh, RefusesWhatDoesNotFit)
{
  MillHousing h   = small();
  h.fillet_radius = 0.7;
  EXPECT_EQ(refused(h), "housing.fillet_radius = \"700 mm\" is not less than half the window (\"1200 mm\" wide, "
                        "\"3000 mm\" high): the corners would leave nothing straight between them; give a smaller "
                        "radius");
  h               = small();
  h.fillet_radius = 0.01;
  EXPECT_EQ(refused(h), "housing.fillet_radius = \"10 mm\" is too sharp for posts \"400 mm\" wide: stress has no "
                        "limit in a sharp corner and the elements around it degenerate; give at least \"20 mm\"");
  h           = small();
  h.thickness = 1.5;
  h.screw_pad = 1;
  EXPECT_EQ(refused(h),
            "housing.screw_pad = \"1000 mm\" is wider than the flat of the window between its fillets, "
            "\"900 mm\": give a smaller pad, a wider window or a smaller fillet");
  h          = small();
  h.seat_pad = 0.6;
  EXPECT_EQ(refused(h),
            "housing.seat_pad = \"600 mm\" is wider than housing.thickness = \"500 mm\": the pad would "
            "overhang; give a smaller pad or a thicker housing");
  h             = small();
  h.foot_height = 0.1;
  EXPECT_EQ(refused(h),
            "housing.foot_height = \"100 mm\" is outside the straight part of the posts: give \"170 mm\" "
            "to \"2830 mm\" above the window's bottom");
  h            = small();
  h.post_width = -0.4;
  EXPECT_EQ(refused(h), "housing.post_width = \"-400 mm\" must be positive: give the length of the drawing");
  EXPECT_EQ(refused(small()), "accepted");
}

TEST(HousingMesh, AllMistakesComeAtOnce)
{
  MillHousing h = small();
  h.seat_pad    = 0.6;
  h.screw_pad   = 0.7;
  try {
    meshes::require_housing(h);
    FAIL() << "accepted";
  } catch (const InputError &error) {
    EXPECT_EQ(error.problems.size(), 2u);
  }
}

TEST(HousingStatics, WithoutFeetPartAndDirectionAreNamed)
{
  const MillHousing h = small();
  const Scratch file(".msh");
  MeshFile mesh = meshes::mesh_housing(h, {2, 1, 0}, file.path);
  mesh.groups.erase("foot");
  const fem::ElasticBody body(mesh, h.steel, 2);
  const std::string expected = "housing: nothing holds it in the direction y (vertical), its mesh has no group "
                               "\"foot\": mesh it with feet and both pads";
  EXPECT_EQ(refusal([&] { fem::housing_statics(h, body); }), expected);
  EXPECT_EQ(refusal([&] { fem::housing_component(h, body); }), expected);
}

TEST(HousingStatics, FrameTakesStiffnessAndMassOfTheParts)
{
  const MillHousing h = small();
  const auto s        = fem::housing_statics(h, meshed(h));
  Frame before;
  before.piston_stiffness = 4e11;
  const Frame frame       = fem::frame_with_housing(before, s);
  EXPECT_TRUE(near(1 / frame.upper_post_stiffness + 1 / frame.upper_beam_stiffness, s.u_screw,
                   within(1e-14, "shares of one number")));
  EXPECT_TRUE(near(1 / frame.lower_post_stiffness + 1 / frame.lower_beam_stiffness, -s.u_seat,
                   within(1e-14, "shares of one number")));
  EXPECT_EQ(frame.upper_beam_mass, s.reduced_mass[fem::upper_beam]);
  EXPECT_EQ(frame.lower_post_mass, s.reduced_mass[fem::lower_post]);
  EXPECT_EQ(frame.piston_stiffness, 4e11);
  for (std::size_t p = 0; p < fem::n_housing_parts; ++p) {
    EXPECT_GT(s.flexibility[p], 0);
    EXPECT_LE(s.vertical_mass[p], s.reduced_mass[p]);
  }
}

TEST(HousingStatics, VtuNamesDisplacementAndStressWithoutTheDate)
{
  const MillHousing h = small();
  const auto body     = meshed(h);
  const auto s        = fem::housing_statics(h, body);
  const Scratch file(".vtu");
  fem::write_housing_vtu(file.path, body, s, 1e6);
  std::ifstream in(file.path);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(text.find("Name=\"displacement_m\" NumberOfComponents=\"3\""), std::string::npos);
  EXPECT_NE(text.find("Name=\"stress_Pa\" NumberOfComponents=\"9\""), std::string::npos);
  const std::string head = text.substr(0, text.find("<VTKFile"));
  EXPECT_NE(head.find("deal.II"), std::string::npos) << "no head at all?";
  EXPECT_EQ(head.find(':'), std::string::npos) << "the time of day: " << head;  // the same run, the same bits
}

TEST(HousingComponent, StandsOnItsFeetWithScrewAndSeat)
{
  const MillHousing h = small();
  const auto body     = meshed(h);
  fem::HousingComponentOptions options;
  options.n_modes = 3;
  fem::ComponentBasis basis;
  const Component c = fem::housing_component(h, body, options, &basis);
  EXPECT_EQ(c.name, "housing");
  EXPECT_EQ(c.interface, (std::vector<std::string>{"screw", "seat"}));
  EXPECT_EQ(c.M.rows(), 5);
  EXPECT_EQ(c.residual.rows(), 2);
  EXPECT_EQ(basis.constraint.cols(), 2);
  EXPECT_TRUE(near(c.mass, 8 * body.volume() * h.steel.density, within(1e-10, "the same quadrature")));
  const Eigen::VectorXd foot = fem::mean_vertical(body, fem::HousingGroup::foot);
  EXPECT_LT((foot.transpose() * basis.constraint).norm(), 1e-10);  // of unit displacements: the feet stay
  // No rigid motion is left.
  EXPECT_GT(c.K(0, 0) * c.K(1, 1) - c.K(0, 1) * c.K(1, 0), 1e-3 * c.K(0, 0) * c.K(1, 1));
}

TEST(HousingComponent, LimitAboveTheReachOfTheMeshIsRefused)
{
  const MillHousing h = small();
  const auto body     = meshed(h, {2, 4, 0});
  fem::HousingComponentOptions options;
  options.frequency_limit = 5000;
  EXPECT_EQ(refusal([&] { fem::housing_component(h, body, options); }).substr(0, 51),
            "the frequency limit of 5000 Hz is above what the me");
}
