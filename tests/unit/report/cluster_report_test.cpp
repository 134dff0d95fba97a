#include "core/base/files.h"
#include "core/records/cluster_names.h"
#include "core/records/json_archive.h"
#include "report/cluster/figures.h"
#include "report/results/names.h"
#include <filesystem>
#include <gtest/gtest.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
ClusterRecord two_rolls()
{
  ClusterRecord r;
  r.strip    = "W";
  r.rolls    = {{"W", 0, 0.1, 0.1, 20}, {"B", 0, 0.4, 0.2, 80}};
  r.contacts = {{"W-B", 0, 1, "power"}};
  r.supports = {{"B", "radial", 1, true}};
  ClusterPassRecord pass;
  pass.name         = "pass <1>";
  pass.force        = 1e6;
  pass.force_source = "given";
  pass.displacement = Eigen::Vector4d(0, 1e-4, 0, 5e-5);
  pass.contacts     = {{"W-B", 9.998e5, 7e-5, 1.7e10, 1.5e10}};
  pass.supports     = {{"B", 9.99e5, 1e-4, 1e10, 9e9}};
  pass.least_root   = 1e6;
  ClusterModeRecord mode;
  mode.frequency = 621;
  mode.label     = "B y on B";
  mode.identity  = "B vertical";
  mode.shape     = Eigen::Vector4d(0, 1, 0, 0.9);
  mode.elastic   = {{"W-B", 0.1}, {"B", 0.9}};
  mode.kinetic   = {{"W y", 0.2}, {"B y", 0.8}};
  pass.modes     = {mode};
  r.passes       = {pass};
  r.published    = {{"B vertical", "B y", 627.21}};
  ClusterFitRecord fit;
  fit.variant     = "N";
  fit.numbers     = {{"support.B.stiffness", 1e10, 1.02e10, not_given}};
  fit.frequencies = {{"B vertical", 627.21, 627.21, true}};
  fit.rms_fitted  = 0;
  r.fits          = {fit};
  return r;
}
}  // namespace

TEST(ClusterReport, RecordComesBackFromItsFile)
{
  const fs::path folder = fs::path(testing::TempDir()) / "millstand-cluster-report";
  fs::create_directories(folder / "curves");
  write_atomically((folder / cluster_file).string(), json_of_record(two_rolls()));
  const report::ClusterData data = report::read_cluster_record(folder.string());
  ASSERT_TRUE(data.record) << data.problem;
  EXPECT_EQ(json_of_record(*data.record), json_of_record(two_rolls()));
  write_atomically((folder / cluster_file).string(), "[1, 2");
  EXPECT_FALSE(report::read_cluster_record(folder.string()).record);
  EXPECT_NE(report::read_cluster_record(folder.string()).problem, "");
  fs::remove_all(folder);
  EXPECT_EQ(report::read_cluster_record(folder.string()).problem, "") << "another kind stores none";
}

TEST(ClusterReport, ShowsForcesPublishedFrequenciesAndWhatWasFitted)
{
  const ClusterRecord r     = two_rolls();
  const std::string drawing = report::stack_drawing(r, r.passes[0]);
  EXPECT_NE(drawing.find("999.8 kN"), std::string::npos) << drawing;
  EXPECT_NE(drawing.find("fitted"), std::string::npos);
  EXPECT_EQ(drawing.find("pass <1>"), std::string::npos) << "names are escaped";
  const std::string table = report::frequency_table(r);
  EXPECT_NE(table.find("621.0"), std::string::npos) << table;
  EXPECT_NE(table.find("627.2"), std::string::npos) << table;
  EXPECT_NE(report::moving_modes(r, r.passes[0]).find("animateTransform"), std::string::npos);
  EXPECT_NE(report::cluster_fit_table(r).find("no interval"), std::string::npos);
  EXPECT_NE(report::cluster_fit_table(r).find("1 / 1"), std::string::npos);
}

TEST(ClusterReport, ARecordWithGapsIsNotDrawn)
{
  ClusterRecord r = two_rolls();
  r.contacts[0].b = 7;
  EXPECT_EQ(report::stack_drawing(r, r.passes[0]), "");
  r = two_rolls();
  r.rolls.clear();
  EXPECT_EQ(report::stack_drawing(r, r.passes[0]), "");
  EXPECT_EQ(report::moving_modes(r, r.passes[0]), "") << "shapes of other rolls";
}

TEST(ClusterReport, ResultsHaveWords)
{
  EXPECT_EQ(report::meaning_of("cluster.pass 1.f3"), "pass 1, natural frequency 3");
  EXPECT_EQ(report::meaning_of("cluster.pass 1.W-I.force"), "pass 1, contact W-I, force");
  EXPECT_EQ(report::meaning_of("cluster.fit.N.support.E.stiffness"), "fitted in variant N, support.E.stiffness");
}
