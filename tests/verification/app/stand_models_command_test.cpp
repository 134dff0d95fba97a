#include "core/base/files.h"
#include "core/records/csv.h"
#include "core/records/matrix_market.h"
#include "tests/support/near.h"
#include "tests/support/quick_stand.h"
#include "tests/support/run_results.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>

// Models of the stand as a user meets them: what they drive, their names of modes, their files.
namespace fs = std::filesystem;
using namespace quick_stand;

TEST(ModelsLong, EachDrivesTheStandAndMakesAChainThatRuns)
{
  for (const std::string model : {"six-mass", "beam", "craig-bampton"}) {
    const auto outcome = run("simulate", demo, model, "--set dynamics.model=" + model);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string table = mill::read_text(scratch(model) + "/response/pass-1.csv");
    EXPECT_EQ(table.find("lower_work_roll_chock [g]") != std::string::npos, model != "six-mass") << model;
  }
  // Six masses lack modes that the force excites, and the run says so: among the assumptions where the force is
  // made, as a warning where it is measured; the others have them.
  const auto assumes = [](const std::string &model) {
    return json_of(scratch(model) + "/results.json").at("assumptions").dump().find("no counterpart") !=
           std::string::npos;
  };
  const auto warns = [](const std::string &model) {
    return !warning_with(json_of(scratch(model) + "/results.json"), "mode-not-in-chain").is_null();
  };
  EXPECT_TRUE(assumes("six-mass"));
  EXPECT_FALSE(warns("six-mass"));
  ASSERT_EQ(run("simulate", demo, "measured", "--set pass.0.synthetic=false").exit_code, 0);
  EXPECT_TRUE(warns("measured"));
  EXPECT_FALSE(assumes("craig-bampton") || warns("craig-bampton"));
  // The two stand modes are all but the same in beams and finite elements; the chain has them 3 % too high.
  for (const std::string mode : {"f1", "f2"}) {
    const double fe = quick_value("craig-bampton", "craig-bampton." + mode);
    EXPECT_TRUE(near(quick_value("craig-bampton", "beam." + mode), fe, within(3e-3, "the rolls hardly bend")));
    EXPECT_TRUE(near(quick_value("craig-bampton", "open." + mode) /
                         quick_value("craig-bampton", "open.craig-bampton." + mode),
                     1.03, within(0.01, "3 % in the specification, which has the open stand")));
  }
  for (const std::string file :
       {"lumped_model.toml", "lumped_model-six-of-beam.toml", "lumped_model-six-of-craig-bampton.toml"})
    EXPECT_EQ(millstand("modes " + scratch("craig-bampton") + "/" + file + " -q -o " + scratch(file)).exit_code, 0)
        << file;
}

TEST(Models, CachedRunGivesTheSameModels)
{
  ASSERT_EQ(run("masses", demo, "again").exit_code, 0);
  EXPECT_EQ(mill::read_text(demo_masses() + "/curves/models.json"),
            mill::read_text(scratch("again") + "/curves/models.json"));
}

TEST(HousingLong, DrawingReplacesTheFrame)
{
  ASSERT_EQ(run("masses", "cases/four-high-drawn.toml", "drawn",
                "--set 'frame.piston_stiffness_tolerance=1 %' --set 'frame.upper_packing_stiffness_tolerance=1 %'")
                .exit_code,
            0);
  const auto values   = json_of(scratch("drawn") + "/results.json").at("values");
  const auto value_of = [&](const std::string &name) { return values.at(name).at("value").get<double>(); };
  // K1 is the drawn posts, beam, screw, nut and piston with the given packing in series.
  EXPECT_TRUE(near(value_of("K1"),
                   1 / (1 / value_of("frame.upper_post_stiffness") + 1 / value_of("frame.upper_beam_stiffness") +
                        1 / value_of("frame.piston_stiffness") + 1 / 4.5e11),
                   within(1e-12, "series springs")));
  EXPECT_TRUE(near(value_of("M1"),
                   value_of("frame.upper_post_mass") + value_of("frame.upper_beam_mass") + 420 + 1000,
                   within(1e-12, "sum of the reduced masses")));
  EXPECT_GT(values.at("K1").at("error_estimate").get<double>(), 0);
  EXPECT_TRUE(lacks(values.at("K7"), "frame.lower_packing_stiffness_tolerance"));
  EXPECT_TRUE(lacks(values.at("frame.oil_column_stiffness"), "frame.oil_column_stiffness_tolerance"));
  EXPECT_EQ(values.at("frame.piston_stiffness").at("error_estimate"), 0.01);
  EXPECT_GT(value_of("housing.f1"), 10) << "the bare housing on its feet";
  EXPECT_GT(value_of("housing.f2"), value_of("housing.f1"));
  EXPECT_GT(values.at("housing.f1").at("error_estimate").get<double>(), 0);
  EXPECT_TRUE(fs::exists(scratch("drawn") + "/fields/housing.vtu"));
  const auto models = json_of(scratch("drawn") + "/curves/models.json");
  bool housing      = false;
  for (const auto &model : models.at("models"))
    for (const auto &part : model.at("parts"))
      housing = housing || part == "housing";
  EXPECT_TRUE(housing) << "the reduced housing is a part of the assembled stand";
}

