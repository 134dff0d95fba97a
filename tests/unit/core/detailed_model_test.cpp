// A stand of any number of unknowns on disk: what is written comes back, what does not fit is refused.
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "core/records/detailed_model.h"
#include "core/records/matrix_market.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
constexpr int n = 7;

StandModel sample()
{
  StandModel s;
  s.name    = "craig-bampton";
  s.M       = Eigen::MatrixXd::Identity(n, n) * 3;
  s.M(1, 2) = s.M(2, 1) = 0.25;
  s.K_parts             = Eigen::MatrixXd::Identity(n, n) / 7;
  s.K_parts(0, 6) = s.K_parts(6, 0) = -1e-3;
  s.b                               = Eigen::VectorXd::Unit(n, 2) - Eigen::VectorXd::Unit(n, 3);
  s.parts                           = {"upper frame", "upper work roll, bent"};
  s.part_of                         = {0, 1, 1, 1, 1, 1, 1};
  for (int i = 0; i < n - 1; ++i)
    s.unknowns.push_back({i == 1 ? "barrel P2" : "node", i == 1 ? std::nan("") : i / 3., "m"});
  s.unknowns.push_back({"fixed-interface mode 1", std::nan(""), "kg^0.5 m"});
  s.load_cell = Eigen::VectorXd::LinSpaced(n, -1, 1);
  for (const char *place : {"upper frame", "upper backup roll", "upper work roll", "lower work roll",
                            "lower backup roll", "lower frame", "housing, screw"})
    s.points.push_back({place, Eigen::VectorXd::LinSpaced(n, 0.1 * double(s.points.size()), 1. / 3)});
  return s;
}

class DetailedModels : public testing::Test {
protected:
  const fs::path folder = fs::temp_directory_path() / ("millstand_detailed_" + std::to_string(::getpid()));
  ModelFiles files;
  void SetUp() override
  {
    fs::create_directories(folder);
    const StandModel s = sample();
    files.name         = s.name;
    files.mass         = write("mass.mtx", matrix_market_text(s.M, "M"));
    files.stiffness    = write("stiffness.mtx", matrix_market_text(s.K_parts, "K"));
    files.force        = write("force.mtx", matrix_market_text(s.b, "b"));
    files.readings     = write("readings.mtx", matrix_market_text(readings_of(s), "P"));
    files.names        = write("names.csv", model_names_csv(s));
  }
  void TearDown() override
  {
    fs::remove_all(folder);
  }
  std::string write(const std::string &name, const std::string &text) const
  {
    write_atomically((folder / name).string(), text);
    return (folder / name).string();
  }
  std::string refused() const
  {
    try {
      detailed_model_of(files);
    } catch (const InputError &e) {
      return fs::path(e.problems.front().place.file).filename().string() + ": " + e.problems.front().message;
    }
    return "accepted";
  }
};
}  // namespace

TEST_F(DetailedModels, DetailedModelsComeBackUnchanged)
{
  const StandModel s = sample(), back = detailed_model_of(files);
  EXPECT_EQ(back.name, s.name);
  EXPECT_EQ(back.M, s.M);
  EXPECT_EQ(back.K_parts, s.K_parts);
  EXPECT_EQ(back.b, s.b);
  EXPECT_EQ(back.load_cell, s.load_cell);
  EXPECT_EQ(back.parts, s.parts);
  EXPECT_EQ(back.part_of, s.part_of);
  EXPECT_EQ(back.unknowns, s.unknowns);
  ASSERT_EQ(back.points.size(), s.points.size());
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    EXPECT_EQ(back.points[i].name, s.points[i].name);
    EXPECT_EQ(back.points[i].row, s.points[i].row);
  }
}

TEST_F(DetailedModels, TheCaseThatNamesThemIsReadBack)
{
  const Case origin     = read_case(write("chain.toml", template_of("lumped")), {"dynamics.modal_damping=2 %"});
  files.frequency_limit = 800;
  files.gap_damper      = 1.5e5;
  files.modes           = {{1, 37.8}, {2, 1000. / 3}};
  for (std::string *path : {&files.mass, &files.stiffness, &files.force, &files.readings, &files.names})
    *path = fs::path(*path).filename().string();
  const Case back    = read_case(write("detailed.toml", detailed_model_toml(files, origin, folder.string())));
  const auto &lumped = std::get<Lumped>(back.spec);
  EXPECT_TRUE(lumped.detailed);
  EXPECT_TRUE(lumped.given.empty());
  EXPECT_EQ(lumped.model.name, "craig-bampton");
  EXPECT_TRUE(fs::equivalent(lumped.model.stiffness, folder / "stiffness.mtx"));
  EXPECT_EQ(lumped.model.frequency_limit, 800);
  EXPECT_EQ(lumped.model.gap_damper, 1.5e5);
  EXPECT_EQ(lumped.model.modes, files.modes);
  EXPECT_EQ(lumped.dynamics.modal_damping, 0.02);
  EXPECT_EQ(lumped.passes.size(), std::get<Lumped>(origin.spec).passes.size());
  EXPECT_EQ(detailed_model_of(lumped.model).M, sample().M);
}

TEST_F(DetailedModels, ChainAndFilesExcludeEachOther)
{
  std::string text = template_of("lumped");
  text += "\n[model]\nmass = \"mass.mtx\"\nstiffness = \"stiffness.mtx\"\nforce = \"force.mtx\"\nreadings = "
          "\"readings.mtx\"\nnames = \"names.csv\"\n";
  try {
    read_case(write("both.toml", text));
    ADD_FAILURE() << "two models of one stand";
  } catch (const InputError &e) {
    EXPECT_EQ(e.problems.front().message,
              "[given] holds the masses and springs of a chain, and [model] another model "
              "of the stand; leave one of the two out");
  }
}

