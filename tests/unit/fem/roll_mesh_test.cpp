#include "core/base/errors.h"
#include "core/base/files.h"
#include "meshes/common/write_mesh.h"
#include "tests/support/near.h"
#include "tests/support/roll_pair.h"
#include <Eigen/Eigenvalues>
#include <csignal>
#include <filesystem>
#include <sys/resource.h>

using namespace mill;

namespace {
const Material steel{210e9, 0.28, 7700};
const RollGeometry backup{0.725, 0.7, 0.475, 0.95, 1.225, 0};

meshes::RollMeshSize coarse()
{
  return meshes::coarsened(meshes::roll_contact_size(1.6e-3, 4));
}

MeshFile mesh_of(const RollGeometry &geometry, const meshes::RollMeshSize &size)
{
  const std::string path = (std::filesystem::temp_directory_path() / "millstand-roll-mesh-test.msh").string();
  return meshes::mesh_roll("backup roll", geometry, size, path);
}
}  // namespace

TEST(GradedLayers, FillTheLengthAndGrowFromTheEnd)
{
  for (const double length : {0.05, 0.7, 2.3})
    for (const double end : {3e-4, 5e-3}) {
      const auto layers = meshes::graded_layers(length, end, 2, 0.1);
      double sum        = 0;
      for (const double h : layers)
        sum += h;
      EXPECT_TRUE(near(sum, length, within(1e-12, "layers add up")));
      EXPECT_TRUE(near(layers.back(), end, within(1e-12, "the thinnest keeps its size")));
      for (std::size_t i = 1; i < layers.size(); ++i)
        EXPECT_LE(layers[i], layers[i - 1] * (1 + 1e-12)) << "length " << length;
    }
}

TEST(SectionSize, PatchReachesTheAskedHalfWidth)
{
  for (const double growth : {1., 1.0625, 1.3})
    for (const double reach : {1e-3, 5e-3}) {
      meshes::SectionSize s;
      s.first_element  = 1e-4;
      s.growth         = growth;
      s.patch_elements = meshes::patch_elements_for(1e-4, growth, reach);
      EXPECT_EQ(s.patch_elements % 3, 0);
      EXPECT_GE(meshes::patch_half_width(s), reach);
      s.patch_elements -= 3;
      EXPECT_LT(meshes::patch_half_width(s), reach);
    }
}

TEST(RollMesh, VolumeAndAreasAreThoseOfTheDrawing)
{
  const auto mesh = mesh_of(backup, coarse());
  const fem::ElasticBody body(mesh, steel, 2);
  const double eighth = M_PI / 4;
  // A parabola through three points of an arc of 45 degrees encloses 0.78 permille less than the circle.
  const std::string chord =
      "the coarsest arc, 45 degrees, as a parabola: 7.8e-4 of its sector, less for the finer rim";
  EXPECT_TRUE(near(body.volume(), eighth * (0.725 * 0.725 * 0.7 + 0.475 * 0.475 * 0.95), within(5e-4, chord)));
  EXPECT_TRUE(near(body.face_weights("neck").sum(), 2 * eighth * 0.475 * 0.95, within(5e-4, chord)));
  EXPECT_TRUE(near(body.face_weights("barrel").sum() + body.face_weights("contact").sum(),
                   2 * eighth * 0.725 * 0.7, within(5e-4, chord)));
  EXPECT_TRUE(near(body.face_weights("contact").sum(), 0.7 * mesh.contact_half_width, within(1e-5, "flat patch")));
  EXPECT_TRUE(
      near(body.face_weights("shoulder").sum(), eighth * (0.725 * 0.725 - 0.475 * 0.475), within(8e-4, chord)));
  EXPECT_GT(mesh.smallest_jacobian, 0.2);
  for (const int node : body.group("contact"))
    EXPECT_TRUE(near(std::hypot(body.nodes()(node, 0), body.nodes()(node, 1)), 0.725,
                     within(1e-9, "nodes of the contact lie on the true cylinder")));
}

