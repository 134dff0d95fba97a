#include "fem/bearing/chock_flexibility.h"
#include "fem/bearing/ring_flexibility.h"
#include "fem/body/harmonic_body.h"
#include "meshes/bearing/bearing_rings.h"
#include "meshes/bearing/chock.h"
#include "reduce/bearing/ring_sections.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>
#include <utility>

using namespace mill;

namespace {
constexpr double mm = 1e-3;

RollerBearing mill_bearing(const ChockForm chock, const std::string &hands)
{
  RollerBearing b       = demo_bearing();
  b.rows                = int(hands.size());
  b.width               = 57.547 * mm * b.rows;
  b.arrangement         = hands;
  b.chock               = chock;
  b.chock_width         = 600 * mm;
  b.chock_height        = 560 * mm;
  b.chock_length        = b.width + 30 * mm;
  b.chock_support_width = 300 * mm;
  return b;
}

std::string scratch(const std::string &name)
{
  return "millstand-rings-" + std::to_string(::getpid()) + "-" + name;
}
const std::string folder = std::filesystem::temp_directory_path().string();

struct Scratch {
  Scratch(const RingSections &sections, const meshes::RingMeshSize &size, const std::string &name)
      : meshes(meshes::mesh_rings(sections, size, folder, scratch(name)))
  {
  }
  ~Scratch()
  {
    meshes::remove_meshes(meshes);
  }
  RingMeshes meshes;
};

fem::RingResult result(const RingSections &sections, const meshes::RingMeshSize &size,
                       const fem::RingOptions &options)
{
  const Scratch made(sections, size, "result");
  return fem::ring_flexibility(sections, made.meshes, nullptr, options);
}

// P_a(x) of a mirrored row is (-1)^a P_a(x).
double mirror(const int a, const int b)
{
  return (a + b) % 2 == 0 ? 1 : -1;
}
}  // namespace

TEST(BearingRings, BlockLessBoreAndCupFillTheSpaceTheyShould)
{
  const auto sections = bearing::ring_sections(mill_bearing(ChockForm::block, "+-+-"));
  const Scratch made(sections, {0.5, 1}, "block");
  const auto &h       = sections.housing;
  const double length = 2 * h.half_length;
  const double round =
      fem::SectionBody(made.meshes.chock_section, sections.material, 2, fem::Section::axisymmetric).measure();
  const double whole = round + (h.width * h.height - M_PI * h.radius * h.radius) * length;
  EXPECT_TRUE(made.meshes.chock_halved);
  // A quarter.  13 degrees per quadratic element: the area of an arc to 1e-5, the bore is a third of the block.
  EXPECT_TRUE(near(
      4 * fem::ElasticBody(made.meshes.chock, sections.material, 2).volume() / whole, 1,
      within(1e-5,
             "13 degrees per quadratic element: the area of an arc to 1e-5, the bore is a third of the block")));
}

TEST(BearingRings, MirroredRowsGiveMirroredFlexibilities)
{
  fem::RingOptions options;
  options.last_harmonic   = 12;
  options.chock_harmonics = 4;
  const auto r =
      result(bearing::ring_sections(mill_bearing(ChockForm::block, "+-+-")), {0.4, 0.6}, options).flexibility;
  ASSERT_EQ(r.rows, 4);
  ASSERT_EQ(r.modes, 3);
  ASSERT_EQ(r.chock_cosine.rows(), 4 * 12);
  ASSERT_EQ(r.chock_sine.rows(), 3 * 12);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      for (const auto &[row, other] : {std::pair{0, 3}, std::pair{1, 2}}) {
        const auto value_at = [&](const Eigen::MatrixXd &C, const int k) { return C(3 * k + a, 3 * k + b); };
        EXPECT_TRUE(
            near(value_at(r.inner[2], row), mirror(a, b) * value_at(r.inner[2], other),
                 within_absolute(1e-9 * r.inner[2].norm(), "mirrored meshes: the same numbers in another order")));
        EXPECT_TRUE(
            near(value_at(r.outer[8], row), mirror(a, b) * value_at(r.outer[8], other),
                 within_absolute(1e-9 * r.outer[8].norm(), "mirrored meshes: the same numbers in another order")));
        EXPECT_TRUE(near(
            value_at(r.chock_cosine, row), mirror(a, b) * value_at(r.chock_cosine, other),
            within_absolute(1e-9 * r.chock_cosine.norm(), "mirrored meshes: the same numbers in another order")));
      }
    }
  EXPECT_LT((r.chock_cosine - r.chock_cosine.transpose()).norm(), 1e-9 * r.chock_cosine.norm());
  EXPECT_LT((r.inner[1] - r.inner[1].transpose()).norm(), 1e-9 * r.inner[1].norm());
  for (int m = 0; m < 4; ++m)
    EXPECT_EQ(r.outer[std::size_t(m)].norm(), 0) << "the block has these";
  EXPECT_GT(r.outer[4].norm(), 0);
}

