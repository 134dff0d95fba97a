// Piece of raceway: radii, thickness, groups; the three meshes of one roller share their patches.
#include "core/base/errors.h"
#include "fem/body/elastic_body.h"
#include "fem/body/section_body.h"
#include "meshes/bearing/raceway.h"
#include "meshes/bearing/roller.h"
#include "tests/support/near.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>
#include <utility>

using namespace mill;

namespace {
struct Scratch {
  std::string path =
      (std::filesystem::temp_directory_path() / ("millstand-raceway-" + std::to_string(getpid()) + ".msh"))
          .string();
  ~Scratch()
  {
    std::filesystem::remove(path);
  }
};
const Material steel{206e9, 0.3, 7850};
const auto rounding = within(1e-12, "coordinates are written with 16 digits");

meshes::RacewayPiece piece(const double radius)
{
  meshes::RacewayPiece p;
  p.radius = radius;
  for (int i = 0; i <= 40; ++i)
    p.x.push_back(0.001 * i);
  p.depth   = {0, 0.002, 0.012};
  p.z       = {0, 0.01, 0.015};
  p.patch_x = 0.005;
  p.patch_z = 0.01;
  return p;
}

// Sector of a ring of that angle, which holds the raceway up to x.
double sector(const double radius, const double x, const double depth)
{
  const double angle = std::asin(x / std::abs(radius)), back = radius - depth;
  return 0.5 * angle * std::abs(radius * radius - back * back);
}
}  // namespace

TEST(RacewayMesh, VolumeIsThatOfTheSectorBetweenRacewayAndBack)
{
  const auto chords =
      within(2e-4, "chords of 1 mm on a radius of 0.1 m and less lose up to h^2/(8 R) of the layer at "
                   "each radius; their differences at raceway and back are 1e-4 of the thickness");
  for (const double radius : {0.1448, -0.1663}) {
    const Scratch file;
    const fem::ElasticBody body(meshes::mesh_raceway(piece(radius), file.path), steel, 1);
    EXPECT_TRUE(near(body.volume(), 0.015 * sector(radius, 0.04, 0.012), chords)) << radius;
  }
  const Scratch file;
  const fem::ElasticBody flat(meshes::mesh_raceway(piece(0), file.path), steel, 1);
  EXPECT_TRUE(near(flat.volume(), 0.015 * 0.04 * 0.012, rounding));
}

TEST(RacewayMesh, NodesLieOnRacewayAndBackAndThePatchEndsWhereAsked)
{
  for (const double radius : {0.1448, -0.1663}) {
    const Scratch file;
    const fem::ElasticBody body(meshes::mesh_raceway(piece(radius), file.path), steel, 1);
    const auto distance = [&](const int node) {  // from the axis of the raceway at (0, -radius)
      return std::hypot(body.nodes()(node, 0), body.nodes()(node, 1) + radius);
    };
    for (const int node : body.group("patch")) {
      EXPECT_TRUE(near(distance(node), std::abs(radius), rounding));
      EXPECT_LE(body.nodes()(node, 0), 0.005 * (1 + 1e-12));
      EXPECT_LE(body.nodes()(node, 2), 0.01 * (1 + 1e-12));
    }
    for (const int node : body.group("back"))
      EXPECT_TRUE(near(distance(node), std::abs(radius - 0.012), rounding));
    EXPECT_EQ(body.group("patch").size(), 6u * 2u);
  }
}

TEST(RacewayMesh, WithoutLengthItIsAPlaneSection)
{
  const Scratch file;
  auto p = piece(0);
  p.z.clear();
  const fem::SectionBody body(meshes::mesh_raceway(p, file.path), steel, 2, fem::Section::plane_strain);
  EXPECT_TRUE(near(body.measure(), 0.04 * 0.012, rounding));
  EXPECT_EQ(body.group("patch").size(), 11u);
}

TEST(RacewayMesh, RejectsLinesThatDoNotAscendAndPiecesThatDoNotFitTheirRadius)
{
  const Scratch file;
  auto p = piece(0);
  p.x[1] = p.x[2];
  EXPECT_THROW(meshes::mesh_raceway(p, file.path), InputError);
  p       = piece(0);
  p.depth = {0.001, 0.002};
  EXPECT_THROW(meshes::mesh_raceway(p, file.path), InputError);
  EXPECT_THROW(meshes::mesh_raceway(piece(0.04), file.path), InputError);
  p       = piece(0.05);
  p.depth = {0, 0.06};
  EXPECT_THROW(meshes::mesh_raceway(p, file.path), InputError);
}

TEST(RollerMesh, PatchesOfTheThreeBodiesMatchNodeByNode)
{
  RollerSetup s;
  s.diameter       = 0.0215;
  s.length         = 0.0334;
  s.contact_length = 0.030;
  s.inner_radius   = 0.1448;
  s.outer_radius   = 0.1663;
  s.inner_depth = s.outer_depth = 0.012;
  s.largest_load                = 50e3;
  const auto made               = meshes::mesh_roller(s, std::filesystem::temp_directory_path().string(),
                                                      "millstand-roller-" + std::to_string(getpid()));
  const auto stations           = [&](const MeshFile &mesh, const char *group) {
    const fem::ElasticBody body(mesh, s.material, 1);
    std::vector<std::pair<double, double>> at;
    for (const int node : body.group(group))
      at.push_back({std::round(1e9 * body.nodes()(node, 2)), std::round(1e9 * body.nodes()(node, 0))});
    std::sort(at.begin(), at.end());
    return at;
  };
  const auto roller = stations(made.roller, "contact");
  EXPECT_EQ(stations(made.inner, "patch"), roller) << "to a nanometre";
  EXPECT_EQ(stations(made.outer, "patch"), roller) << "to a nanometre";
  EXPECT_EQ(roller.back().first, 15e6) << "half of the contact length, in nanometres";
  meshes::remove_meshes(made);
  EXPECT_FALSE(std::filesystem::exists(made.inner.path));
}
