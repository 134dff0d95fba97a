// Structured blocks and rings, and the quarter disc in the plane: sizes, groups, measures.
#include "core/base/errors.h"
#include "fem/body/elastic_body.h"
#include "fem/body/section_body.h"
#include "meshes/common/block.h"
#include "tests/manual/solvers/ring_mesh.h"
#include "tests/support/near.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;

namespace {
struct Scratch {
  std::string path =
      (std::filesystem::temp_directory_path() / ("millstand-block-mesh-" + std::to_string(getpid()) + ".msh"))
          .string();
  ~Scratch()
  {
    std::filesystem::remove(path);
  }
};
const Material steel{210e9, 0.3, 7850};
const auto rounding = within(1e-12, "coordinates are written with 16 digits");

double length_of(const Surface &line)
{
  double sum = 0;
  for (Eigen::Index f = 0; f < line.faces.rows(); ++f)
    for (Eigen::Index k = 0; k + 1 < line.faces.cols(); ++k)
      sum += (line.points.row(line.faces(f, k + 1)) - line.points.row(line.faces(f, k))).norm();
  return sum;
}
}  // namespace

TEST(MeshLines, EvenThenGrowingToTheLength)
{
  const auto x = meshes::mesh_lines({2, 4, 0, 1.5, 300});
  EXPECT_EQ(x.front(), 0);
  EXPECT_EQ(x.back(), 300);
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(near(x[i + 1] - x[i], 0.5, rounding));
  const double ratio = (x[6] - x[5]) / (x[5] - x[4]);
  EXPECT_TRUE(near(ratio, 1.5, within(0.1, "adjusted so that the last of 14 elements ends at the length")));
  for (std::size_t i = 5; i + 1 < x.size(); ++i)
    EXPECT_TRUE(near((x[i + 1] - x[i]) / (x[i] - x[i - 1]), ratio, within(1e-9, "one geometric series")));
}

TEST(MeshLines, NothingEvenAndNothingToGrow)
{
  const auto depth = meshes::mesh_lines({0, 0, 0.5, 2, 31.5});
  ASSERT_EQ(depth.size(), 7u);  // 0.5 (2^6 - 1) = 31.5
  EXPECT_TRUE(near(depth[1], 0.5, within(1e-9, "the growth is found by bisection")));
  EXPECT_EQ(meshes::mesh_lines({1, 2, 0, 1.5, 1}), (std::vector<double>{0, 0.5, 1}));
}

TEST(BlockMesh, BrickHasItsSizeAndItsGroups)
{
  const Scratch file;
  meshes::BlockGrid grid;
  grid.x          = meshes::even_lines(0, 3, 3);
  grid.y          = meshes::even_lines(-2, 0, 2);
  grid.z          = meshes::even_lines(0, 4, 4);
  grid.patch_x    = 2;
  grid.patch_z    = 1;
  const auto mesh = meshes::mesh_block(grid, file.path);
  EXPECT_EQ(mesh.n_cells, 24);
  EXPECT_EQ(mesh.n_nodes, 60);
  EXPECT_TRUE(near(mesh.smallest_jacobian, 1, rounding));
  const fem::ElasticBody body(mesh, steel, 1);
  EXPECT_TRUE(near(body.volume(), 24, rounding));
  const std::vector<std::pair<std::string, double>> areas{{"patch", 2}, {"top", 10}, {"bottom", 12}, {"left", 8},
                                                          {"right", 8}, {"back", 6}, {"front", 6}};
  for (const auto &[name, area] : areas)
    EXPECT_TRUE(near(body.face_weights(name).sum(), area, rounding)) << name;
  EXPECT_EQ(body.group("patch").size(), 6u);
}

TEST(BlockMesh, SectionOfABlockServesPlaneAndRevolution)
{
  const Scratch file;
  meshes::BlockGrid grid;
  grid.x          = meshes::even_lines(0, 2, 4);
  grid.y          = meshes::even_lines(-3, 0, 3);
  grid.patch_x    = 1;
  const auto mesh = meshes::mesh_block(grid, file.path);
  const fem::SectionBody plane(mesh, steel, 2, fem::Section::plane_strain),
      round(mesh, steel, 2, fem::Section::axisymmetric);
  EXPECT_TRUE(near(plane.measure(), 6, rounding));
  EXPECT_TRUE(near(round.measure(), 12 * M_PI, rounding));
  EXPECT_TRUE(near(length_of(plane.surface("patch")), 1, rounding));
  EXPECT_TRUE(near(length_of(plane.surface("top")), 1, rounding));
}

TEST(BlockMesh, LinesThatDoNotAscendAreAnError)
{
  const Scratch file;
  meshes::BlockGrid grid;
  grid.x = {0, 1, 0.5};
  grid.y = {0, 1};
  EXPECT_THROW(meshes::mesh_block(grid, file.path), SolverError);
  EXPECT_FALSE(std::filesystem::exists(file.path));
}

TEST(RingMesh, QuarterRingHasItsArea)
{
  const Scratch file;
  const auto mesh = meshes::mesh_ring(meshes::even_lines(0.6, 1, 4), 12, file.path);
  EXPECT_EQ(mesh.n_cells, 48);
  const fem::SectionBody body(mesh, steel, 2, fem::Section::plane_strain,
                              {{"inner", {0, 0}, 0.6}, {"outer", {0, 0}, 1}});
  EXPECT_TRUE(near(body.measure(), M_PI / 4 * (1 - 0.36),
                   within(1e-5, "quadratic edges of half an angle t = 0.065 leave the circle by R t^4/8 = 2e-6")));
  for (const int node : body.group("symmetry.x"))
    EXPECT_EQ(body.nodes()(node, 0), 0);
  for (const int node : body.group("symmetry.y"))
    EXPECT_EQ(body.nodes()(node, 1), 0);
}

TEST(DiscMesh, QuarterDiscHasItsAreaAndItsPatch)
{
  const Scratch file;
  meshes::SectionSize size;
  size.first_element   = 0.02;
  size.patch_elements  = 12;
  size.depth_elements  = 9;
  size.sector_elements = 6;
  const auto mesh      = meshes::mesh_disc(10, size, file.path);
  EXPECT_GT(mesh.smallest_jacobian, 0.1);
  const fem::SectionBody body(mesh, steel, 2, fem::Section::plane_strain,
                              {{"patch", {0, 0}, 10}, {"rim", {0, 0}, 10}});
  EXPECT_TRUE(near(body.measure(), 25 * M_PI,
                   within(1e-4, "the longest edge on the rim spans 10 degrees, t = 0.09: R t^4/8 = 8e-6 of R")));
  double reach = 0;
  for (const int node : body.group("patch")) {
    reach = std::max(reach, body.nodes()(node, 0));
    EXPECT_TRUE(near(body.nodes().row(node).norm(), 10, within(1e-9, "nodes on the true circle: R t^4/8 again")));
  }
  EXPECT_TRUE(near(reach, 0.24, within(1e-9, "twelve elements of 0.02")));
}