TEST_F(DetailedModels, FilesThatDoNotAgreeAreRefused)
{
  const StandModel s = sample();
  Eigen::MatrixXd M  = s.M;
  M(0, 1)            = 1;
  write("mass.mtx", matrix_market_text(M, "M"));
  EXPECT_EQ(refused(), "mass.mtx: is not symmetric; mass and stiffness of a stand are");
  write("mass.mtx", matrix_market_text(s.M, "M"));
  write("stiffness.mtx", matrix_market_text(Eigen::MatrixXd::Identity(3, 3), "K"));
  EXPECT_EQ(refused(), "stiffness.mtx: has 3 rows and 3 columns; 7 rows and 7 columns are needed");
  write("stiffness.mtx", matrix_market_text(s.K_parts, "K"));
  write("readings.mtx", matrix_market_text(readings_of(s).topRows(6), "P"));
  EXPECT_EQ(refused(), "readings.mtx: has 6 rows; the six places of M1 to M6 and the load cell are needed");
  write("readings.mtx", matrix_market_text(readings_of(s).topRows(7), "P"));
  EXPECT_EQ(refused(), "names.csv: names reading 8 of 7");
  write("readings.mtx", matrix_market_text(readings_of(s), "P"));
  write("names.csv", "of,number,name,coordinate,position [m],direction,unit\nunknown,1,roll,node,0.1,y,m\n");
  EXPECT_EQ(refused(), "names.csv: names 1 unknowns and 0 readings; the matrices have 7 and 8");
  write("names.csv", "of,number,name,coordinate,position [m],direction,unit\nnode,1,roll,node,0.1,y,m\n");
  EXPECT_EQ(refused(), "names.csv: \"node\" is neither \"unknown\" nor \"reading\"");
}

namespace {
/// The sample with a pair of springs between its parts and one to the ground.
StandModel joined_sample()
{
  StandModel s = sample();
  s.K_parts    = Eigen::MatrixXd::Identity(n, n) / 7;  // what couples the parts is a connection
  s.M(1, 2) = s.M(2, 1) = 0;
  Connection pair{"K3", Eigen::MatrixXd::Zero(2, n), Eigen::Vector2d(1. / 3, 0.5), 0.07},
      foot{"Kzc, lower", Eigen::RowVectorXd::Unit(n, 4), Eigen::VectorXd::Constant(1, 1. / 9)};
  pair.rows(0, 0) = pair.rows(1, 0) = 1;
  pair.rows(0, 3) = pair.rows(1, 5) = -1;
  s.connections                     = {pair, foot};
  return s;
}
}  // namespace

TEST_F(DetailedModels, ConnectionsComeBackAndLeaveTheParts)
{
  const StandModel s = joined_sample();
  files              = named_files(s, folder.string());
  for (const auto &[path, text] : texts_of(s, files))
    write_atomically(path, text);
  const StandModel back = detailed_model_of(files);
  ASSERT_EQ(back.connections.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(back.connections[c].name, s.connections[c].name);
    EXPECT_EQ(back.connections[c].rows, s.connections[c].rows);
    EXPECT_EQ(back.connections[c].stiffness, s.connections[c].stiffness);
  }
  EXPECT_EQ(back.connections[0].error_estimate, 0.07);
  EXPECT_TRUE(std::isnan(back.connections[1].error_estimate));
  EXPECT_LT((back.K_parts - s.K_parts).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(stiffness_of(back).rows(), n);
  EXPECT_LT((stiffness_of(back) - stiffness_of(s)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_F(DetailedModels, ConnectionsThatDoNotFitAreRefused)
{
  const StandModel s = joined_sample();
  files              = named_files(s, folder.string());
  for (const auto &[path, text] : texts_of(s, files))
    write_atomically(path, text);
  const auto with_rows = [&](const std::string &rows) {
    write_atomically(files.connections, "connection,stiffness [N/m],error_estimate\n" + rows);
    return refused();
  };
  const std::string K3 = "K3,0.333,0.07\n", foot = "\"Kzc, lower\",0.111,\n";
  EXPECT_EQ(with_rows(K3 + foot),
            "craig-bampton-strains.mtx: has 3 rows and 7 columns; 2 rows and 7 columns are needed");
  EXPECT_EQ(with_rows(K3 + foot + K3),
            "craig-bampton-connections.csv: \"K3\" appears in two places; its springs must be consecutive");
  EXPECT_EQ(with_rows(K3 + "K3,-1,0.07\n" + foot),
            "craig-bampton-connections.csv: stiffness -1 N/m: must not be negative");
  EXPECT_EQ(
      with_rows(K3 + "K3,0.9,0.07\n" + foot),
      "craig-bampton-connections.csv: without these springs unknowns 1 and 4 of two parts are still joined in " +
          files.stiffness + ": they are not those of this model");
}

TEST_F(DetailedModels, ConnectionsAndStrainsBelongTogether)
{
  const Case origin = read_case(write("chain.toml", template_of("lumped")));
  files             = named_files(joined_sample(), "models");
  files.strains.clear();
  try {
    read_case(write("half.toml", detailed_model_toml(files, origin, folder.string())));
    ADD_FAILURE() << "springs without rows";
  } catch (const InputError &e) {
    EXPECT_EQ(e.problems.back().message, "model.connections and model.strains belong together; give both or none");
  }
}
