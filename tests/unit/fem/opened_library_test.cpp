// millstand-fem.so as the program has it: opened and not linked.  What the other tests compute with the linked one
// comes out of this one too, and errors pass through it.
#include "core/base/errors.h"
#include "fem/body/on_mesh.h"
#include "meshes/common/block.h"
#include "meshes/common/mesher.h"
#include "meshes/common/write_mesh.h"
#include "tests/support/near.h"
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace mill;

namespace {
template <class Table> const Table &opened(const char *name)
{
  void *const library = dlopen(FEM_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  EXPECT_NE(library, nullptr) << dlerror();
  return *reinterpret_cast<const Table *(*)()>(dlsym(library, name))();
}

const fem::OnMesh &opened_fem()
{
  return opened<fem::OnMesh>("millstand_on_mesh");
}

MeshFile brick()
{
  meshes::BlockGrid grid;
  grid.x = grid.y = meshes::even_lines(0, 1, 2);
  grid.z          = meshes::even_lines(0, 2, 2);
  return meshes::mesh_block(
      grid, (std::filesystem::temp_directory_path() / "millstand-opened-library-test.msh").string());
}

meshes::PlainMesh plain_square()
{
  meshes::PlainMesh square;
  square.dimension          = 2;
  square.coordinates        = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  square.cells              = {1, 2, 3, 4};
  square.group_faces["top"] = {3, 4};
  square.groups["top"]      = 1;
  return square;
}

const Material steel{210e9, 0.3, 7850};

template <class Error> void expect_passes(const fem::SolidOnMesh &solid, const Error &error)
{
  std::string seen;
  try {
    solid.each_cell([&](const std::vector<int> &, const std::vector<fem::SolidPoint> &) { throw error; });
  } catch (const Error &caught) {
    seen = caught.what();
  }
  EXPECT_EQ(seen, error.what());
}
}  // namespace

TEST(OpenedLibrary, ComputesWhatTheLinkedOneComputes)
{
  const MeshFile mesh = brick();
  ASSERT_NE(&opened_fem(), &fem::on_mesh());
  const auto there = opened_fem().solid(mesh, steel, 2), here = fem::on_mesh().solid(mesh, steel, 2);
  EXPECT_EQ(there.nodes, here.nodes);
  EXPECT_EQ(there.groups, here.groups);
  EXPECT_EQ(there.faces("patch"), here.faces("patch"));
  const auto K = there.unit_stiffness(), also = here.unit_stiffness();
  EXPECT_TRUE(near(K.volume, 2, within(5e-13, "rounding of the sum over eight cells of the brick")));
  EXPECT_LT((K.matrix - also.matrix).norm(), 1e-14 * also.matrix.norm()) << "order of the sums over cells";
}

TEST(OpenedLibrary, WritesTheMeshThatTheLinkedOneWrites)
{
  const meshes::PlainMesh square = plain_square();
  const auto folder              = std::filesystem::temp_directory_path();
  const auto text                = [&](const meshes::Mesher &mesher, const std::string &name) {
    std::string out, path = (folder / name).string();
    meshes::write_mesh(path, [&](const std::string &aside) { return mesher.write_plain(square, aside); });
    std::ifstream in(path);
    std::getline(in, out, '\0');
    return out;
  };
  const std::string there = text(opened<meshes::Mesher>("millstand_mesher"), "millstand-opened-there.msh");
  EXPECT_NE(there.find("\"top\""), std::string::npos) << there;
  EXPECT_EQ(there, text(meshes::mesher(), "millstand-opened-here.msh"));
}

// Gmsh's initialisation makes FLTK write preferences; the library holds a definition that does not.
TEST(OpenedLibrary, WritesNothingIntoTheHomeFolder)
{
  const auto home          = std::filesystem::temp_directory_path() / "millstand-empty-home";
  const char *given        = std::getenv("HOME");
  const std::string before = given ? given : "";
  std::filesystem::remove_all(home);
  std::filesystem::create_directories(home);
  setenv("HOME", home.c_str(), 1);
  brick();
  opened<meshes::Mesher>("millstand_mesher").write_plain(plain_square(), (home.string() + "-square.msh"));
  setenv("HOME", before.c_str(), 1);
  EXPECT_TRUE(std::filesystem::exists(home.string() + "-square.msh"));
  EXPECT_TRUE(std::filesystem::is_empty(home));
}

TEST(OpenedLibrary, HoldsTheDefinitionThatTakesThePlaceOfFltks)
{
  void *const symbol = dlsym(dlopen(FEM_LIBRARY, RTLD_LAZY | RTLD_LOCAL), "_ZN2Fl6optionENS_9Fl_OptionEb");
  Dl_info place;
  ASSERT_NE(dladdr(symbol, &place), 0);
  EXPECT_EQ(std::filesystem::path(place.dli_fname).filename(), std::filesystem::path(FEM_LIBRARY).filename());
}

TEST(OpenedLibrary, ErrorsOfTheProgramPassThroughIt)
{
  const auto solid = opened_fem().solid(brick(), steel, 1);
  expect_passes(solid, SystemError("the disk is full"));
  expect_passes(solid, InputError("a wrong key"));
  expect_passes(solid, SolverError({"no convergence", "", "", "", ""}));
  expect_passes(solid, std::bad_alloc());
  EXPECT_THROW(solid.faces("no such group"), std::out_of_range);
}