TEST(Models, LimitAboveTheMeshesIsRefused)
{
  const auto refused = run("masses", demo, "limit", "--set 'dynamics.frequency_limit=15 kHz'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(
      refused.err.find("dynamics.frequency_limit = 15000 Hz is above what the mesh of the work roll can follow, "),
      std::string::npos)
      << refused.err;
}

TEST(Models, FrameWithoutMassIsRefused)
{
  std::string sets;
  for (const char *key : {"upper_post_mass", "upper_beam_mass", "upper_packing_mass", "piston_mass"})
    sets += std::string(" --set 'frame.") + key + "=0 kg'";
  const auto refused = millstand("check " + demo + sets);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("frame.upper_post_mass, frame.upper_beam_mass, frame.upper_packing_mass and "
                             "frame.piston_mass are all zero; M1 needs a mass: give one of them, or given.M1"),
            std::string::npos)
      << refused.err;
}

TEST(Models, LumpedCaseHasNoOtherModel)
{
  const auto refused = millstand("check cases/published-1400.toml --set dynamics.model=beam");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("unknown key 'model' in [dynamics]"), std::string::npos) << refused.err;
}

// Names of component modes, beams and six masses of one run.
TEST(ModeNames, AreEqualInAllModelsWhereShapesAndSharesAreAlike)
{
  const auto record   = json_of(demo_masses() + "/curves/models.json");
  const auto modes_of = [&](const std::string &model) {
    std::vector<nlohmann::json> modes;
    for (const auto &m : record.at("models"))
      if (m.at("name") == model)
        modes.assign(m.at("modes").begin(), m.at("modes").end());
    return modes;
  };
  const auto detailed = modes_of("craig-bampton"), beams = modes_of("beam");
  int alike       = 0;
  const auto &mac = record.at("mac").at("values");
  for (std::size_t i = 0; i < mac.size(); ++i)
    for (std::size_t k = 0; k < mac[i].size(); ++k) {
      const double ratio =
          detailed.at(i).at("gap_share").get<double>() / beams.at(k).at("gap_share").get<double>();
      if (mac[i][k].get<double>() <= 0.7 || !(ratio <= 2 && ratio >= 0.5) ||
          detailed.at(i).at("name").get<std::string>().find("higher") != std::string::npos)
        continue;
      ++alike;
      EXPECT_EQ(detailed.at(i).at("name"), beams.at(k).at("name"));
    }
  EXPECT_GE(alike, 5);
  for (const char *model : {"craig-bampton", "beam", "six-mass"}) {
    const auto modes = modes_of(model);
    double sum       = 0;
    for (const auto &mode : modes) {
      EXPECT_EQ(mode.at("name").get<std::string>().find("mixed"), std::string::npos);
      sum += mode.at("gap_share").get<double>();
    }
    EXPECT_LE(sum, 1 + 1e-9) << model;
    EXPECT_GT(sum, 0.8) << model << ": below the limit is most of what the strip sees";
  }
}

