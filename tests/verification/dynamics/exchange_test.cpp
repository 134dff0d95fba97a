// The stand for other programs: what is written is read back by readers that know nothing of the writers, and
// compared with modes, poles and responses of the chain.
#include "core/records/matrix_market.h"
#include "dynamics/exchange/matlab.h"
#include "dynamics/exchange/modelica.h"
#include "dynamics/exchange/state_space_files.h"
#include "dynamics/response/frequency_response.h"
#include "dynamics/response/modes.h"
#include "tests/support/modelica_text.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <fstream>
#include <sstream>

using namespace mill;
using namespace mill::dynamics;

namespace {
struct Sample {
  MillModel chain;
  ExchangedStand stand;
  DrivenModel own;
};

void name(ExchangedStand &stand)
{
  stand.name       = "sample_stand";
  stand.title      = "a \"sample\" stand";
  stand.origin     = "case sample, pass 1";
  stand.method     = "chain of six masses";
  stand.program    = "millstand test";
  stand.force_text = "rolling force, positive pushes the work rolls apart";
  stand.points     = {"upper_frame",     "upper_backup_roll", "upper_work_roll",
                      "lower_work_roll", "lower_backup_roll", "lower_frame"};
  stand.source     = {{"M3", "M3 of the case, published"}};
  stand.mean_force = 976217.5;
  stand.step       = 5e-5;
}

Sample sample(const ForceMeaning meaning, const FrameForm frame, const double gap_damper)
{
  LumpedModel lumped = published_stand();
  lumped.C.value     = gap_damper;
  auto dynamics      = settings(meaning, 0.01);
  dynamics.frame     = frame;
  Sample s{mill_model(lumped, dynamics), {}, {}};
  s.own   = driven_model(s.chain);
  s.stand = exchanged(s.chain, dynamics, meaning == ForceMeaning::measured ? 0 : gap_damper);
  name(s.stand);
  s.stand.unknowns = s.stand.points;
  add_step_test(s.stand, s.own);
  return s;
}

// The same stand in its modes, seen at the same points.
Sample in_modes(const Sample &chain, const double gap_damper)
{
  const auto undamped = modes(chain.chain);
  ModalModel model;
  model.labels          = chain.chain.labels;
  model.frequency       = undamped.frequency;
  model.point           = undamped.shape;
  model.force           = undamped.shape.transpose() * chain.chain.b;
  model.load_cell       = undamped.shape.transpose() * chain.chain.load_cell;
  model.load_cell_share = chain.chain.load_cell_share;
  model.damping         = 0.01;
  model.gap_damper      = gap_damper;
  Sample s{chain.chain, exchanged(model), driven_model(model)};
  name(s.stand);
  add_step_test(s.stand, s.own);
  return s;
}

// Every equation at one state of motion that the chain's own matrices give: largest residual over the largest
// term.
double residual(const modelica::Class &model, const modelica::Values &values)
{
  double worst = 0;
  for (const auto *equations : {&model.equations, &model.initial_equations})
    for (const auto &e : *equations) {
      if (equations == &model.initial_equations)
        continue;
      const auto left = value_of(e.left, values), right = value_of(e.right, values);
      EXPECT_EQ(left.size(), right.size());
      worst = std::max(worst, (left - right).cwiseAbs().maxCoeff() / std::max(1e-9, left.cwiseAbs().maxCoeff()));
    }
  return worst;
}

struct Motion {
  Eigen::VectorXd y, v, a;
  double force, cell;
};

Motion motion_of(const Sample &s)
{
  Motion m;
  m.y.resize(6), m.v.resize(6);
  m.y << 1e-6, -2e-6, 3e-6, 4e-6, -5e-6, 6e-6;
  m.v << 3e-3, 1e-3, -4e-3, 1e-3, 5e-3, -9e-3;
  m.force                 = s.stand.mean_force + 12345;
  const Eigen::VectorXd f = s.chain.b * 12345 - s.chain.C * m.v - s.chain.K * m.y;
  m.a                     = f.cwiseQuotient(s.chain.M);
  m.cell                  = s.chain.load_cell.dot(m.y) + s.chain.load_cell_share * s.stand.mean_force;
  return m;
}

void add_outputs(const Sample &s, const Motion &m, modelica::Values &values)
{
  const auto one = [](const double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
  values["F"]    = one(m.force);
  for (int i = 0; i < 6; ++i) {
    values["a_" + s.stand.points[std::size_t(i)]] = one(m.a[i]);
    values["y_" + s.stand.points[std::size_t(i)]] = one(m.y[i]);
  }
  values["F_cell"] = one(m.cell);
}

const std::vector<std::pair<ForceMeaning, FrameForm>> kinds{{ForceMeaning::measured, FrameForm::open},
                                                            {ForceMeaning::disturbance, FrameForm::closed},
                                                            {ForceMeaning::published, FrameForm::open}};
}  // namespace

TEST(Exchange, EquationsOfModelicaAreThoseOfTheChain)
{
  for (const auto &[meaning, frame] : kinds) {
    const Sample s                = sample(meaning, frame, 2e5);
    const modelica::Class package = modelica::read(modelica_package(s.stand, "force.txt"));
    const modelica::Class &model  = package.classes.at("Equations");
    EXPECT_TRUE(undeclared(model).empty()) << undeclared(model).front();
    const Motion m          = motion_of(s);
    modelica::Values values = parameters_of(model);
    values["y"] = m.y, values["v"] = values["der(y)"] = m.v, values["der(v)"] = m.a;
    add_outputs(s, m, values);
    EXPECT_LT(residual(model, values), 1e-9) << word_of(meaning) << ": rounding of K y, whose terms cancel";
    // As many equations as unknowns: whatever is changed is noticed.
    for (const char *unknown :
         {"der(y)", "der(v)", "y_upper_frame", "a_upper_frame", "a_lower_work_roll", "F_cell", "y_lower_frame"}) {
      modelica::Values wrong = values;
      wrong[unknown](wrong[unknown].rows() - 1, 0) *= 1.001;
      EXPECT_GT(residual(model, wrong), 1e-5) << unknown;
    }
    // Frequencies of the matrices as they are written.
    const Eigen::MatrixXd M = values.at("M").asDiagonal(), K = values.at("K");
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);
    const Eigen::VectorXd f = solver.eigenvalues().cwiseSqrt() / (2 * M_PI);
    EXPECT_TRUE(near(f, modes(s.chain).frequency, within(1e-9, "two eigenvalue solvers")));
    EXPECT_EQ(model.components.at("M3").comment, "mass of the upper work roll (M3 of the case, published)");
    EXPECT_EQ(package.annotations.at("uses.Modelica.version").text, "4.0.0");
  }
}