// Rows of one hand have no mid-plane: the whole block is meshed.
TEST(BearingRings, AWholeRoundBlockIsItsMeridianSection)
{
  const auto sections   = bearing::ring_sections(mill_bearing(ChockForm::round, "++"));
  auto as_block         = sections;
  as_block.housing.kind = ChockForm::block;
  const Scratch lines(as_block, {0.4, 0.8}, "lines");
  EXPECT_FALSE(lines.meshes.chock_halved);
  const std::string path = folder + "/" + scratch("whole.msh");
  const MeshFile mesh    = meshes::mesh_chock(sections.cup, sections.housing, 0.8, path);
  const auto solid       = fem::chock_flexibility(sections.cup, mesh, false, sections.material, 3, 2);
  std::filesystem::remove(path);
  const fem::SectionBody body(lines.meshes.chock_section, sections.material, 2, fem::Section::axisymmetric);
  const fem::HarmonicBody harmonic(body);
  Eigen::MatrixXd loads(harmonic.n_unknowns(), 4);
  for (int r = 0; r < 2; ++r)
    loads.middleCols(2 * r, 2) = fem::raceway_loads(
        body, "raceway." + std::to_string(r), sections.cup.raceways[std::size_t(r)], sections.cup.length, 2, 1);
  for (int m = 0; m < 3; ++m) {
    const Eigen::MatrixXd C = harmonic.flexibility(m, loads);
    // 16 degrees per quadratic element, waves of 180 and more.
    EXPECT_LT((solid.cosine.block(4 * m, 4 * m, 4, 4) - C).norm(), 1e-3 * C.norm()) << m;
    if (m > 0)
      EXPECT_LT((solid.sine.block(4 * m - 4, 4 * m - 4, 4, 4) - C).norm(), 1e-3 * C.norm()) << m;
  }
}

TEST(BearingRings, ACupHeldOnItsOutsideAddsLittleToItsRaceway)
{
  fem::RingOptions options;
  options.last_harmonic = 20;
  const auto rigid      = result(bearing::ring_sections(mill_bearing(ChockForm::rigid, "+-")), {0.6, 1}, options);
  const auto round      = result(bearing::ring_sections(mill_bearing(ChockForm::round, "+-")), {0.6, 1}, options);
  EXPECT_EQ(rigid.flexibility.chock_harmonics, 0);
  // Wall and held raceway are the same thickness in the middle, not at the ends.
  EXPECT_LT(std::abs(rigid.flexibility.outer[2](0, 0)), 0.05 * round.flexibility.outer[2](0, 0));
  EXPECT_LT(round.indefinite, 1e-3);
  EXPECT_GT(round.indefinite, -1e-2);
  ASSERT_FALSE(round.notes.empty());
  EXPECT_NE(round.notes[1].find("fit without clearance"), std::string::npos);
}

TEST(BearingRings, TheCoarserMeshGivesTheErrorEstimate)
{
  const auto sections = bearing::ring_sections(mill_bearing(ChockForm::round, "+-"));
  const meshes::RingMeshSize size;
  const Scratch fine(sections, size, "fine"), coarse(sections, meshes::coarsened(size), "coarse");
  fem::RingOptions options;
  options.last_harmonic = 30;
  const auto r          = fem::ring_flexibility(sections, fine.meshes, &coarse.meshes, options);
  EXPECT_GT(r.error_estimate, 1e-5);
  EXPECT_LT(r.error_estimate, 1e-2);
}

TEST(StribeckFlexibility, OfOneHarmonicIsThatHarmonic)
{
  bearing::RingFlexibility rings;
  rings.rows  = 1;
  rings.modes = 1;
  rings.inner.assign(2, Eigen::MatrixXd::Zero(1, 1));
  rings.inner[1](0, 0) = 3e-12;  // the load's first harmonic is the resultant
  EXPECT_TRUE(near(
      fem::stribeck_flexibility(rings, 39), 3e-12,
      within_absolute(1e-24, "the first harmonic of the load is the resultant: the number itself, rounding")));
}

TEST(ChockPicture, IsWritten)
{
  const auto sections = bearing::ring_sections(mill_bearing(ChockForm::block, "+-"));
  const Scratch made(sections, {0.4, 0.6}, "picture");
  const std::string path = folder + "/" + scratch("chock.vtu");
  fem::write_chock_vtu(path, sections.cup, made.meshes.chock, made.meshes.chock_halved, sections.material,
                       Eigen::MatrixXd::Constant(2, 39, 1e4));
  EXPECT_GT(std::filesystem::file_size(path), 10000u);
  std::filesystem::remove(path);
}