TEST(Headline, TheHeadlineComparesTheMostDetailedModelWithSixMasses)
{
  const auto shown = loud_run("modes", demo, "headline");
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_NE(
      shown.out.find("modes below 1000 Hz: rolls as reduced finite elements, compared with the six masses\n"),
      std::string::npos)
      << shown.out;
  const auto values    = json_of(scratch("headline") + "/results.json").at("values");
  const auto frequency = [&](const std::string &name) {
    return fmt::format("{:.1f}", values.at(name).at("value").get<double>());
  };
  EXPECT_NE(shown.out.find(fmt::format("{:>10} {:>9} ", frequency("mode.gap_first_kind.frequency"),
                                       frequency("open.mode.gap_first_kind.frequency"))),
            std::string::npos)
      << "rolling and open side by side:\n"
      << shown.out;
  EXPECT_NE(shown.out.find(" further modes that neither gap nor sensors see\n"), std::string::npos);
  EXPECT_NE(shown.out.find("Six masses are right to "), std::string::npos) << "what they are good for";
  const std::string page = mill::read_text(scratch("headline") + "/report.html");
  EXPECT_NE(page.find("The frequencies are those of the <b>finite elements</b>"), std::string::npos);
  EXPECT_NE(page.find("<span>gap mode, first kind"), std::string::npos) << "among the first tiles";
  EXPECT_NE(page.find("Natural frequency, rolls as reduced finite elements"), std::string::npos);
  EXPECT_NE(page.find("Natural frequency, compared with six masses"), std::string::npos);
}

// That of the component modes, with the band of the models, for a stand at 5 to 9 m/s.
TEST(StandChatter, StandChatterIsThatOfTheMostDetailedModel)
{
  const auto outcome = run("chatter", demo, "leading",
                           "--set analysis.speeds='[\"5 m/s\", \"9 m/s\"]' --set analysis.map_points=0");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto record = json_of(scratch("leading") + "/curves/chatter-pass-1.json");
  const auto &all   = record.at("structures");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].at("name"), "craig-bampton");
  EXPECT_EQ(record.at("critical").at("verdict"), all[0].at("verdict"));
  EXPECT_NE(record.at("structure").get<std::string>().find("craig-bampton model of this run"), std::string::npos);
  const std::string sentence = record.at("critical").at("sentence");
  EXPECT_NE(sentence.find("this is craig-bampton, the most detailed of 3 models of the stand"), std::string::npos)
      << sentence;
}

namespace {
Eigen::MatrixXd matrix(const std::string &name)
{
  return mill::read_matrix_market(demo_masses() + "/models/" + name + ".mtx");
}

// Without the strip between the work rolls, as the files are: the force of the demo is measured and holds the
// answer of the strip.  The results have no open state of the beams, their table of modes has it.
double open_frequency(const std::string &folder, const std::string &model, const int number)
{
  const std::string name = "f" + std::to_string(number);
  if (model == "six-mass")
    return quick_value(folder, "open." + name);
  if (model == "craig-bampton")
    return quick_value(folder, "open.craig-bampton." + name);
  const mill::Table modes = mill::read_table(scratch(folder) + "/curves/modes-" + model + "-open.csv");
  return (*modes.column("frequency"))[number - 1];
}
}  // namespace

