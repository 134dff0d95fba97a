// The unit of a stand on curves: its steps against those of the program, and what clients do with it.
#include "app/export/exported_curves.h"
#include "app/export/exported_stand.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/unit_archive.h"
#include "dynamics/nonlinear/curve_response.h"
#include "tests/support/curve_stands.h"
#include "tests/support/near.h"
#include "tests/support/unit_client.h"
#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;

namespace {
constexpr double load = 976e3, rate = 20e3;  // N, 1/s

// Six masses on the curves of K2, K3, K5 and K6.
struct Unit {
  ChainOnCurves chain;
  fmu::ExportedModel model;
};

Unit unit_on_curves(const double gap_damper = 0, const double longest_step = 1 / rate)
{
  Unit unit{chain_on_curves(load, 0.01, gap_damper), {}};
  fmu::ExportedModel &model = unit.model;
  model.identifier          = "on_curves";
  model.title               = "on curves";
  model.force_meaning       = ForceMeaning::disturbance;
  model.method              = "six masses on curves";
  model.program             = "millstand test";
  model.step                = 1 / rate;
  model.data                = modal_data(unit.chain.modal);
  model.data.kind           = fmu::StandKind::curves;
  model.data.runtime        = fmu::runtime_version;
  model.data.mean_force     = load;
  model.data.curves         = curve_data(unit.chain.stand, longest_step);
  model.data.guid           = fmu::identity_of(model);
  return unit;
}

// So much that K3 parts now and then; its mean is the load.
ForceRecord strong_force(const double amplitude, const Eigen::Index n = 201, const double spacing = 1e-3)
{
  ForceRecord force{Eigen::VectorXd::LinSpaced(n, 0, double(n - 1) * spacing), Eigen::VectorXd(n), {}};
  for (Eigen::Index i = 0; i < n; ++i)
    force.force[i] = std::sin(2 * M_PI * 61 * force.time[i]) + 0.7 * std::sin(2 * M_PI * 207 * force.time[i] + 1);
  force.force.array() -= force.force.mean();
  force.force = (load + amplitude * force.force.array()).matrix();
  return force;
}

// Rows at the samples of the force, which runs in straight lines between them; `parts` communication steps for
// each.
template <class Client> Eigen::MatrixXd played(Client &client, const ForceRecord &force, const int parts)
{
  const Eigen::Index n = force.time.size();
  const double spacing = force.time[1] - force.time[0], h = spacing / parts;
  Eigen::MatrixXd rows(n, 3);
  EXPECT_EQ(client.start(force.force[0]), fmi2OK) << client.logged();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int k = 0; k < parts && i > 0; ++k) {
      const double rise = (force.force[i] - force.force[i - 1]) / spacing;
      EXPECT_EQ(client.set("F_roll", force.force[i - 1] + rise * k * h), fmi2OK) << client.logged();
      EXPECT_EQ(client.slope(rise), fmi2OK) << client.logged();
      EXPECT_EQ(client.step(force.time[i - 1] + k * h, h), fmi2OK) << client.logged();
    }
    rows.row(i) << client.get("a_upper_work_roll"), client.get("a_lower_work_roll"), client.get("F_cell");
  }
  return rows;
}

Eigen::MatrixXd rows_of(const dynamics::Response &response, const Eigen::Index every)
{
  const Eigen::Index n = (response.force.size() - 1) / every + 1;
  Eigen::MatrixXd rows(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    rows.row(i) << response.acceleration(i * every, 2), response.acceleration(i * every, 3),
        response.load_cell[i * every];
  return rows;
}

double difference(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  return ((a - b).colwise().lpNorm<Eigen::Infinity>().array() / b.colwise().lpNorm<Eigen::Infinity>().array())
      .maxCoeff();
}
}  // namespace

// The result of steps that are multiples of the unit's own is that of the program's fixed steps, with contacts
// that part and a damper of the gap or none.
TEST(CurveUnit, AgreesWithFixedStepsAtAnyMultipleOfItsStep)
{
  const ForceRecord force = strong_force(0.5 * load);
  for (const double damper : {0., 2e6}) {
    const Unit unit   = unit_on_curves(damper);
    const auto run    = dynamics::fixed_step_response(unit.chain.stand, unit.chain.modal, force, 1e3, 20);
    const auto wanted = rows_of(run.response, 1);
    Client2 first(unit.model);
    ASSERT_TRUE(first.c) << first.logged();
    EXPECT_LT(difference(played(first, force, 1), wanted), 1e-10);
    for (const int parts : {2, 5, 20}) {
      Client2 client(first.unit, unit.model, unit.model.data.guid, "");
      EXPECT_LT(difference(played(client, force, parts), wanted), 1e-10) << parts << ", damper " << damper;
    }
  }
}

