#include "core/numerics/sparse.h"
#include "core/case/errors.h"
#include "core/numerics/blas_threads.h"
#include "core/process/memory.h"
#include "core/process/parallel.h"
#include "core/process/stage_work.h"
#include <algorithm>
#include <cholmod.h>
#include <condition_variable>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <metis.h>
#include <mutex>
#include <numeric>
#include <omp.h>
#include <optional>

extern "C" {
void dpotri_(const char *uplo, const int *n, double *a, const int *lda, int *info);
}

namespace mill {
namespace {
// `available`: what the caller leaves for it; 0: everything.
SolverError no_memory(const std::string &what, const double needed, const double available = 0)
{
  const MemoryLeft left = memory_left();
  return SolverError({"out of memory: " + what + (needed > 0 ? " needs " + megabytes(needed) : ""),
                      (available > 0 ? megabytes(available) + " may be taken for it: " : "") +
                          megabytes(left.bytes) + " are left, the end is set by " + left.end,
                      "a finer mesh than this machine or this limit can hold",
                      "a coarser mesh (contact.*.elements_per_half_width, dynamics.elements_per_radius), fewer "
                      "threads (--threads), or a higher limit",
                      ""});
}

thread_local int threads_of_this = 0;  // 0: nobody set them

// CHOLMOD asks for four threads whatever the machine has; a thread that nobody set has none to give.
void use_own_threads()
{
  if (threads_of_this == 0)
    set_blas_threads(1);
}

// Memory that a factorisation is granted until it has taken it; another one that no longer fits beside it waits.
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

// What METIS orders: the neighbours of each vertex, one list behind the other.
struct NodeGraph {
  std::vector<idx_t> start{0}, adjacent;
  idx_t size() const
  {
    return idx_t(start.size()) - 1;
  }
  bool operator==(const NodeGraph &other) const
  {
    return start == other.start && adjacent == other.adjacent;
  }
};

// Orders of the small graphs asked for last.  All harmonics of a ring have one graph, and METIS, which works for
// one thread at a time, takes longer for it than the factorisation.  The same graph has the same order, so nobody
// can tell.
class KnownOrders {
public:
  std::optional<std::vector<idx_t>> find(const NodeGraph &graph)
  {
    const std::lock_guard lock(access);
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const Known &one) { return one.graph == graph; });
    if (found == known.end())
      return std::nullopt;
    std::rotate(known.begin(), found, found + 1);
    return known.front().order;
  }
  void add(const NodeGraph &graph, const std::vector<idx_t> &order)
  {
    if (graph.size() > largest)
      return;
    const std::lock_guard lock(access);
    known.insert(known.begin(), {graph, order});
    if (known.size() > most)
      known.pop_back();
  }

private:
  static constexpr idx_t largest    = 20000;  // vertices, some 3 MB
  static constexpr std::size_t most = 16;
  struct Known {
    NodeGraph graph;
    std::vector<idx_t> order;
  };
  std::mutex access;
  std::vector<Known> known;
};

// By METIS: which vertex comes first, second, ...
std::vector<idx_t> nested_dissection(NodeGraph &graph, const long n_unknowns)
{
  static KnownOrders known;
  idx_t n = graph.size();
  if (n == 0)
    return {};
  if (auto order = known.find(graph))
    return *order;
  std::vector<idx_t> order(n), inverse(n);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // results must not depend on the clock
  int status                 = METIS_OK;
  {
    // METIS draws from the C library's rand(), which all threads share: two orderings at once would depend on
    // chance.
    const std::lock_guard alone(random_numbers_of_c());
    status = METIS_NodeND(&n, graph.start.data(), graph.adjacent.data(), nullptr, options, order.data(),
                          inverse.data());
  }
  if (status == METIS_ERROR_MEMORY)
    throw no_memory("ordering a matrix of " + std::to_string(n_unknowns) + " unknowns", 0);
  if (status != METIS_OK)
    throw std::logic_error("METIS refuses the graph of a stiffness matrix");
  known.add(graph, order);
  return order;
}

