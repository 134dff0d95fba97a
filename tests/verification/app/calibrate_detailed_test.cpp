// millstand calibrate on rolls as beams: connections from a record that the whole matrices made, back as a case.
#include "core/base/files.h"
#include "core/case/case_file.h"
#include "core/model/case.h"
#include "core/records/detailed_model.h"
#include "core/records/json_archive.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/synthetic_record.h"
#include <Eigen/Eigenvalues>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using namespace mill;

namespace {
const std::map<std::string, double> truth{{"K3", -0.06}, {"K5", 0.05}, {"K7", 0.07}, {"zeta", 0.3}};

/// Rolls as beams in files, as a run writes them, with a record of the same stand with other connections.
struct Beams {
  std::string folder = scratch("calibrate-detailed");
  StandModel model   = demo_beams(demo_drawing(), 4);
  Beams()
  {
    for (Connection &c : model.connections)
      c.error_estimate = 0.1;
    ModelFiles files = named_files(model, "models");
    fs::create_directories(folder + "/models");
    for (const auto &[name, text] : texts_of(model, files))
      write_atomically(folder + "/" + name, text);
    const std::string chain = folder + "/chain.toml";
    write_atomically(chain,
                     "schema = 1\nkind = \"lumped\"\n[given]\nM1 = \"1 kg\"\nM2 = \"1 kg\"\nM3 = \"1 kg\"\n"
                     "M4 = \"1 kg\"\nM5 = \"1 kg\"\nM6 = \"1 kg\"\nK1 = \"1 kN/mm\"\nK2 = \"1 kN/mm\"\n"
                     "K3 = \"1 kN/mm\"\nK4 = \"1 kN/mm\"\nK5 = \"1 kN/mm\"\nK6 = \"1 kN/mm\"\nK7 = \"1 kN/mm\"\n"
                     "[[pass]]\nname = \"1\"\nload = \"976 kN\"\n[dynamics]\nmodal_damping = \"1 %\"\n");
    write_atomically(folder + "/stand.toml", detailed_model_toml(files, read_case(chain), folder));
  }
  void write_record(const std::map<std::string, double> &moved, const Eigen::Index n) const
  {
    StandModel other = model;
    double zeta      = 0.01;
    for (Connection &c : other.connections)
      if (const auto factor = moved.find(c.name); factor != moved.end())
        c.stiffness *= std::exp(factor->second);
    if (const auto factor = moved.find("zeta"); factor != moved.end())
      zeta *= std::exp(factor->second);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness_of(other), other.M);
    const Eigen::VectorXd frequency = solver.eigenvalues().cwiseSqrt() / (2 * M_PI);
    const auto kept             = std::lower_bound(frequency.begin(), frequency.end(), 2000.0) - frequency.begin();
    const Eigen::MatrixXd V     = solver.eigenvectors().leftCols(kept);
    const double rate           = 8000;
    const auto force            = synthetic::band_force(7, n, rate, 2000, 0, 1500);
    const Eigen::VectorXd drive = V.transpose() * other.b;
    std::string text =
        "time [s],force [kN],upper_work_roll [m/s2],lower_work_roll [m/s2],upper_backup_roll [m/s2]\n";
    const Eigen::MatrixXd modal = synthetic::modal_response(frequency.head(kept), drive, zeta, force.drive, rate);
    Eigen::MatrixXd seen(n, 3);
    int j = 0;
    for (const char *place : {"upper work roll", "lower work roll", "upper backup roll"}) {
      seen.col(j) = modal * (V.transpose() * point_of(other, place).row) +
                    synthetic::white(100 + std::uint64_t(j), n, rate, 0.005);
      ++j;
    }
    for (Eigen::Index k = 0; k < n; ++k)
      text += fmt::format("{:.6f},{:.9g},{:.8g},{:.8g},{:.8g}\n", double(k) / rate, 976 + force.force[k] / 1e3,
                          seen(k, 0), seen(k, 1), seen(k, 2));
    fs::create_directories(folder + "/records");
    write_atomically(folder + "/records/pass.csv", text);
  }
};
}  // namespace

