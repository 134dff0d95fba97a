#include "core/numerics/sparse.h"
#include "core/numerics/blas_threads.h"
#include "core/numerics/sparse_analysis.h"
#include "core/process/memory.h"
#include "core/process/stage_work.h"
#include <algorithm>
#include <cholmod.h>
#include <condition_variable>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <mutex>

extern "C" {
void dpotri_(const char *uplo, const int *n, double *a, const int *lda, int *info);
// Of libgomp, which OpenBLAS and CHOLMOD are linked with; a header of another compiler would mean another library.
void omp_set_num_threads(int n);
void omp_set_max_active_levels(int levels);
}

namespace mill {
namespace {
thread_local int threads_of_this = 0;  // 0: they were not set

// CHOLMOD asks for four threads on every machine; a thread for which none were set gives it one.
void use_own_threads()
{
  if (threads_of_this == 0)
    set_blas_threads(1);
}

// Memory reserved for a factorisation until it has allocated it; another one for which no memory is left waits.
class MemoryGrant {
public:
  MemoryGrant(const double needed, const double limit) : bytes(needed)
  {
    std::unique_lock lock(state().access);
    state().returned.wait(lock, [&] { return state().granted == 0 || state().granted + bytes <= limit; });
    state().granted += bytes;
    ++state().holders;
  }
  ~MemoryGrant()
  {
    {
      const std::lock_guard lock(state().access);
      state().granted = --state().holders == 0 ? 0 : state().granted - bytes;
    }
    state().returned.notify_all();
  }
  MemoryGrant(const MemoryGrant &)            = delete;
  MemoryGrant &operator=(const MemoryGrant &) = delete;

private:
  struct State {
    std::mutex access;
    std::condition_variable returned;
    double granted = 0;  // byte
    int holders    = 0;
  };
  static State &state()
  {
    static State one;
    return one;
  }
  double bytes;
};

}  // namespace

struct CondensingFactor::Implementation {
  mutable cholmod_common common;
  cholmod_factor *L = nullptr;
  int n = 0, m = 0;
  FactorCost cost;