// Node graph of the unknowns that are not retained, and METIS' order of it.
std::vector<int> nested_dissection(const SymmetricSparse &K, const std::vector<int> &node_of,
                                   const std::vector<char> &is_retained)
{
  const int n_nodes = node_of.empty() ? 0 : 1 + *std::max_element(node_of.begin(), node_of.end());
  std::vector<int> vertex(n_nodes, -1), node_of_vertex;
  for (std::size_t i = 0; i < node_of.size(); ++i)
    if (!is_retained[i] && vertex[node_of[i]] < 0) {
      vertex[node_of[i]] = int(node_of_vertex.size());
      node_of_vertex.push_back(node_of[i]);
    }
  std::vector<std::vector<int>> neighbours(node_of_vertex.size());
  // Two nodes share an entry for each pair of their unknowns, up to nine, mostly one after the other: noted once.
  std::vector<int> seen_from(node_of_vertex.size(), -1);
  for (int j = 0; j < K.outerSize(); ++j) {
    if (is_retained[j])
      continue;
    const int b = vertex[node_of[j]];
    for (SymmetricSparse::InnerIterator it(K, j); it; ++it) {
      const int a = vertex[node_of[it.row()]];
      if (is_retained[it.row()] || a == b || seen_from[a] == b)
        continue;
      seen_from[a] = b;
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  }
  NodeGraph graph;
  for (auto &list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    graph.adjacent.insert(graph.adjacent.end(), list.begin(), list.end());
    graph.start.push_back(idx_t(graph.adjacent.size()));
  }
  std::vector<int> nodes;
  for (const idx_t vertex_in_turn : nested_dissection(graph, long(K.rows())))
    nodes.push_back(node_of_vertex[std::size_t(vertex_in_turn)]);
  return nodes;
}
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
  const int m = self->m = int(retained.size());
  std::vector<char> is_retained(n, 0);
  for (const int i : retained)
    is_retained[i] = 1;

  const std::vector<int> nodes = nested_dissection(K, node_of, is_retained);
  std::vector<int> place(nodes.empty() ? 0 : 1 + *std::max_element(node_of.begin(), node_of.end()), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    place[nodes[i]] = int(i);
  std::vector<SuiteSparse_long> order(n);
  std::iota(order.begin(), order.end(), 0);
  order.erase(std::remove_if(order.begin(), order.end(), [&](const auto i) { return is_retained[i]; }),
              order.end());
  std::stable_sort(order.begin(), order.end(),
                   [&](const auto a, const auto b) { return place[node_of[a]] < place[node_of[b]]; });
  order.insert(order.end(), retained.begin(), retained.end());

  // Long indices: the factor of a large roll passes 2^31 entries.
  const std::vector<SuiteSparse_long> column(K.outerIndexPtr(), K.outerIndexPtr() + n + 1);
  const std::vector<SuiteSparse_long> row(K.innerIndexPtr(), K.innerIndexPtr() + K.nonZeros());
  cholmod_sparse A{};
  A.nrow = A.ncol = n;
  A.nzmax         = K.nonZeros();
  A.p             = const_cast<SuiteSparse_long *>(column.data());
  A.i             = const_cast<SuiteSparse_long *>(row.data());
  A.x             = const_cast<double *>(K.valuePtr());
  A.stype         = 1;
  A.itype         = CHOLMOD_LONG;
  A.xtype         = CHOLMOD_REAL;
  A.dtype         = CHOLMOD_DOUBLE;
  A.sorted = A.packed      = 1;
  const std::string matrix = "a stiffness matrix of " + std::to_string(n) + " unknowns";
  self->L                  = cholmod_l_analyze_p(&A, order.data(), nullptr, 0, &self->common);
  if (!self->L)
    throw no_memory("analysing " + matrix, 0);
  self->cost = {self->common.lnz, self->common.fl, 8. * double(self->L->xsize)};
  // While it factorises, CHOLMOD holds a permuted copy of the matrix and the update of one front; of the Schur
  // complement there are the factor, the inverse and what the caller makes of it.
  const double copies = 16. * double(K.nonZeros()) + 8. * double(self->L->maxcsize);
  const double needed = self->cost.bytes + copies + 3 * 8. * double(m) * double(m);
  const double limit  = available > 0 ? available : memory_left().bytes;
  if (needed > limit)
    throw no_memory("the factor of " + matrix + " with what is made of it", needed, available);
  const MemoryGrant grant(needed, limit);
  StageWork::add({long(n), self->cost.n_nonzeros, self->cost.n_flops});
  // Postordering may renumber columns; the retained unknowns must still be the last, in their order.
  const auto *perm = static_cast<const SuiteSparse_long *>(self->L->Perm);
  for (int i = 0; i < m; ++i)
    if (perm[n - m + i] != retained[i])
      throw std::logic_error("retained unknowns are not last in the factor");
  cholmod_l_factorize(&A, self->L, &self->common);
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
  return path.find("openblas") == std::string::npos && path.find("mkl") == std::string::npos &&
         path.find("blis") == std::string::npos && path.find("atlas") == std::string::npos;
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

void set_blas_threads(const int n)
{
  threads_of_this = n;
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
