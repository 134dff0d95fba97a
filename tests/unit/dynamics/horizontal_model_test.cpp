// Horizontal frequencies of the rolls on their bearings and chock seats.
#include "dynamics/response/modes.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <algorithm>

using namespace mill;
using namespace mill::dynamics;

const Tolerance closed_form = within(1e-6, "closed form; the reference is printed with 10 digits or more");

namespace {
LumpedModel stand_on_bearings(const double Kzc)
{
  auto stand = published_stand();
  for (auto &bearing : stand.Kzc)
    bearing.value = Kzc;
  return stand;
}
}  // namespace

// frequency of the mode that lives in one mass
namespace {
double frequency_of(const MillModel &model, const std::string &label)
{
  const Modes solution = modes(model);
  const auto mass      = std::find(model.labels.begin(), model.labels.end(), label) - model.labels.begin();
  Eigen::Index mode    = 0;
  solution.kinetic_share.col(mass).maxCoeff(&mode);
  return solution.frequency[mode];
}
}  // namespace

TEST(HorizontalModel, WithRigidSeatsOnlyTheBearingsYield)
{
  const double row_sum = reference("bearing.row_sum");
  struct Row {
    const char *entry;
    double Kzc;
    int bearings;
  };
  for (const Row &row : {Row{"horizontal.2.01e10_one", 2.01e10, 1}, Row{"horizontal.2.01e10_two", 2.01e10, 2},
                         Row{"horizontal.2.587e9_one", row_sum, 1}, Row{"horizontal.2.587e9_two", row_sum, 2},
                         // third row read as 6.23286e4 N/mm
                         Row{"horizontal.2.026e9_two", row_sum - 0.9 * 623286000.0, 2}}) {
    ChockSeats seats;
    seats.bearings_per_roll = row.bearings;
    const auto model        = horizontal_model(stand_on_bearings(row.Kzc), seats);
    const auto expected     = reference_vector(row.entry);
    const char *rolls[]     = {"upper backup roll", "upper work roll", "lower work roll", "lower backup roll"};
    for (int i = 0; i < 4; ++i)
      EXPECT_TRUE(near(frequency_of(model, rolls[i]), expected[i], closed_form)) << row.entry << ", " << rolls[i];
  }
}

TEST(HorizontalModel, ASeatIsInSeriesWithTheBearings)
{
  for (const auto &row : reference("horizontal.seat").get<std::vector<std::vector<double>>>()) {
    ChockSeats seats;
    seats.stiffness  = {row[0] * 2 * 2.01e10, row[0] * 2 * 2.01e10};
    const auto light = horizontal_model(stand_on_bearings(2.01e10), seats);
    EXPECT_EQ(light.M.size(), 4) << "a chock without mass needs no unknown of its own";
    EXPECT_TRUE(near(frequency_of(light, "upper work roll"), row[1], closed_form)) << "Kx/2Kzc " << row[0];
    EXPECT_TRUE(near(frequency_of(light, "lower work roll"), row[2], closed_form)) << "Kx/2Kzc " << row[0];

    seats.chock_mass  = {1200, 1200};
    const auto heavy  = horizontal_model(stand_on_bearings(2.01e10), seats);
    const auto backup = horizontal_model(stand_on_bearings(2.01e10), ChockSeats{});
    std::vector<double> expected(row.begin() + 3, row.end());
    expected.push_back(frequency_of(backup, "upper backup roll"));
    expected.push_back(frequency_of(backup, "lower backup roll"));
    std::sort(expected.begin(), expected.end());
    EXPECT_TRUE(near(modes(heavy).frequency, Eigen::Map<Eigen::VectorXd>(expected.data(), 6), closed_form))
        << "Kx/2Kzc " << row[0];
  }
}

TEST(HorizontalModel, LeavesOutARollWhoseBearingIsUnknown)
{
  auto stand         = stand_on_bearings(2.01e10);
  stand.Kzc[0].value = stand.Kzc[3].value = not_given;
  const auto model                        = horizontal_model(stand, ChockSeats{});
  ASSERT_EQ(model.labels, (std::vector<std::string>{"upper work roll", "lower work roll"}));
  const auto two = reference_vector("horizontal.2.01e10_two");
  EXPECT_TRUE(near(frequency_of(model, "upper work roll"), two[1], closed_form));
  EXPECT_EQ(modes(horizontal_model(published_stand(), ChockSeats{})).frequency.size(), 0)
      << "nothing known, no modes";
}

// A bearing yields along the pass line as it does across its load; only without that number as it does along it.
TEST(HorizontalModel, TakesTheStiffnessInItsOwnDirection)
{
  auto stand                = stand_on_bearings(2e10);
  const double as_both      = frequency_of(horizontal_model(stand, {}), "upper work roll");
  stand.Kzc_across[1].value = 0.5e10;
  const auto model          = horizontal_model(stand, {});
  EXPECT_TRUE(near(frequency_of(model, "upper work roll"), as_both / 2, closed_form));
  EXPECT_TRUE(near(frequency_of(model, "lower work roll"),
                   frequency_of(horizontal_model(stand_on_bearings(2e10), {}), "lower work roll"), closed_form));
}
