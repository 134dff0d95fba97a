// The lumped model on disk: a valid case that keeps every number with its source.
#include "core/base/files.h"
#include "core/base/source_text.h"
#include "core/case/given.h"
#include "core/case/input_reference.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "core/model/lumped.h"
#include "tests/support/near.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
LumpedModel sample()
{
  LumpedModel model;
  const auto parameter = [](const double value, const char *unit) {
    Parameter p;
    p.value          = value;
    p.unit           = unit;
    p.method         = "series \"springs\"";
    p.at             = "976.2 kN";
    p.error_estimate = 1.0 / 300;
    p.inputs         = {"frame.piston_stiffness", "work_roll.barrel_diameter"};
    return p;
  };
  for (std::size_t i = 0; i < 6; ++i)
    model.M[i] = parameter(10000.0 / double(i + 3), "kg");
  for (std::size_t i = 0; i < 7; ++i)
    model.K[i] = parameter(1e11 / double(i + 3), "N/m");
  model.K[3].value  = 0;
  model.K[3].source = Source::assumed;
  model.Kzc[0]      = parameter(2.01e10, "N/m");  // the other three stay unknown
  model.C           = parameter(1.91141e5, "N s/m");
  model.C.source    = Source::published;
  return model;
}

void expect_same(const Parameter &a, const Parameter &b)
{
  EXPECT_TRUE(a.value == b.value || (std::isnan(a.value) && std::isnan(b.value))) << a.value << " and " << b.value;
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.at.text(), b.at.text());
  EXPECT_EQ(a.inputs, b.inputs);
  EXPECT_TRUE(a.error_estimate == b.error_estimate ||
              (std::isnan(a.error_estimate) && std::isnan(b.error_estimate)));
}

class LumpedModels : public testing::Test {
protected:
  fs::path folder = fs::path(testing::TempDir()) / "millstand_lumped_model_test";
  void SetUp() override
  {
    fs::remove_all(folder);
    fs::create_directories(folder / "out");
    fs::create_directories(folder / "data");
  }
  void TearDown() override
  {
    fs::remove_all(folder);
  }
  std::string write(const std::string &name, const std::string &text)
  {
    write_atomically((folder / name).string(), text);
    return (folder / name).string();
  }
};
}  // namespace

TEST_F(LumpedModels, LumpedModelsComeBackFromDiskWithEverySource)
{
  write("data/f.csv", "time [s],force [kN]\n0,1\n1,2\n");
  const std::string second = "\n[[pass]]\nname = \"pass 2\"\nsynthetic_range = [\"733 kN\", \"742 kN\"]\n"
                             "synthetic_seed = 2\n";
  const Case origin        = read_case(write("case.toml", template_of("four-high") + second),
                                       {"pass.0.published_peak=[\"1.40 g\", \"0.75 g\"]", "dynamics.modal_damping=2 %"});
  const LumpedModel model  = sample();
  const Case read =
      read_case(write("out/lumped_model.toml", lumped_model_toml(model, origin, (folder / "out").string())));
  EXPECT_EQ(read.kind, "lumped");
  EXPECT_EQ(read.title, origin.title);
  const LumpedModel back = lumped_model_of(read);
  for (std::size_t i = 0; i < 6; ++i)
    expect_same(back.M[i], model.M[i]);
  for (std::size_t i = 0; i < 7; ++i)
    expect_same(back.K[i], model.K[i]);
  expect_same(back.Kzc[0], model.Kzc[0]);
  EXPECT_TRUE(std::isnan(back.Kzc[1].value));
  expect_same(back.C, model.C);
  const auto &lumped = std::get<Lumped>(read.spec);
  ASSERT_EQ(lumped.passes.size(), 2u);
  EXPECT_EQ(lumped.passes[0].synthetic_range[1], 979537);
  EXPECT_EQ(lumped.passes[1].synthetic_seed, 2);
  EXPECT_TRUE(
      near(lumped.passes[0].published_peak_g[0], 1.40, within(1e-15 / 1.40, "to m/s2 and back twice: rounding")));
  EXPECT_EQ(lumped.dynamics.modal_damping, 0.02);
}

TEST_F(LumpedModels, PathsOfThePassesFollowTheFile)
{
  write("data/f.csv", "time [s],force [kN]\n0,1\n1,2\n");
  const std::string text    = template_of("lumped");
  const Case origin         = read_case(write("case.toml", text), {"pass.0.load=900 kN", "pass.1.load=900 kN"});
  Case with_file            = origin;
  auto &passes              = std::get<Lumped>(with_file.spec).passes;
  passes[0].force_file      = (folder / "data/f.csv").string();
  passes[0].synthetic_range = {not_given, not_given};
  const std::string toml    = lumped_model_toml(sample(), with_file, (folder / "out").string());
  EXPECT_NE(toml.find("force = \"../data/f.csv\""), std::string::npos) << toml;
  const Case back = read_case(write("out/lumped_model.toml", toml));
  EXPECT_TRUE(fs::equivalent(std::get<Lumped>(back.spec).passes[0].force_file, folder / "data/f.csv"));
}

TEST_F(LumpedModels, AModelWithoutADamperIsReadWithoutOne)
{
  const LumpedModel model = lumped_model_of(read_case(write("case.toml", template_of("lumped"))));
  EXPECT_EQ(model.C.value, 0);
  EXPECT_EQ(source_text(model.C), "assumed: no damper given");
  EXPECT_EQ(source_text(model.K[2]), "given");
}

TEST(Source, EveryTextIsUnderstood)
{
  for (const char *text :
       {"given", "published", "measured", "computed: contact FEM", "assumed: F/20", "computed"}) {
    Parameter parameter;
    EXPECT_TRUE(parse_source(text, parameter)) << text;
    EXPECT_EQ(source_text(parameter), text);
    EXPECT_EQ(source_in(text).source, parameter.source);
    EXPECT_EQ(source_in(text).method, parameter.method);
  }
  EXPECT_FALSE(source_in("guessed: so").source);
  EXPECT_EQ(source_in("guessed: so").method, "guessed: so");
  Parameter parameter;
  EXPECT_FALSE(parse_source("guessed", parameter));
  EXPECT_FALSE(parse_source("", parameter));
}
