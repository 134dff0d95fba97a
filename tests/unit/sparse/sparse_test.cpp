#include "core/base/errors.h"
#include "core/numerics/sparse.h"
#include "tests/support/near.h"
#include <Eigen/Dense>
#include <numeric>
#include <random>

using namespace mill;

namespace {
// A box of springs, three unknowns a node: positive definite, sparse, connected.
struct Box {
  SymmetricSparse K;
  std::vector<int> node;
  Eigen::MatrixXd dense;
};
Box box(const int nx, const int ny, const int nz)
{
  const int n = nx * ny * nz;
  Box b;
  b.dense = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> stiff(0.5, 2);
  const auto id   = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
  const auto link = [&](const int a, const int c) {
    Eigen::Matrix3d d = Eigen::Matrix3d::Random() * 0.2;
    d                 = (stiff(random) * Eigen::Matrix3d::Identity() + d * d.transpose()).eval();
    b.dense.block<3, 3>(3 * a, 3 * a) += d;
    b.dense.block<3, 3>(3 * c, 3 * c) += d;
    b.dense.block<3, 3>(3 * a, 3 * c) -= d;
    b.dense.block<3, 3>(3 * c, 3 * a) -= d;
  };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        if (i + 1 < nx)
          link(id(i, j, k), id(i + 1, j, k));
        if (j + 1 < ny)
          link(id(i, j, k), id(i, j + 1, k));
        if (k + 1 < nz)
          link(id(i, j, k), id(i, j, k + 1));
      }
  b.dense.diagonal().head(3).array() += 1;
  const Eigen::MatrixXd upper = b.dense.triangularView<Eigen::Upper>();
  b.K                         = upper.sparseView();
  b.K.makeCompressed();
  for (int i = 0; i < 3 * n; ++i)
    b.node.push_back(i / 3);
  return b;
}
}  // namespace

TEST(CondensingFactor, TrailingBlockIsTheFactorOfTheSchurComplement)
{
  const Box b = box(7, 6, 5);
  const std::vector<int> kept{4, 300, 31, 62, 93, 5, 620, 419};
  const Eigen::MatrixXd L22 = CondensingFactor(b.K, b.node, kept).schur_factor();
  std::vector<int> rest;
  for (int i = 0; i < b.dense.rows(); ++i)
    if (std::find(kept.begin(), kept.end(), i) == kept.end())
      rest.push_back(i);
  const Eigen::MatrixXd S =
      b.dense(kept, kept) - b.dense(kept, rest) * b.dense(rest, rest).ldlt().solve(b.dense(rest, kept));
  EXPECT_LT((L22 * L22.transpose() - S).norm(), 1e-12 * S.norm()) << "Schur complement by dense elimination";
  EXPECT_LT((inverse_from_factor(L22) * S - Eigen::MatrixXd::Identity(8, 8)).norm(), 1e-10) << "condition of S";
}

TEST(CondensingFactor, SolvesWithAndWithoutRetainedUnknowns)
{
  const Box b             = box(5, 5, 4);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(b.dense.rows(), 3);
  for (const std::vector<int> &kept : {std::vector<int>{}, std::vector<int>{17, 2, 150}}) {
    const Eigen::MatrixXd X = CondensingFactor(b.K, b.node, kept).solve(B);
    EXPECT_LT((b.dense * X - B).norm(), 1e-11 * B.norm()) << "a direct solve, condition about 1e3";
  }
}

// The analysis of a pattern is kept: other values, other retained unknowns and other nodes on it must not be mixed
// up.
TEST(CondensingFactor, OnePatternWithOtherValuesAndOtherRetainedUnknowns)
{
  Box b                           = box(4, 5, 3);
  const Eigen::MatrixXd B         = Eigen::MatrixXd::Random(b.dense.rows(), 2);
  const std::vector<int> each_own = [&] {
    std::vector<int> node(b.node.size());
    std::iota(node.begin(), node.end(), 0);
    return node;
  }();
  for (const double more : {0., 1., 3.})
    for (const std::vector<int> &kept : {std::vector<int>{}, {8, 1}, {1, 8}, {100}})
      for (const std::vector<int> &node : {b.node, each_own}) {
        Box other = b;
        for (int i = 0; i < b.K.cols(); ++i) {
          other.K.coeffRef(i, i) += more * (1 + i % 3);
          other.dense(i, i) += more * (1 + i % 3);
        }
        const CondensingFactor factor(other.K, node, kept);
        EXPECT_LT((other.dense * factor.solve(B) - B).norm(), 1e-11 * B.norm()) << "a direct solve";
        const Eigen::MatrixXd L22 = factor.schur_factor(), inverse = other.dense.inverse()(kept, kept);
        EXPECT_LT((L22 * L22.transpose() * inverse - Eigen::MatrixXd::Identity(L22.rows(), L22.rows())).norm(),
                  1e-9)
            << "the inverse of a Schur complement is a block of the inverse";
      }
}

TEST(CondensingFactor, RefusesWhatIsNotHeld)
{
  Box b                = box(3, 3, 3);
  b.K.coeffRef(80, 80) = -1;
  EXPECT_THROW(CondensingFactor(b.K, b.node, {3}), SolverError);
}

TEST(CondensingFactor, PredictsItsMemoryBeforeFactorising)
{
  const Box b = box(6, 6, 6);
  EXPECT_GT(CondensingFactor(b.K, b.node, {0, 1}).cost().bytes, 8. * 648);
  EXPECT_THROW(CondensingFactor(b.K, b.node, {0, 1}, 1000), SolverError);
}

TEST(Blas, TheReferenceIsRecognisedByItsPath)
{
  EXPECT_TRUE(is_reference_blas("/usr/lib/x86_64-linux-gnu/blas/libblas.so.3.11.0"));
  EXPECT_FALSE(is_reference_blas("/usr/lib/x86_64-linux-gnu/openblas-openmp/libblas.so.3"));
  EXPECT_NE(blas_in_use(), "unknown");
}