TEST(Exchange, EquationsOfModelicaInModesMoveAsTheChainDoes)
{
  const Sample chain = sample(ForceMeaning::disturbance, FrameForm::open, 2e5), s = in_modes(chain, 2e5);
  const modelica::Class package = modelica::read(modelica_package(s.stand, "force.txt"));
  const modelica::Class &model  = package.classes.at("Equations");
  EXPECT_TRUE(undeclared(model).empty()) << undeclared(model).front();
  EXPECT_EQ(package.classes.count("Components"), 0u);
  const Motion m          = motion_of(chain);
  const auto shape        = modes(chain.chain).shape;
  modelica::Values values = parameters_of(model);
  const auto modal        = [&](const Eigen::VectorXd &vector) {
    return Eigen::MatrixXd(shape.transpose() * chain.chain.M.cwiseProduct(vector));
  };
  values["q"] = modal(m.y), values["p"] = values["der(q)"] = modal(m.v), values["der(p)"] = modal(m.a);
  values["a"] = m.a, values["y"] = m.y;
  add_outputs(chain, m, values);
  EXPECT_LT(residual(model, values), 1e-9);
}

TEST(Exchange, ComponentsOfModelicaAreJoinedAsTheSpringsAre)
{
  for (const auto &[meaning, frame] : kinds) {
    const Sample s = sample(meaning, frame, 2e5);
    const modelica::Class model =
        std::move(modelica::read(modelica_package(s.stand, "")).classes.at("Components"));
    const modelica::Values known = parameters_of(model);
    EXPECT_TRUE(undeclared(model).empty()) << undeclared(model).front();
    std::map<std::string, int> place{{"ground", -1}};
    for (int i = 0; i < 6; ++i)
      place[s.stand.points[std::size_t(i)]] = i;
    std::map<std::string, std::array<int, 2>> ends;
    Eigen::VectorXd bite = Eigen::VectorXd::Zero(6);
    for (const auto &[from, to] : model.connections)
      for (const auto &[one, other] : {std::pair{from, to}, std::pair{to, from}}) {
        const std::string part = one.substr(0, one.find('.')), at = other.substr(0, other.find('.'));
        const bool first = one.find("flange_a") != std::string::npos;
        if (part == "bite")
          bite[place.at(at)] = first ? -1 : 1;  // Force2: plus at flange_b
        else if (part.rfind("spring_", 0) == 0)
          ends[part][first ? 0 : 1] = place.at(at);
      }
    EXPECT_EQ(bite, s.chain.b);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6, 6), C = K;
    for (const auto &[spring, two] : ends) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(6);
      for (const int side : {0, 1})
        if (two[std::size_t(side)] >= 0)
          row[two[std::size_t(side)]] = side == 0 ? -1 : 1;
      const auto &modifiers = model.components.at(spring).modifiers;
      K += value_of(modifiers.at("c"), known)(0, 0) * row * row.transpose();
      C += value_of(modifiers.at("d"), known)(0, 0) * row * row.transpose();
    }
    EXPECT_LT((K - s.chain.K).cwiseAbs().maxCoeff(), 1e-12 * s.chain.K.maxCoeff());
    // Damping in proportion to the stiffness, that of the leading mode as in the chain, and the damper of the gap.
    const auto undamped  = modes(s.chain);
    const double gap     = known.at("C_gap")(0, 0);
    Eigen::Index leading = 0;
    (undamped.frequency.array() - s.stand.leading_frequency).abs().minCoeff(&leading);
    const Eigen::VectorXd shape = undamped.shape.col(leading);
    EXPECT_TRUE(near(shape.dot((C - gap * s.chain.b * s.chain.b.transpose()) * shape),
                     2 * 0.01 * 2 * M_PI * s.stand.leading_frequency, within(1e-9, "modes of the chain")));
    EXPECT_EQ(gap, meaning == ForceMeaning::measured ? 0 : 2e5);
    for (int i = 0; i < 6; ++i)
      EXPECT_EQ(value_of(model.components.at(s.stand.points[std::size_t(i)]).modifiers.at("m"), known)(0, 0),
                s.chain.M[i]);
    // The load cell reads one spring.
    modelica::Values values = known;
    const Motion m          = motion_of(s);
    const auto value_at     = [&](const int mass) { return mass < 0 ? 0 : m.y[mass]; };
    for (const auto &[spring, two] : ends) {
      values[spring + ".s_rel"] = Eigen::MatrixXd::Constant(1, 1, value_at(two[1]) - value_at(two[0]));
      values[spring + ".c"]     = value_of(model.components.at(spring).modifiers.at("c"), known);
    }
    for (const auto &e : model.equations)
      if (e.left.text == "F_cell")
        EXPECT_TRUE(near(value_of(e.right, values)(0, 0), m.cell, within(1e-12, "statics")));
  }
}

