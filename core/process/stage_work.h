#pragma once
#include <map>
#include <mutex>
#include <tuple>
#include <vector>

namespace mill {
/// One matrix factorised.
struct Factorisation {
  long order      = 0;  ///< unknowns
  double nonzeros = 0;  ///< of the factor: the fill
  double flops    = 0;  ///< -
  int times       = 1;  ///< how many alike
};

/// Cost of a stage in addition to wall time: processor seconds of its own thread and of those that share its work,
/// and the factorisations.  Stages nest; a factorisation belongs to the innermost.
class StageWork {
public:
  StageWork();  ///< the stage of this thread from here on
  ~StageWork();
  StageWork(const StageWork &)            = delete;
  StageWork &operator=(const StageWork &) = delete;

  double processor_seconds() const;
  std::vector<Factorisation> factorisations() const;  ///< the largest first, those of one size together

  static StageWork *current();                    ///< of this thread; nullptr: none
  static void add(const Factorisation &another);  ///< to the stage of this thread, if there is one

  /// Another thread works for a stage from construction to destruction.
  class Share {
  public:
    explicit Share(StageWork *stage);
    ~Share();
    Share(const Share &)            = delete;
    Share &operator=(const Share &) = delete;

  private:
    StageWork *stage, *before;
    double start;
  };

private:
  StageWork *const outer;
  const double start;
  mutable std::mutex access;
  double shared = 0;  // s, by other threads
  std::map<std::tuple<long, double, double>, int> factors;
};
}  // namespace mill