  Implementation()
  {
    use_own_threads();
    cholmod_l_start(&common);
    common.print              = 0;
    common.supernodal         = CHOLMOD_SUPERNODAL;
    common.nmethods           = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder          = true;
  }
  ~Implementation()
  {
    if (L)
      cholmod_l_free_factor(&L, &common);
    cholmod_l_finish(&common);
  }
};

CondensingFactor::CondensingFactor(const SymmetricSparse &K, const std::vector<int> &node_of,
                                   const std::vector<int> &retained, const double available)
    : self(std::make_unique<Implementation>())
{
  const int n = self->n = int(K.rows());
  const int m = self->m          = int(retained.size());
  const auto analysis            = analysis_of(K, node_of, retained, self->common);
  const std::string matrix       = name_of_matrix(n);
  const cholmod_factor *symbolic = analysis->symbolic.get();
  self->cost                     = {analysis->n_nonzeros, analysis->n_flops, 8. * double(symbolic->xsize)};
  // While it factorises there are a permuted copy of the matrix and the update of one front; of the Schur
  // complement there are the factor, the inverse and what the caller makes of it.
  const double copies = 20. * double(K.nonZeros()) + 8. * double(symbolic->maxcsize);
  const double needed = self->cost.bytes + copies + 3 * 8. * double(m) * double(m);
  const double limit  = available > 0 ? available : memory_left().bytes;
  if (needed > limit)
    throw no_memory("the factor of " + matrix + " with what is made of it", needed, available);
  const MemoryGrant grant(needed, limit);
  StageWork::add({long(n), self->cost.n_nonzeros, self->cost.n_flops});
  std::vector<double> value(K.nonZeros());
  for (std::size_t k = 0; k < value.size(); ++k)
    value[k] = K.valuePtr()[analysis->value_of[k]];
  cholmod_sparse A{};
  A.nrow = A.ncol = n;
  A.nzmax         = K.nonZeros();
  A.p             = const_cast<std::int64_t *>(analysis->column.data());
  A.i             = const_cast<std::int64_t *>(analysis->row.data());
  A.x             = value.data();
  A.stype         = -1;
  A.itype         = CHOLMOD_LONG;
  A.xtype         = CHOLMOD_REAL;
  A.dtype         = CHOLMOD_DOUBLE;
  A.packed        = 1;
  self->L         = cholmod_l_copy_factor(analysis->symbolic.get(), &self->common);
  if (!self->L)
    throw no_memory("the factor of " + matrix, needed);
  double nothing_added[2] = {0, 0};  // to the diagonal
  cholmod_l_super_numeric(&A, nullptr, nothing_added, self->L, &self->common);
  if (self->common.status == CHOLMOD_OUT_OF_MEMORY)
    throw no_memory("the factor of " + matrix, needed);
  if (self->common.status != CHOLMOD_OK || self->L->minor < std::size_t(n))
    throw SolverError({matrix + " is not positive definite",
                       "the factorisation stopped at unknown " + std::to_string(self->L->minor),
                       "a body that is not held, or an inverted element", "check the supports and the geometry",
                       ""});
}

CondensingFactor::~CondensingFactor()                            = default;
CondensingFactor::CondensingFactor(CondensingFactor &&) noexcept = default;

const FactorCost &CondensingFactor::cost() const
{
  return self->cost;
}

Eigen::MatrixXd CondensingFactor::schur_factor() const
{
  const auto *L                = self->L;
  const auto *super            = static_cast<const SuiteSparse_long *>(L->super);
  const auto *row_ptr          = static_cast<const SuiteSparse_long *>(L->pi);
  const auto *val_ptr          = static_cast<const SuiteSparse_long *>(L->px);
  const auto *rows             = static_cast<const SuiteSparse_long *>(L->s);
  const auto *values           = static_cast<const double *>(L->x);
  const SuiteSparse_long first = self->n - self->m;
  Eigen::MatrixXd out          = Eigen::MatrixXd::Zero(self->m, self->m);
  for (std::size_t k = 0; k < L->nsuper; ++k) {
    const SuiteSparse_long n_rows = row_ptr[k + 1] - row_ptr[k];
    for (SuiteSparse_long j = std::max(super[k], first); j < super[k + 1]; ++j)
      for (SuiteSparse_long i = j - super[k]; i < n_rows; ++i)
        out(rows[row_ptr[k] + i] - first, j - first) = values[val_ptr[k] + (j - super[k]) * n_rows + i];
  }
  return out;
}

Eigen::MatrixXd CondensingFactor::solve(const Eigen::MatrixXd &B) const
{
  use_own_threads();
  cholmod_dense b{};
  b.nrow = b.d     = B.rows();
  b.ncol           = B.cols();
  b.nzmax          = B.size();
  b.x              = const_cast<double *>(B.data());
  b.xtype          = CHOLMOD_REAL;
  b.dtype          = CHOLMOD_DOUBLE;
  cholmod_dense *x = cholmod_l_solve(CHOLMOD_A, self->L, &b, &self->common);
  if (!x)
    throw no_memory("solving for " + std::to_string(B.cols()) + " loads", 16. * double(B.size()));
  Eigen::MatrixXd X = Eigen::Map<Eigen::MatrixXd>(static_cast<double *>(x->x), B.rows(), B.cols());
  cholmod_l_free_dense(&x, &self->common);
  return X;
}

Eigen::MatrixXd inverse_from_factor(const Eigen::MatrixXd &lower)
{
  use_own_threads();
  Eigen::MatrixXd inverse = lower;
  const int n             = int(lower.rows());
  int info                = 0;
  dpotri_("L", &n, inverse.data(), &n, &info);
  inverse.triangularView<Eigen::StrictlyUpper>() = inverse.transpose();
  return inverse;
}

std::string blas_in_use()
{
  Dl_info info{};
  const void *dgemm = dlsym(RTLD_DEFAULT, "dgemm_");
  if (!dgemm || !dladdr(dgemm, &info) || !info.dli_fname)
    return "unknown";
  std::error_code error;
  const auto real =
      std::filesystem::canonical(info.dli_fname, error);  // Debian reaches the flavours through links
  return error ? info.dli_fname : real.string();
}

bool is_reference_blas(const std::string &path)
{
  constexpr const char *fast[] = {"openblas", "mkl", "blis", "atlas"};
  return std::none_of(std::begin(fast), std::end(fast),
                      [&](const char *name) { return path.find(name) != std::string::npos; });
}

const char *fast_blas_kernels()
{
#if defined(__x86_64__)
  const auto core_name = reinterpret_cast<char *(*)()>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  if (core_name == nullptr || std::strcmp(core_name(), "Prescott") != 0)
    return nullptr;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return "Haswell";
#endif
  return nullptr;
}

namespace {
// The pthread flavour of OpenBLAS has one pool for the whole process, whose threads spin while ours work: a run of
// the demo stand took three times the time.  It stays on the calling thread.
void end_pool_of_pthreads()
{
  constexpr int pthreads = 1;  // what openblas_get_parallel() answers
  const auto flavour     = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_parallel"));
  const auto set_threads = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  if (flavour != nullptr && set_threads != nullptr && flavour() == pthreads)
    set_threads(1);
}
}  // namespace

void set_blas_threads(const int n)
{
  [[maybe_unused]] static const bool once = (end_pool_of_pthreads(), true);
  threads_of_this                         = n;
  omp_set_num_threads(n);                    // the openmp flavour of OpenBLAS and CHOLMOD share this pool
  omp_set_max_active_levels(n > 1 ? 1 : 0);  // CHOLMOD names its own number of threads; at level 0 it gets one
}

OneBlasThread::OneBlasThread() : before(threads_of_this)
{
  set_blas_threads(1);
}

OneBlasThread::~OneBlasThread()
{
  if (before > 1)
    set_blas_threads(before);
}
}  // namespace mill