namespace {
// An input that is not a connector may be given by a modifier alone, never by an equation (Modelica 3.4, 4.4.2.2).
void expect_bound_inputs(const modelica::Class &model)
{
  EXPECT_EQ(model.components.at("stand").modifiers.count("F"), 1u) << model.name;
  for (const auto &e : model.equations)
    EXPECT_TRUE(e.left.text != "stand.F" && e.right.text != "stand.F") << model.name;
}
}  // namespace

TEST(Exchange, TheStepTestGivesTheForceAsABinding)
{
  const Sample s     = sample(ForceMeaning::measured, FrameForm::open, 0);
  const auto package = modelica::read(modelica_package(s.stand, ""));
  const auto &test   = package.classes.at("ForceStep");
  expect_bound_inputs(test);
  EXPECT_TRUE(undeclared(test).empty());
  modelica::Values values = parameters_of(test);
  const auto force_at     = [&](const double time) {
    values["time"] = Eigen::MatrixXd::Constant(1, 1, time);
    return value_of(test.components.at("stand").modifiers.at("F"), values)(0, 0);
  };
  EXPECT_EQ(force_at(0), s.stand.mean_force);
  EXPECT_EQ(force_at(step_test_begin), s.stand.mean_force + s.stand.step_force);
}

TEST(Exchange, RecordsOfAnyLengthAreDriven)
{
  Sample s = sample(ForceMeaning::measured, FrameForm::open, 0);
  for (const Eigen::Index n : {longest_series_in_package, longest_series_in_package + 1}) {
    s.stand.series = {Eigen::VectorXd::LinSpaced(n, 0, 1), Eigen::VectorXd::Constant(n, 976e3), {}};
    const auto model =
        std::move(modelica::read(modelica_package(s.stand, "sample_force.txt")).classes.at("Recorded"));
    EXPECT_TRUE(undeclared(model).empty());
    const auto &table = model.components.at("force").modifiers;
    EXPECT_EQ(table.count("table"), n > longest_series_in_package ? 0u : 1u);
    if (table.count("table")) {
      EXPECT_EQ(value_of(table.at("table"), {}).rows(), n);
    } else {
      const auto &file = *model.components.at("force_file").value;
      EXPECT_EQ(file.text, "Modelica.Utilities.Files.loadResource");
      EXPECT_EQ(file.of.at(0).text, "modelica://sample_stand/sample_force.txt");
    }
    EXPECT_EQ(model.components.at("stand").modifiers.at("F").what, "index");
    expect_bound_inputs(model);
    EXPECT_EQ(model.annotations.at("experiment.StopTime").number, 1);
  }
  std::istringstream file(modelica_series(s.stand.series));
  std::string first, comment, head;
  std::getline(file, first), std::getline(file, comment), std::getline(file, head);
  EXPECT_EQ(first, "#1");
  EXPECT_EQ(head, "double force(501, 2)");
  double time = 0, force = 0;
  for (int i = 0; i < 501; ++i)
    file >> time >> force;
  EXPECT_EQ(time, 1);
  EXPECT_EQ(force, 976e3);
}