TEST(RollMesh, StiffnessKnowsRigidMotionAndUniformStrain)
{
  const auto mesh = mesh_of(backup, coarse());
  const fem::ElasticBody body(mesh, steel, 2);
  const auto K  = body.stiffness().selfadjointView<Eigen::Upper>();
  const auto &p = body.nodes();
  const int n   = int(p.rows());
  Eigen::VectorXd rigid(3 * n), stretch(3 * n);
  for (int i = 0; i < n; ++i) {
    rigid.segment<3>(3 * i) =
        Eigen::Vector3d(0.3 - 0.2 * p(i, 1), 0.1 + 0.2 * p(i, 0) - 0.4 * p(i, 2), 0.4 * p(i, 1));
    stretch.segment<3>(3 * i) = Eigen::Vector3d(-0.28 * p(i, 0), -0.28 * p(i, 1), p(i, 2));
  }
  const Eigen::VectorXd force = K * stretch;
  EXPECT_LT((K * rigid).norm(), 1e-9 * force.norm()) << "translations and rotations carry no load";
  // Uniaxial stress E along z: energy E/2 per volume, and no traction on the barrel.
  EXPECT_TRUE(near(stretch.dot(force), steel.youngs_modulus * body.volume(), within(1e-10, "patch test: exact")));
  double end = 0;
  for (const char *group : {"end", "shoulder"})
    end += body.face_weights(group).sum();
  double pull = 0;
  for (const int node : body.group("symmetry.z"))
    pull -= force[3 * node + 2];
  EXPECT_TRUE(near(pull, steel.youngs_modulus * end, within(1e-9, "equilibrium, same quadrature on both sides")));
}

TEST(RollMesh, MirrorOfTheContactLineIsTheShorterBarrel)
{
  RollGeometry longer        = backup;
  longer.half_length         = 0.9;
  longer.contact_half_length = 0.7;
  const auto mesh            = mesh_of(longer, coarse());
  const fem::ElasticBody body(mesh, steel, 2);
  double reach = 0;
  for (const int node : body.group("contact"))
    reach = std::max(reach, body.nodes()(node, 2));
  EXPECT_TRUE(near(reach, 0.7, within(1e-12, "patch ends where the other barrel ends")));
  EXPECT_TRUE(near(body.volume(), M_PI / 4 * (0.725 * 0.725 * 0.9 + 0.475 * 0.475 * 0.95),
                   within(5e-4, "arcs of 45 degrees as parabolas")));
}

TEST(RollMesh, NecksOfAnyUsualSizeAreMeshed)
{
  for (const double ratio : {0.3, 0.5, 0.66, 0.76, 0.82, 0.88, 0.93}) {
    RollGeometry g  = backup;
    g.neck_radius   = ratio * g.radius;
    const auto mesh = mesh_of(g, coarse());
    EXPECT_GT(mesh.smallest_jacobian, 0.05) << "neck/barrel " << ratio;
    const fem::ElasticBody body(mesh, steel, 2);
    const double exact = M_PI / 4 * (g.radius * g.radius * 0.7 + g.neck_radius * g.neck_radius * 0.95);
    EXPECT_TRUE(near(body.volume(), exact, within(1e-3, "arcs of up to 45 degrees as parabolas")));
    EXPECT_NO_THROW(fem::condense(body, g, {})) << "neck/barrel " << ratio;
  }
}

TEST(RollMesh, ImpossibleSectionNamesTheRoll)
{
  RollGeometry tight = backup;
  tight.neck_radius  = 0.7249;  // no room between neck and barrel for the refined box
  try {
    mesh_of(tight, coarse());
    FAIL() << "an inverted mesh went through";
  } catch (const SolverError &e) {
    EXPECT_NE(e.report.what.find("backup roll"), std::string::npos);
  }
}

// The disk is full after 20 kB: Gmsh says nothing, the mesh is refused, and nothing is left behind.
TEST(RollMesh, AMeshThatDoesNotArriveIsRefused)
{
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("millstand-full-" + std::to_string(getpid()))).string();
  std::filesystem::create_directories(folder);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{20000, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &full);
  std::string message;
  try {
    meshes::mesh_roll("backup roll", backup, coarse(), folder + "/roll.msh");
  } catch (const InputError &e) {
    message = e.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}

TEST(RollMesh, EveryLineOfNodesAndElementsIsMissed)
{
  const auto mesh         = mesh_of(backup, coarse());
  const std::string whole = read_text(mesh.path);
  EXPECT_EQ(meshes::missing_of_mesh(whole), "");
  EXPECT_NE(meshes::missing_of_mesh(""), "");
  for (const double cut : {0.01, 0.3, 0.6, 0.95, 0.9999})
    EXPECT_NE(meshes::missing_of_mesh(whole.substr(0, std::size_t(cut * double(whole.size())))), "") << cut;
  // What a disk that was full for a moment swallows: a block of 4 kB in the middle.
  const auto nodes = whole.find("$Nodes"), elements = whole.find("$Elements");
  for (const auto state : {nodes + 9000, elements + 9000})
    EXPECT_NE(meshes::missing_of_mesh(std::string(whole).erase(state, 4096)), "") << state;
}
