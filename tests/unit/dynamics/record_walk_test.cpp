// Records sample by sample: the same stretches, steps and spectra as of a whole record.
#include "dynamics/response/hold_stepper.h"
#include "dynamics/response/record_walk.h"
#include "dynamics/response/response.h"
#include "dynamics/response/running_spectrum.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <cmath>
#include <random>

using namespace mill;
using namespace mill::dynamics;

namespace {
ForceRecord noise(const Eigen::Index n, const double spacing, const double jitter, const bool gaps)
{
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(-1, 1);
  ForceRecord record{Eigen::VectorXd(n), Eigen::VectorXd(n), {}};
  double position = 0.125;
  for (Eigen::Index i = 0; i < n; ++i) {
    record.time[i]  = position;
    record.force[i] = 976e3 + 1e3 * any(engine);
    position += spacing * (1 + jitter * any(engine)) * (gaps && i % 97 == 50 ? 7 : 1);
    if (jitter == 0 && !gaps)
      position = 0.125 + double(i + 1) * spacing;
  }
  return record;
}

RecordSurvey survey_of(const ForceRecord &record)
{
  RecordSurvey survey;
  for (Eigen::Index i = 0; i < record.time.size(); ++i)
    survey.add(record.time[i], record.force[i]);
  return survey;
}

const std::vector<ForceRecord> &records()
{
  static const std::vector<ForceRecord> all{noise(1000, 1e-4, 0, false),  noise(1000, 5e-5, 0, false),
                                            noise(700, 1.5e-4, 0, false), noise(1000, 1e-4, 0.3, false),
                                            noise(1000, 1e-4, 0, true),   noise(300, 7.123e-6, 0, false),
                                            noise(40, 1e-3, 0.1, false)};
  return all;
}
}  // namespace

TEST(RecordWalk, VisitsTheStretchesOfTheWholeRecord)
{
  for (std::size_t r = 0; r < records().size(); ++r) {
    const ForceRecord &record = records()[r];
    std::vector<Step> whole, fed;
    const OutputGrid grid = output_grid(record, 20e3);
    walk(record, grid, [&](const Step &s) { whole.push_back(s); });
    const RecordSurvey survey = survey_of(record);
    EXPECT_EQ(survey.is_even(), r != 3 && r != 4 && r != 6) << r;
    RecordWalk walker(survey, 20e3);
    EXPECT_EQ(walker.grid().n, grid.n);
    for (Eigen::Index i = 0; i < record.time.size(); ++i)
      walker.add(record.time[i], record.force[i], [&](const Step &s) { fed.push_back(s); });
    ASSERT_EQ(fed.size(), whole.size()) << "record " << r;
    for (std::size_t k = 0; k < fed.size(); ++k) {
      EXPECT_EQ(fed[k].length, whole[k].length) << r << " " << k;
      EXPECT_EQ(fed[k].F0, whole[k].F0);
      EXPECT_EQ(fed[k].F1, whole[k].F1);
      EXPECT_EQ(fed[k].output, whole[k].output);
    }
  }
}

TEST(RecordWalk, StepsGiveTheResponseOfTheWholeRecord)
{
  const auto system = driven_model(mill_model(published_stand(), settings(ForceMeaning::measured, 0.01))).system;
  for (const HoldForm form : {HoldForm::modal, HoldForm::matrix_exponential})
    for (const ForceRecord &record : {records()[0], records()[4]}) {
      const HoldResult whole = first_order_hold(system, record, 20e3, form);
      HoldStepper stepper(system, record.force[0], form);
      EXPECT_EQ(stepper.form(), form);
      RecordWalk walker(survey_of(record), 20e3);
      Eigen::VectorXd column(system.C.rows());
      stepper.output(record.force[0], column);
      EXPECT_TRUE(near(column, whole.output.col(0), within(1e-12, "rounding of D F, 500 m/s2", 500)));
      Eigen::Index last = 0;
      for (Eigen::Index i = 0; i < record.time.size(); ++i)
        walker.add(record.time[i], record.force[i], [&](const Step &s) {
          stepper.advance(s.length, s.F0, s.F1);
          if (s.output == 0)
            return;
          stepper.output(s.F1, column);
          EXPECT_EQ(s.output, last + 1);
          last = s.output;
          EXPECT_TRUE(near(column, whole.output.col(last), within(1e-12, "rounding of D F, 500 m/s2", 500)));
        });
      EXPECT_EQ(last, whole.time.size() - 1);
    }
}

TEST(RecordWalk, SurveyKnowsTheMeanOfALongRecord)
{
  RecordSurvey survey;
  for (int i = 0; i < 1000000; ++i)
    survey.add(1e-4 * i, 0.1 + (i % 2 ? 1e6 : -1e6));
  EXPECT_TRUE(near(survey.mean(), 0.1, within(1e-9, "compensated sum of terms 1e7 times as large")));
  EXPECT_EQ(survey.largest, 1e6 + 0.1);
  EXPECT_TRUE(survey.is_even());
}

TEST(RecordWalk, RunningSpectrumIsThatOfTheWholeSignal)
{
  const Eigen::VectorXd signal = noise(5000, 1e-4, 0, false).force;
  const Spectrum whole         = amplitude_spectral_density(signal, 1e4);
  RunningSpectrum running(1e4, segment_length_for(signal.size(), 1 << 17), signal.mean());
  EXPECT_EQ(running.spectrum().n_segments, 0);
  for (const double value : signal)
    running.add(value);
  const Spectrum fed = running.spectrum();
  EXPECT_EQ(fed.n_segments, whole.n_segments);
  EXPECT_EQ(fed.segment_length, whole.segment_length);
  EXPECT_EQ(fed.frequency, whole.frequency);
  EXPECT_TRUE(near(fed.density, whole.density, within(1e-12, "order of a sum")));
  EXPECT_EQ(segment_length_for(1 << 24, 1 << 17), 1 << 17);
}