// The peak that the test model promises, by the closed form of each mode after a step.
TEST(Exchange, TheStepTestPromisesTheRightPeak)
{
  const Sample s      = sample(ForceMeaning::measured, FrameForm::open, 0);
  const auto undamped = modes(s.chain);
  double peak         = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double t = 1e-6 * i;
    double a       = 0;
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double w = 2 * M_PI * undamped.frequency[k], z = 0.01, wd = w * std::sqrt(1 - z * z);
      const double shape = undamped.shape(upper_work_roll, k) * undamped.shape.col(k).dot(s.chain.b);
      a += shape * std::exp(-z * w * t) * (std::cos(wd * t) - z * w / wd * std::sin(wd * t));
    }
    peak = std::max(peak, std::abs(s.stand.step_force * a));
  }
  EXPECT_TRUE(
      near(s.stand.step_peak[0], peak, within(2e-4, "a peak between samples of 1/100 of the fastest period")));
  const std::string text = modelica_package(s.stand, "");
  const auto position    = text.find("// Expected at the end: largest_upper = ");
  ASSERT_NE(position, std::string::npos);
  EXPECT_TRUE(near(std::stod(text.substr(position + 40)), peak, within(2e-4, "the same, with six digits")));
}

TEST(Exchange, TheReaderOfModelicaFindsMistakes)
{
  const std::string whole = modelica_package(sample(ForceMeaning::measured, FrameForm::open, 0).stand, "");
  const auto refusal      = [&](const std::string &from, const std::string &to) {
    std::string broken = whole;
    broken.replace(broken.find(from), from.size(), to);
    try {
      modelica::read(broken);
    } catch (const std::runtime_error &e) {
      return std::string(e.what());
    }
    return std::string("read");
  };
  EXPECT_EQ(refusal("within ;", "within "), "2:1: a name is expected in place of \"package\"");
  EXPECT_NE(refusal("end for", "end if"), "read");
  EXPECT_NE(refusal("end Equations", "end Equation"), "read");
  EXPECT_NE(refusal("der(y) = v", "der(y) = v +"), "read");
  EXPECT_NE(refusal("(unit=\"kg\")", "(unit=\"kg\""), "read");
}