// The error-controlled run is the limit of short steps, of second order.
TEST(CurveUnit, ConvergesToTheErrorControlledRunWithTheSquareOfItsStep)
{
  const ForceRecord force = strong_force(0.05 * load, 101);  // no contact parts
  double before           = 0;
  for (const int halvings : {0, 1, 2}) {
    const Unit unit = unit_on_curves(0, std::ldexp(1 / rate, -halvings));
    const auto run  = dynamics::curve_response(unit.chain.stand, unit.chain.modal, force, 1e3);
    Client2 client(unit.model);
    ASSERT_TRUE(client.c) << client.logged();
    const double now = difference(played(client, force, 1), rows_of(run.response, 1));
    EXPECT_LT(now, 1e-2);
    if (halvings > 0)
      EXPECT_TRUE(
          near(before / now, 4, within(0.1, "second order; the next term of the error is below a tenth of it")));
    before = now;
  }
}

TEST(CurveUnit, CopiesAndSerialisedStatesGoOnAsTheFirst)
{
  const Unit unit = unit_on_curves(1e6);
  Client2 client(unit.model);
  ASSERT_TRUE(client.c) << client.logged();
  ASSERT_EQ(client.start(1.4 * load), fmi2OK) << client.logged();
  ASSERT_EQ(client.set("F_roll", 0.7 * load), fmi2OK);
  ASSERT_EQ(client.step(0, 3.3e-3), fmi2OK) << client.logged();
  fmi2FMUstate copy = nullptr;
  ASSERT_EQ(FMI2(client, GetFMUstate)(client.c, &copy), fmi2OK);
  std::size_t size = 0;
  ASSERT_EQ(FMI2(client, SerializedFMUstateSize)(client.c, copy, &size), fmi2OK);
  std::vector<char> bytes(size);
  ASSERT_EQ(FMI2(client, SerializeFMUstate)(client.c, copy, bytes.data(), size), fmi2OK);
  const auto rest_of = [](Client2 &c) {
    EXPECT_EQ(c.set("modal_damping", 0.03), fmi2OK) << c.logged();
    EXPECT_EQ(c.step(3.3e-3, 1.7e-3), fmi2OK) << c.logged();
    return std::array<double, 3>{c.get("a_upper_work_roll"), c.get("y_lower_work_roll"), c.get("F_cell")};
  };
  const auto once = rest_of(client);
  ASSERT_EQ(FMI2(client, SetFMUstate)(client.c, copy), fmi2OK) << client.logged();
  EXPECT_EQ(rest_of(client), once);
  Client2 other(client.unit, unit.model, unit.model.data.guid, "");
  fmi2FMUstate read = nullptr;
  ASSERT_EQ(FMI2(other, DeSerializeFMUstate)(other.c, bytes.data(), size, &read), fmi2OK) << other.logged();
  ASSERT_EQ(FMI2(other, SetFMUstate)(other.c, read), fmi2OK) << other.logged();
  EXPECT_EQ(rest_of(other), once);
  EXPECT_EQ(FMI2(client, FreeFMUstate)(client.c, &copy), fmi2OK);
  EXPECT_EQ(FMI2(other, FreeFMUstate)(other.c, &read), fmi2OK);
}

// At rest under a force the springs hold it, on their curves; output derivatives are those in time.
TEST(CurveUnit, RestsOnItsCurvesAndKnowsItsDerivatives)
{
  const Unit unit = unit_on_curves();
  Client2 client(unit.model);
  ASSERT_TRUE(client.c) << client.logged();
  ASSERT_EQ(client.start(1.5 * load), fmi2OK) << client.logged();
  dynamics::CurveState rest;
  ASSERT_TRUE(dynamics::rest_under(unit.chain.stand, 0.5 * load, rest));
  const Eigen::Map<const Eigen::VectorXd> q(rest.q.data(), 6);
  EXPECT_TRUE(near(client.get("y_upper_work_roll"), unit.chain.modal.point.row(2).dot(q),
                   within(1e-12, "the same equilibrium")));
  EXPECT_TRUE(
      near(client.get("a_upper_work_roll"), 0, within(1e-6, "at rest; rounding of forces over masses", 1)));
  ASSERT_EQ(client.set("F_roll", 0.8 * load), fmi2OK);
  ASSERT_EQ(client.step(0, 2e-3), fmi2OK) << client.logged();
  const unsigned output = client.at("a_upper_work_roll");
  const int order       = 1;
  double rate_there     = 0;
  const double before = client.get("a_upper_work_roll"), h = 1e-7;
  ASSERT_EQ(FMI2(client, GetRealOutputDerivatives)(client.c, &output, 1, &order, &rate_there), fmi2OK);
  ASSERT_EQ(client.step(2e-3, h), fmi2OK) << client.logged();
  double after_rate = 0;
  ASSERT_EQ(FMI2(client, GetRealOutputDerivatives)(client.c, &output, 1, &order, &after_rate), fmi2OK);
  EXPECT_TRUE(near((client.get("a_upper_work_roll") - before) / h, (rate_there + after_rate) / 2,
                   within(1e-5, "difference over 0.1 us")));
}

