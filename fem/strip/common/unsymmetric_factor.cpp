#include "fem/strip/common/unsymmetric_factor.h"
#include "core/numerics/blas_threads.h"
#include "core/process/stage_work.h"
#include <algorithm>
#include <new>
#include <suitesparse/umfpack.h>

namespace mill::fem {
namespace {
// A singular matrix is the caller's to judge; memory is not, and a smaller step would not help.
void require_memory(const int status)
{
  if (status == UMFPACK_ERROR_out_of_memory)
    throw std::bad_alloc();
}
}  // namespace

struct UnsymmetricFactor::Implementation {
  Eigen::SparseMatrix<double> matrix;
  std::vector<Eigen::Triplet<int>> places;  // of the entries last summed; value: where in the matrix
  void *symbolic = nullptr, *numeric = nullptr;
  double control[UMFPACK_CONTROL];
  Implementation()
  {
    umfpack_di_defaults(control);
  }
  ~Implementation()
  {
    umfpack_di_free_numeric(&numeric);
    umfpack_di_free_symbolic(&symbolic);
  }
  bool has_places_of(const int n, const std::vector<Eigen::Triplet<double>> &entries) const
  {
    return matrix.cols() == n && std::equal(entries.begin(), entries.end(), places.begin(), places.end(),
                                            [](const auto &entry, const auto &place) {
                                              return entry.row() == place.row() && entry.col() == place.col();
                                            });
  }
  void find_places(const int n, const std::vector<Eigen::Triplet<double>> &entries)
  {
    matrix.resize(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    places.clear();
    for (const auto &entry : entries) {
      const int *rows = matrix.innerIndexPtr(), *begin = rows + matrix.outerIndexPtr()[entry.col()],
                *end = rows + matrix.outerIndexPtr()[entry.col() + 1];
      places.emplace_back(entry.row(), entry.col(), int(std::lower_bound(begin, end, entry.row()) - rows));
    }
  }
  // The analysis is that of the pattern unless it is forgotten.
  bool factorise(const bool same_pattern)
  {
    const OneBlasThread alone;
    const int n      = int(matrix.cols());
    const int *outer = matrix.outerIndexPtr(), *inner = matrix.innerIndexPtr();
    const double *values = matrix.valuePtr();
    double info[UMFPACK_INFO];
    umfpack_di_free_numeric(&numeric);
    if (!same_pattern || !symbolic) {
      umfpack_di_free_symbolic(&symbolic);
      const int status = umfpack_di_symbolic(n, n, outer, inner, values, &symbolic, control, info);
      require_memory(status);
      if (status < 0)
        return false;
    }
    const int status = umfpack_di_numeric(outer, inner, values, symbolic, &numeric, control, info);
    require_memory(status);
    if (status == UMFPACK_OK)
      StageWork::add({n, info[UMFPACK_LNZ] + info[UMFPACK_UNZ], info[UMFPACK_FLOPS]});
    return status == UMFPACK_OK;
  }
  Eigen::VectorXd solve(const int system, const Eigen::VectorXd &b, const int refinements)
  {
    control[UMFPACK_IRSTEP] = refinements;
    const OneBlasThread alone;
    Eigen::VectorXd x(b.size());
    double info[UMFPACK_INFO];
    const int status = umfpack_di_solve(system, matrix.outerIndexPtr(), matrix.innerIndexPtr(), matrix.valuePtr(),
                                        x.data(), b.data(), numeric, control, info);
    require_memory(status);
    return x;
  }
};

UnsymmetricFactor::UnsymmetricFactor() : self(std::make_unique<Implementation>()) {}
UnsymmetricFactor::~UnsymmetricFactor()                             = default;
UnsymmetricFactor::UnsymmetricFactor(UnsymmetricFactor &&) noexcept = default;

bool UnsymmetricFactor::factorise(const int n, const std::vector<Eigen::Triplet<double>> &entries)
{
  const bool same = self->has_places_of(n, entries);
  if (!same)
    self->find_places(n, entries);
  else {
    double *values = self->matrix.valuePtr();
    std::fill_n(values, self->matrix.nonZeros(), 0.);
    for (std::size_t i = 0; i < entries.size(); ++i)
      values[self->places[i].value()] += entries[i].value();
  }
  return self->factorise(same);
}

Eigen::VectorXd UnsymmetricFactor::solve(const Eigen::VectorXd &b) const
{
  return self->solve(UMFPACK_A, b, 0);
}

Eigen::VectorXd UnsymmetricFactor::solve_transposed(const Eigen::VectorXd &b) const
{
  return self->solve(UMFPACK_At, b, 2);
}
}  // namespace mill::fem