TEST(Exchange, StateSpaceFilesGivePolesAndResponsesOfTheChain)
{
  const Sample s = sample(ForceMeaning::disturbance, FrameForm::closed, 2e5);
  std::map<std::string, Eigen::MatrixXd> read;
  std::string names;
  for (const NamedText &file : state_space_files(s.stand)) {
    const std::string path = testing::TempDir() + "exchange-" + file.name;
    std::ofstream(path) << file.text;
    if (file.name == "names.csv")
      names = file.text;
    if (file.name.find(".mtx") != std::string::npos)
      read[file.name.substr(0, 1)] = read_matrix_market(path);
  }
  for (const NamedText &file : state_space_files(s.stand))
    if (file.name.size() == 5 && file.name.find(".csv") == 1) {
      const Eigen::MatrixXd &same = read.at(file.name.substr(0, 1));
      std::istringstream rows(file.text);
      std::string row, cell;
      for (Eigen::Index i = 0; i < same.rows(); ++i) {
        ASSERT_TRUE(std::getline(rows, row));
        std::istringstream cells(row);
        for (Eigen::Index j = 0; j < same.cols(); ++j) {
          ASSERT_TRUE(std::getline(cells, cell, ','));
          EXPECT_EQ(std::stod(cell), same(i, j));
        }
      }
    }
  const Eigen::MatrixXd &A = read.at("A"), &B = read.at("B"), &C = read.at("C"), &D = read.at("D");
  ASSERT_EQ(A.rows(), 12);
  ASSERT_EQ(C.rows(), 13);
  std::vector<double> result;
  for (const auto &pole : A.eigenvalues())
    if (pole.imag() > 0)
      result.push_back(std::abs(pole) / (2 * M_PI));
  std::sort(result.begin(), result.end());
  const auto wanted = poles(s.chain);
  ASSERT_EQ(result.size(), wanted.size());
  for (std::size_t k = 0; k < result.size(); ++k)
    EXPECT_TRUE(
        near(result[k], wanted[k].frequency, within(1e-7, "A mixes entries of 1 and of 1e8, not balanced here")));
  const Eigen::Vector4d frequency(3, 40, 333, 800);
  const auto response = frequency_response(s.chain, frequency);
  using Complex       = std::complex<double>;
  for (Eigen::Index i = 0; i < 4; ++i) {
    Eigen::MatrixXcd matrix = -A.cast<Complex>();
    matrix.diagonal().array() += Complex(0, 2 * M_PI * frequency[i]);
    const Eigen::VectorXcd y = C * matrix.fullPivLu().solve(B.cast<Complex>()) + D;
    for (Eigen::Index j = 0; j < 6; ++j)
      EXPECT_LT(std::abs(y[j] - response.acceleration(i, j)),
                1e-9 * response.acceleration.row(i).cwiseAbs().maxCoeff());
    EXPECT_LT(std::abs(y[12] - response.load_cell[i]), 1e-9 * std::abs(response.load_cell[i]));
  }
  EXPECT_NE(names.find("state,9,v_upper_work_roll,m/s,\"velocity of the upper work roll, up positive, "),
            std::string::npos);
  EXPECT_NE(names.find("\ninput,1,dF_roll,N,"), std::string::npos);
  EXPECT_NE(names.find("\noutput,13,dF_cell,N,"), std::string::npos);
}

TEST(Exchange, TheCheckSeesAWrongNumber)
{
  for (const bool modal : {false, true}) {
    Sample s = sample(ForceMeaning::disturbance, FrameForm::open, 2e5);
    if (modal)
      s = in_modes(s, 2e5);
    const auto difference = [&](const ExchangedStand &stand) {
      return difference_from(first_order_form(stand), s.own, stand.frequency);
    };
    EXPECT_LT(difference(s.stand), 0.01 * exchange_agreement);
    ExchangedStand wrong = s.stand;
    wrong.K(2, 2) *= 1 + 1e-6;
    EXPECT_GT(difference(wrong), exchange_agreement) << "stiffness";
    wrong = s.stand;
    wrong.C(2, 2) *= 1 + 1e-4;
    EXPECT_GT(difference(wrong), exchange_agreement) << "damping";
    wrong = s.stand;
    wrong.load_cell *= 1 + 1e-6;
    EXPECT_GT(difference(wrong), exchange_agreement) << "load cell";
    wrong   = s.stand;
    wrong.b = -wrong.b;
    EXPECT_GT(difference(wrong), exchange_agreement) << "sign";
  }
  // Critical damping: a double pole, which rounding splits, is not a difference.
  const Sample damped = sample(ForceMeaning::disturbance, FrameForm::open, 6.2e6);
  EXPECT_LT(difference_from(first_order_form(damped.stand), damped.own, damped.stand.frequency),
            exchange_agreement);
}

TEST(Exchange, FilesAreTheSameEachTime)
{
  const Sample s     = sample(ForceMeaning::published, FrameForm::open, 2e5),
               again = sample(ForceMeaning::published, FrameForm::open, 2e5);
  EXPECT_EQ(modelica_package(s.stand, "f"), modelica_package(again.stand, "f"));
  EXPECT_EQ(matlab_function(s.stand), matlab_function(again.stand));
  EXPECT_EQ(matlab_data(s.stand), matlab_data(again.stand));
  EXPECT_NE(matlab_data(s.stand), matlab_data(sample(ForceMeaning::measured, FrameForm::open, 0).stand));
}