// By the force: in initialization along the equilibria of the curves, between steps through the mass alone.
TEST(CurveUnit, DirectionalDerivativesFollowTheCurves)
{
  const Unit unit = unit_on_curves();
  Client2 client(unit.model);
  ASSERT_TRUE(client.c) << client.logged();
  const unsigned force = client.at("F_roll"), y3 = client.at("y_upper_work_roll"),
                 a3 = client.at("a_upper_work_roll");
  const double one = 1, strong = 1.5 * load;
  double slope = 0;
  ASSERT_EQ(FMI2(client, SetupExperiment)(client.c, 0, 0, 0, 0, 0), fmi2OK);
  ASSERT_EQ(FMI2(client, EnterInitializationMode)(client.c), fmi2OK);
  ASSERT_EQ(FMI2(client, SetReal)(client.c, &force, 1, &strong), fmi2OK);
  ASSERT_EQ(FMI2(client, GetDirectionalDerivative)(client.c, &y3, 1, &force, 1, &one, &slope), fmi2OK)
      << client.logged();
  // K_tangent^-1 b at the compressions of that equilibrium.
  dynamics::CurveState rest;
  ASSERT_TRUE(dynamics::rest_under(unit.chain.stand, 0.5 * load, rest));
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6, 6);
  for (std::size_t k = 0; k < 6; ++k)
    K(Eigen::Index(k), Eigen::Index(k)) = unit.chain.stand.rate[k] * unit.chain.stand.rate[k];
  for (std::size_t j = 0; j < unit.chain.stand.springs.size(); ++j) {
    const auto &spring = unit.chain.stand.springs[j];
    const Eigen::Map<const Eigen::VectorXd> row(spring.row.data(), 6);
    K += dynamics::beyond_tangent(unit.chain.stand, spring, rest.d[j]).stiffness * row * row.transpose();
  }
  const Eigen::Map<const Eigen::VectorXd> push(unit.chain.stand.push.data(), 6);
  EXPECT_TRUE(near(slope, unit.chain.modal.point.row(2).dot(K.ldlt().solve(push)),
                   within(1e-7, "differences over a thousandth of the load")));
  ASSERT_EQ(FMI2(client, ExitInitializationMode)(client.c), fmi2OK);
  ASSERT_EQ(client.step(0, 1e-3), fmi2OK);
  ASSERT_EQ(FMI2(client, GetDirectionalDerivative)(client.c, &a3, 1, &force, 1, &one, &slope), fmi2OK);
  EXPECT_TRUE(near(slope, unit.chain.modal.point.row(2).dot(push), within(1e-8, "rounding of the differences")));
}

TEST(CurveUnit, RefusesByNameAndServesVersionThree)
{
  const Unit unit = unit_on_curves();
  Client2 client(unit.model, true);
  ASSERT_TRUE(client.c) << client.logged();
  EXPECT_EQ(client.set("F_mean", 0.5 * load), fmi2Discard);
  EXPECT_NE(client.logged().find("F_mean = 488000 N is out of range (976000 .. 976000 N); it stays 976000 N"),
            std::string::npos);
  Client2 torn(client.unit, unit.model, unit.model.data.guid, "", true);
  EXPECT_EQ(torn.start(-3 * load), fmi2Error);
  EXPECT_NE(torn.logged().find("there is no equilibrium under the force at the start: it pulls the rolls apart"),
            std::string::npos);
  const ForceRecord force = strong_force(0.5 * load, 21);
  Client3 three(unit.model);
  ASSERT_TRUE(three.c) << three.logged();
  ASSERT_EQ(three.start(1.2 * load), fmi3OK) << three.logged();
  ASSERT_EQ(client.start(1.2 * load), fmi2OK) << client.logged();
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(three.set("F_roll", load * (1 - 0.2 * i)), fmi3OK);
    ASSERT_EQ(client.set("F_roll", load * (1 - 0.2 * i)), fmi2OK);
    ASSERT_EQ(three.step(i * 1e-3, 1e-3), fmi3OK) << three.logged();
    ASSERT_EQ(client.step(i * 1e-3, 1e-3), fmi2OK) << client.logged();
  }
  EXPECT_EQ(three.get("a_upper_work_roll"), client.get("a_upper_work_roll"));
}

// The check at export sees another curve.
TEST(CurveUnit, IsHeldAgainstTheProgramBeforeItIsWritten)
{
  Unit unit                     = unit_on_curves();
  const ForceRecord force       = strong_force(0.2 * load, 11, 1 / rate);
  const auto run                = dynamics::fixed_step_response(unit.chain.stand, unit.chain.modal, force, rate);
  unit.model.check.step         = 1 / rate;
  unit.model.check.force        = force.force;
  unit.model.check.acceleration = run.response.acceleration;
  unit.model.check.load_cell    = run.response.load_cell;
  for (const int version : {2, 3})
    EXPECT_NO_THROW(fmu::check_unit(fmu::unit_archive(unit.model, version), unit.model, version));
  unit.model.data.curves.laws[1].compression.back() *= 1.01;
  EXPECT_THROW(fmu::check_unit(fmu::unit_archive(unit.model, 2), unit.model, 2), std::logic_error);
}
