#pragma once

namespace mill {
/// The BLAS of this thread on one thread until the end of the scope.  (set_blas_threads, core/numerics/sparse.h,
/// sets those of the calling thread; every other thread has one, because what is shared out by
/// core/process/parallel.h serves more than two threads inside small fronts, which spin while they wait.)
class OneBlasThread {
public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread &)            = delete;
  OneBlasThread &operator=(const OneBlasThread &) = delete;

private:
  int before;
};
}  // namespace mill
