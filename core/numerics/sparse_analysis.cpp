#include "core/numerics/sparse_analysis.h"
#include "core/process/memory.h"
#include "core/process/parallel.h"
#include <algorithm>
#include <cholmod.h>
#include <metis.h>
#include <mutex>
#include <numeric>
#include <optional>
#include <type_traits>

namespace mill {
namespace {
static_assert(std::is_same_v<SuiteSparse_long, std::int64_t>);

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
// one thread at a time, takes longer for it than the factorisation.  The same graph has the same order, so no one
// can tell.
class KnownOrders {
public:
  std::optional<std::vector<idx_t>> find(const NodeGraph &graph)
  {
    const std::lock_guard lock(access);
    const auto match =
        std::find_if(known.begin(), known.end(), [&](const Known &one) { return one.graph == graph; });
    if (match == known.end())
      return std::nullopt;
    std::rotate(known.begin(), match, match + 1);
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
    const std::lock_guard alone(rand_access());
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

// Unknowns in the order in which they are eliminated: by METIS, those to keep last.
std::vector<std::int64_t> elimination_order(const SymmetricSparse &K, const std::vector<int> &node_of,
                                            const std::vector<int> &retained)
{
  const int n = int(K.rows());
  std::vector<char> is_retained(n, 0);
  for (const int i : retained)
    is_retained[i] = 1;
  const std::vector<int> nodes = nested_dissection(K, node_of, is_retained);
  std::vector<int> place(nodes.empty() ? 0 : 1 + *std::max_element(node_of.begin(), node_of.end()), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    place[nodes[i]] = int(i);
  std::vector<std::int64_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  order.erase(std::remove_if(order.begin(), order.end(), [&](const auto i) { return is_retained[i]; }),
              order.end());
  std::stable_sort(order.begin(), order.end(),
                   [&](const auto a, const auto b) { return place[node_of[a]] < place[node_of[b]]; });
  order.insert(order.end(), retained.begin(), retained.end());
  return order;
}

// Symbolic factor of the pattern.
void analyse(FactorAnalysis &out, const SymmetricSparse &K, std::vector<std::int64_t> order,
             cholmod_common &common)
{
  const int n = int(K.rows());
  // Long indices: the factor of a large roll passes 2^31 entries.
  std::vector<std::int64_t> column(K.outerIndexPtr(), K.outerIndexPtr() + n + 1);
  std::vector<std::int64_t> row(K.innerIndexPtr(), K.innerIndexPtr() + K.nonZeros());
  cholmod_sparse A{};
  A.nrow = A.ncol = n;
  A.nzmax         = K.nonZeros();
  A.p             = column.data();
  A.i             = row.data();
  A.x             = const_cast<double *>(K.valuePtr());
  A.stype         = 1;
  A.itype         = CHOLMOD_LONG;
  A.xtype         = CHOLMOD_REAL;
  A.dtype         = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  out.symbolic.reset(cholmod_l_analyze_p(&A, order.data(), nullptr, 0, &common));
  if (!out.symbolic)
    throw no_memory("analysing " + name_of_matrix(n), 0);
  out.n_nonzeros = common.lnz;
  out.n_flops    = common.fl;
}

// Where each value of K stands in the lower triangle that is factorised.
void permute(FactorAnalysis &out, const SymmetricSparse &K)
{
  const int n      = int(K.rows());
  const auto *perm = static_cast<const std::int64_t *>(out.symbolic->Perm);
  std::vector<std::int64_t> place(n);
  for (int i = 0; i < n; ++i)
    place[perm[i]] = i;
  const auto each_entry = [&](const auto &visit) {
    for (int j = 0; j < n; ++j)
      for (int k = K.outerIndexPtr()[j]; k < K.outerIndexPtr()[j + 1]; ++k) {
        const std::int64_t a = place[K.innerIndexPtr()[k]], b = place[j];
        visit(std::max(a, b), std::min(a, b), k);
      }
  };
  out.column.assign(n + 1, 0);
  each_entry([&](std::int64_t, const std::int64_t in, int) { ++out.column[in + 1]; });
  std::partial_sum(out.column.begin(), out.column.end(), out.column.begin());
  out.row.resize(K.nonZeros());
  out.value_of.resize(K.nonZeros());
  std::vector<std::int64_t> next(out.column.begin(), out.column.end() - 1);
  each_entry([&](const std::int64_t row, const std::int64_t in, const int k) {
    out.row[next[in]]        = row;
    out.value_of[next[in]++] = k;
  });
}

// Analyses of the patterns asked for last.  The harmonics of a ring and the load cases of a section have one
// pattern and hundreds of matrices, and the analysis of one takes as long as a third of its factorisation.
class KnownAnalyses {
public:
  std::shared_ptr<const FactorAnalysis> find(const SymmetricSparse &K, const std::vector<int> &node_of,
                                             const std::vector<int> &retained)
  {
    const std::lock_guard lock(access);
    const auto match = std::find_if(known.begin(), known.end(),
                                    [&](const Known &one) { return one.is_of(K, node_of, retained); });
    if (match == known.end())
      return nullptr;
    std::rotate(known.begin(), match, match + 1);
    return known.front().analysis;
  }
  void add(const SymmetricSparse &K, const std::vector<int> &node_of, const std::vector<int> &retained,
           std::shared_ptr<const FactorAnalysis> analysis)
  {
    if (K.nonZeros() > most_nonzeros)
      return;
    const std::lock_guard lock(access);
    known.insert(known.begin(), {{K.outerIndexPtr(), K.outerIndexPtr() + K.cols() + 1},
                                 {K.innerIndexPtr(), K.innerIndexPtr() + K.nonZeros()},
                                 node_of,
                                 retained,
                                 std::move(analysis)});
    Eigen::Index all  = 0;
    const auto beyond = std::find_if(known.begin(), known.end(), [&](const Known &one) {
      return (all += Eigen::Index(one.row.size())) > most_nonzeros;
    });
    known.erase(beyond, known.end());
  }

private:
  static constexpr Eigen::Index most_nonzeros = 4'000'000;  // of all together, some 80 MB
  struct Known {
    std::vector<int> column, row, node_of, retained;
    std::shared_ptr<const FactorAnalysis> analysis;
    bool is_of(const SymmetricSparse &K, const std::vector<int> &nodes, const std::vector<int> &kept) const
    {
      return Eigen::Index(row.size()) == K.nonZeros() && Eigen::Index(column.size()) == K.cols() + 1 &&
             retained == kept && node_of == nodes && std::equal(column.begin(), column.end(), K.outerIndexPtr()) &&
             std::equal(row.begin(), row.end(), K.innerIndexPtr());
    }
  };
  std::mutex access;
  std::vector<Known> known;
};
}  // namespace

OutOfMemory no_memory(const std::string &what, const double needed, const double available)
{
  const MemoryLeft left = memory_left();
  return OutOfMemory(
      {"out of memory: " + what + (needed > 0 ? " needs " + megabytes(needed) : ""),
       (available > 0 ? megabytes(available) + " may be taken for it: " : "") + megabytes(left.bytes) +
           " are left, the limit is set by " + left.end,
       "a finer mesh than this machine or this limit can hold",
       memory_remedy("a coarser mesh (contact.*.elements_per_half_width, dynamics.elements_per_radius)"), ""});
}

std::string name_of_matrix(const int n)
{
  return "a stiffness matrix of " + std::to_string(n) + " unknowns";
}

void FreeSymbolic::operator()(cholmod_factor *L) const
{
  cholmod_common common;
  cholmod_l_start(&common);
  cholmod_l_free_factor(&L, &common);
  cholmod_l_finish(&common);
}

std::shared_ptr<const FactorAnalysis> analysis_of(const SymmetricSparse &K, const std::vector<int> &node_of,
                                                  const std::vector<int> &retained, cholmod_common &common)
{
  static KnownAnalyses known;
  if (auto analysis = known.find(K, node_of, retained))
    return analysis;
  auto made = std::make_shared<FactorAnalysis>();
  analyse(*made, K, elimination_order(K, node_of, retained), common);
  // Postordering may renumber columns; the retained unknowns must still be the last, in their order.
  const auto *perm = static_cast<const std::int64_t *>(made->symbolic->Perm);
  const int n = int(K.rows()), m = int(retained.size());
  for (int i = 0; i < m; ++i)
    if (perm[n - m + i] != retained[i])
      throw std::logic_error("retained unknowns are not last in the factor");
  permute(*made, K);
  known.add(K, node_of, retained, made);
  return made;
}
}  // namespace mill