TEST(ModelFiles, ModelFilesHoldTheModesOfTheRun)
{
  for (const std::string model : {"six-mass", "beam", "craig-bampton"}) {
    const Eigen::MatrixXd M = matrix(model + "-mass"), K = matrix(model + "-stiffness");
    EXPECT_TRUE((M - M.transpose()).isZero(0) && (K - K.transpose()).isZero(0)) << "symmetric to the last digit";
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M);  // K phi = w^2 M phi
    const std::string where = model == "six-mass" ? "demo-modes" : "demo";
    if (model == "six-mass")
      ASSERT_EQ(run("modes", demo, where).exit_code, 0);
    for (int i = 1; i <= 4; ++i)
      EXPECT_TRUE(near(std::sqrt(modes.eigenvalues()[i - 1]) / (2 * M_PI), open_frequency(where, model, i),
                       within(1e-8, "eigenvalues of a stiff pencil by another call")));
    const std::string names = mill::read_text(demo_masses() + "/models/" + model + "-names.csv");
    EXPECT_EQ(std::count(names.begin(), names.end(), '\n'), 1 + M.rows() + matrix(model + "-readings").rows());
    EXPECT_EQ(fs::exists(demo_masses() + "/models/" + model + ".mat"), model != "beam")
        << "of many unknowns if asked";
    EXPECT_EQ(fs::exists(demo_masses() + "/fields/modes-" + model + ".vtu"), model != "six-mass");
  }
  const std::string rolls = mill::read_text(demo_masses() + "/fields/modes-craig-bampton-rolls.vtu");
  for (const char *array :
       {"displacement [kg^-0.5]\" NumberOfComponents=\"3\"", "stress [Pa/(kg^0.5 m)]\" NumberOfComponents=\"9\""})
    EXPECT_NE(rolls.find(array), std::string::npos) << array;
  // One ratio of damping in every mode: V^T C V = 2 zeta w.
  const Eigen::MatrixXd M = matrix("craig-bampton-mass"), K = matrix("craig-bampton-stiffness"),
                        C = matrix("craig-bampton-damping");
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M);
  const Eigen::VectorXd v = modes.eigenvectors().col(1);
  EXPECT_TRUE(near(v.dot(C * v), 2 * 0.01 * std::sqrt(modes.eigenvalues()[1]), within(1e-6, "1 %, the default")));
}

TEST(ModelFiles, ModelFilesAreACaseThatRuns)
{
  demo_masses();
  for (const std::string model : {"beam", "craig-bampton"}) {
    const std::string file = scratch("demo") + "/lumped_model-" + model + ".toml";
    const auto outcome     = millstand("simulate " + file + " -q -o " + scratch("back-" + model) +
                                       " --set dynamics.output_rate='5 kHz'");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (int i = 1; i <= 6; ++i)
      EXPECT_TRUE(near(quick_value("back-" + model, "f" + std::to_string(i)), open_frequency("demo", model, i),
                       within(1e-8, "the same matrices by another call")));
    if (model == "beam")
      continue;
    ASSERT_EQ(run("simulate", demo, "driven", "--set dynamics.model=" + model).exit_code, 0);
    for (const char *level : {"pass 1.rms_g.upper_work_roll", "pass 1.peak_g.lower_work_roll"})
      EXPECT_TRUE(near(quick_value("back-" + model, level), quick_value("driven", level),
                       within(1e-6, "the same modes driven")));
  }
  const std::string arguments = " " + scratch("demo") + "/lumped_model-beam.toml -q -o " + scratch("tampered");
  const auto other =
      millstand("modes" + arguments + " --set model.stiffness='" + scratch("demo") + "/models/beam-mass.mtx'");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("of two parts are still joined in "), std::string::npos) << other.err;
  const std::string heavier = scratch("demo") + "/heavier.mtx";
  mill::write_atomically(heavier, mill::matrix_market_text(1.1 * matrix("beam-mass"), "ten percent more"));
  const auto tampered = millstand("modes" + arguments + " --set model.mass='" + heavier + "'");
  EXPECT_EQ(tampered.exit_code, 2);
  EXPECT_NE(tampered.err.find("model.modes says that mode 1 is at "), std::string::npos) << tampered.err;
}

// scipy reads the MATLAB file too, where it is there.
TEST(ModelFiles, MatlabFileAgreesWithTheMatrices)
{
  const std::string script = "import sys, scipy.io; m = scipy.io.loadmat(sys.argv[1]); "
                             "print(repr(float(m['K'][2][1])), m['unknown_names'][0][0][0])";
  const std::string out    = scratch("scipy") + "/out.txt";
  const int status         = std::system(
              ("python3 -c \"" + script + "\" " + demo_masses() + "/models/six-mass.mat > " + out + " 2> /dev/null")
                  .c_str());
  if (status != 0)
    GTEST_SKIP() << "python3 with scipy is not here; tests/unit/core/mat_file_test reads the bytes";
  const std::string model_text = mill::read_text(out);
  EXPECT_EQ(std::stod(model_text), matrix("six-mass-stiffness")(2, 1));
  EXPECT_NE(model_text.find("upper frame, displacement, y [m]"), std::string::npos) << model_text;
}
