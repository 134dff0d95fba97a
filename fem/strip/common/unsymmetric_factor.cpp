#include "fem/strip/common/unsymmetric_factor.h"
#include "core/numerics/blas_threads.h"
#include "core/process/stage_work.h"
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

bool UnsymmetricFactor::factorise(const Eigen::SparseMatrix<double> &matrix)
{
  const OneBlasThread alone;
  const int n = int(matrix.cols());
  const bool known =
      self->symbolic && self->matrix.cols() == n && self->matrix.nonZeros() == matrix.nonZeros() &&
      std::equal(matrix.outerIndexPtr(), matrix.outerIndexPtr() + n, self->matrix.outerIndexPtr()) &&
      std::equal(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros(), self->matrix.innerIndexPtr());
  self->matrix     = matrix;
  const int *outer = self->matrix.outerIndexPtr(), *inner = self->matrix.innerIndexPtr();
  const double *values = self->matrix.valuePtr();
  double info[UMFPACK_INFO];
  umfpack_di_free_numeric(&self->numeric);
  if (!known) {
    umfpack_di_free_symbolic(&self->symbolic);
    const int status = umfpack_di_symbolic(n, n, outer, inner, values, &self->symbolic, self->control, info);
    require_memory(status);
    if (status < 0)
      return false;
  }
  const int status = umfpack_di_numeric(outer, inner, values, self->symbolic, &self->numeric, self->control, info);
  require_memory(status);
  if (status == UMFPACK_OK)
    StageWork::add({n, info[UMFPACK_LNZ] + info[UMFPACK_UNZ], info[UMFPACK_FLOPS]});
  return status == UMFPACK_OK;
}

bool UnsymmetricFactor::factorise(const int n, const std::vector<Eigen::Triplet<double>> &entries)
{
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return factorise(matrix);
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