TEST(CalibrateDetailed, ConnectionsOfBeamsComeOutOfARecordAndBackAsACase)
{
  const Beams beams;
  beams.write_record(truth, 48000);
  const auto done = millstand("calibrate stand.toml --measured records --free K3,K5,K7,zeta -o out", beams.folder);
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const auto document = nlohmann::json::parse(read_text(beams.folder + "/out/calibration.json"));
  for (const auto &u : document["unknowns"]) {
    const std::string name = u["name"];
    EXPECT_TRUE(u["identified"].get<bool>()) << name;
    EXPECT_LT(std::abs(u["estimate"].get<double>() - truth.at(name)), 3.5 * u["sd"].get<double>()) << name;
    EXPECT_LT(u["sd"].get<double>(), 0.02) << name;
  }
  // The file is a case: its matrices hold the springs that were found, and every verb takes it.
  const Case calibrated = read_case(beams.folder + "/out/calibrated.toml");
  const auto &lumped    = std::get<Lumped>(calibrated.spec);
  EXPECT_TRUE(near(std::log(lumped.dynamics.modal_damping / 0.01), truth.at("zeta"),
                   within_absolute(0.02, "the deviation of each unknown is below 0.02, see above")));
  const StandModel back = detailed_model_of(lumped.model);
  ASSERT_EQ(back.connections.size(), beams.model.connections.size());
  for (std::size_t c = 0; c < back.connections.size(); ++c) {
    const auto moved      = truth.find(back.connections[c].name);
    const double expected = moved == truth.end() ? 0 : moved->second;
    EXPECT_TRUE(near(
        std::log(back.connections[c].stiffness.sum() / beams.model.connections[c].stiffness.sum()), expected,
        within_absolute(moved == truth.end() ? 1e-12 : 0.02,
                        "connections that were not fitted are copied; of the others the deviation is below 0.02")))
        << back.connections[c].name;
  }
  // The load cell sits on K7 and reads its force.
  EXPECT_TRUE(near(back.load_cell.norm() / beams.model.load_cell.norm(), std::exp(truth.at("K7")),
                   within_absolute(0.02, "the deviation of each unknown is below 0.02, see above")));
  EXPECT_EQ(millstand("modes out/calibrated.toml -q -o modes", beams.folder).exit_code, 0);
  for (const char *format : {"fmu -o unit.fmu", "statespace -o matrices", "modelica -o stand.mo"}) {
    const auto left = millstand(std::string("export ") + format + " out/calibrated.toml -q", beams.folder);
    EXPECT_EQ(left.exit_code, 0) << format << left.err;
  }
  EXPECT_EQ(millstand("advise out/calibrated.toml -q -o advice", beams.folder).exit_code, 0);
  const auto plan = millstand("calibrate out/calibrated.toml --plan --free K3,K5,K7,zeta", beams.folder);
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_NE(plan.out.find("a ratio for each mode, in place of zeta"), std::string::npos) << plan.out;
}

TEST(CalibrateDetailed, ARightCaseHasNothingToChange)
{
  const Beams beams;
  beams.write_record({}, 24000);
  const auto done = millstand("calibrate stand.toml --measured records --free K3,zeta -o out", beams.folder);
  EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_NE(
      done.out.find("the case agrees with these records already: freeing 2 unknowns lowers the deviance by "),
      std::string::npos)
      << done.out;
  EXPECT_NE(done.out.find("; no calibrated case is written\n"), std::string::npos) << done.out;
  EXPECT_FALSE(fs::exists(beams.folder + "/out/calibrated.toml"));
}

TEST(CalibrateDetailed, FilesWithoutConnectionsSaySo)
{
  const Beams beams;
  std::string text = read_text(beams.folder + "/stand.toml");
  for (const char *key : {"connections", "strains"}) {
    const auto position = text.find(std::string("\n") + key);
    text.erase(position, text.find('\n', position + 1) - position);
  }
  write_atomically(beams.folder + "/bare.toml", text);
  const auto refused = millstand("calibrate bare.toml --plan", beams.folder);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find(
                "millstand calibrate: the files of this model do not say its connections, so nothing of it can be "
                "moved; name them with model.connections and model.strains, which a run writes into models/"),
            std::string::npos)
      << refused.err;
}
