#include "report/plot/envelope.h"
#include "tests/support/near.h"
#include <random>
#include <set>

using namespace mill::report;

TEST(Envelope, KeepsEveryColumnsExtremesAndEnds)
{
  constexpr int n = 200001;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::VectorXd y(n);
  for (double &value : y)
    value = normal(random);
  y[77777]                = 1e3;  // single samples: a decimation by stride would lose them
  y[123456]               = -2e3;
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 0, 900);
  const auto kept         = envelope(x, y, 1.0);
  EXPECT_LE(kept.size(), 4u * 901u);
  const std::set<Eigen::Index> set(kept.begin(), kept.end());
  EXPECT_EQ(set.size(), kept.size()) << "no sample twice";
  EXPECT_TRUE(set.count(77777) && set.count(123456) && set.count(0) && set.count(n - 1));
  for (int column = 0; column < 900; ++column) {
    double largest_all = -1e9, largest_kept = -1e9;
    for (Eigen::Index i = 0; i < n; ++i)
      if (int(x[i]) == column)
        largest_all = std::max(largest_all, y[i]);
    for (const Eigen::Index i : kept)
      if (int(x[i]) == column)
        largest_kept = std::max(largest_kept, y[i]);
    ASSERT_EQ(largest_all, largest_kept) << "column " << column << ", seed 3";
  }
}

TEST(Envelope, FewSamplesStayAll)
{
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(50, 0, 500), y = x.array().sin();
  EXPECT_EQ(envelope(x, y, 1.0).size(), 50u);
  EXPECT_EQ(envelope(Eigen::VectorXd(), Eigen::VectorXd(), 1.0).size(), 0u);
}

TEST(Envelope, IntervalExtremesKeepPeaksAndOrder)
{
  Eigen::VectorXd y          = Eigen::VectorXd::Zero(200001);
  y[1234]                    = 5;
  y[1230]                    = -4;
  y[200000]                  = 7;
  const Eigen::VectorXd kept = interval_extremes(y, 4000);
  ASSERT_EQ(kept.size(), 8000);
  EXPECT_EQ(kept.maxCoeff(), 7);
  EXPECT_EQ(kept.minCoeff(), -4);
  const Eigen::Index k = 1234 * 4000 / 200001;
  EXPECT_EQ(kept[2 * k], -4) << "the trough came first";
  EXPECT_EQ(kept[2 * k + 1], 5);
  EXPECT_EQ(interval_extremes(y.head(8000), 4000).size(), 8000) << "a short record stays as it is";
}
