#include "dynamics/chatter/run_solver.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

namespace mill::dynamics {
struct ChatterIntegrator::Solver {
  ChatterEquations &equations;
  SUNContext context     = nullptr;
  N_Vector state         = nullptr;
  SUNMatrix matrix       = nullptr;
  SUNLinearSolver linear = nullptr;
  void *cvode            = nullptr;
  long earlier_steps     = 0;
  std::string complaint;  // last message of CVODE or of the bite

  explicit Solver(ChatterEquations &e) : equations(e) {}
  Solver(const Solver &)            = delete;
  Solver &operator=(const Solver &) = delete;
  ~Solver()
  {
    CVodeFree(&cvode);
    if (linear)
      SUNLinSolFree(linear);
    if (matrix)
      SUNMatDestroy(matrix);
    if (state)
      N_VDestroy(state);
    SUNContext_Free(&context);
  }

  // A bite that has no answer at a trial state asks for a shorter step (1), as a number that is not finite does.
  template <class Work> int guarded(const Work &work)
  {
    try {
      return work() ? 0 : 1;
    } catch (const InputError &e) {
      complaint = e.problems.front().message;
    } catch (const SolverError &e) {
      complaint = e.report.what;
    }
    return 1;
  }

  static int slope(double, N_Vector z, N_Vector derivative, void *self)
  {
    Solver &s = *static_cast<Solver *>(self);
    double *d = N_VGetArrayPointer(derivative);
    return s.guarded([&] {
      s.equations.slope(N_VGetArrayPointer(z), d);
      return std::all_of(d, d + s.equations.size(), [](const double x) { return std::isfinite(x); });
    });
  }

  static int jacobian(double, N_Vector z, N_Vector, SUNMatrix j, void *self, N_Vector, N_Vector, N_Vector)
  {
    Solver &s            = *static_cast<Solver *>(self);
    const Eigen::Index n = s.equations.size();
    return s.guarded([&] {
      Eigen::Map<Eigen::MatrixXd> J(SUNDenseMatrix_Data(j), n, n);  // both by columns
      s.equations.jacobian(N_VGetArrayPointer(z), J);
      return J.allFinite();
    });
  }

  static int edges(double, N_Vector z, double *value, void *self)
  {
    Solver &s = *static_cast<Solver *>(self);
    return s.guarded([&] {
      s.equations.edge_values(N_VGetArrayPointer(z), value);
      return true;
    });
  }

  static void listen(int, const char *, const char *, char *message, void *self)
  {
    Solver &s = *static_cast<Solver *>(self);
    s.complaint += (s.complaint.empty() ? "" : "; ") + std::string(message);
  }

  void require(const int flag, const char *what) const
  {
    if (flag < 0)
      throw SolverError({fmt::format("chatter: {} failed with flag {}", what, flag), complaint,
                         "memory is exhausted", "shorten the run or lower its rate", ""});
  }

  void start_at(const Eigen::VectorXd &start, const double tolerance)
  {
    const auto n = equations.size();
    require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    state = N_VNew_Serial(n, context);
    std::copy(start.data(), start.data() + n, N_VGetArrayPointer(state));
    cvode = CVodeCreate(CV_ADAMS, context);
    require(CVodeSetErrHandlerFn(cvode, listen, this), "CVodeSetErrHandlerFn");
    require(CVodeInit(cvode, slope, 0, state), "CVodeInit");
    require(CVodeSetUserData(cvode, this), "CVodeSetUserData");
    matrix = SUNDenseMatrix(n, n, context);
    linear = SUNLinSol_Dense(state, matrix, context);
    require(CVodeSetLinearSolver(cvode, linear, matrix), "CVodeSetLinearSolver");
    require(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");

    const Eigen::VectorXd unit = equations.magnitude();
    const double gap           = std::max(start.cwiseQuotient(unit).cwiseAbs().maxCoeff(), 1e-9);  // m
    N_Vector absolute          = N_VClone(state);
    for (Eigen::Index i = 0; i < n; ++i)
      NV_Ith_S(absolute, i) = tolerance * gap * unit[i];
    const int flag = CVodeSVtolerances(cvode, tolerance, absolute);
    N_VDestroy(absolute);
    require(flag, "CVodeSVtolerances");
    require(CVodeSetMaxNumSteps(cvode, 100000), "CVodeSetMaxNumSteps");  // per moment of the record
    // No edge may be crossed and crossed back in one step: a tenth of the period of the rolls on the strip.
    require(CVodeSetMaxStep(cvode, 0.2 * M_PI * unit[0] / unit[equations.structure.n()]), "CVodeSetMaxStep");
    require(CVodeRootInit(cvode, int(equations.edges()), edges), "CVodeRootInit");
    require(CVodeSetNoInactiveRootWarn(cvode), "CVodeSetNoInactiveRootWarn");
  }

  long steps_now() const
  {
    long n = 0;
    CVodeGetNumSteps(cvode, &n);
    return n;
  }
};

ChatterIntegrator::ChatterIntegrator(ChatterEquations &equations, const Eigen::VectorXd &start,
                                     const double tolerance)
    : solver_(std::make_unique<Solver>(equations))
{
  solver_->start_at(start, tolerance);
}

ChatterIntegrator::~ChatterIntegrator() = default;

ChatterIntegrator::Reached ChatterIntegrator::advance(const double time)
{
  Solver &s = *solver_;
  Reached reached{time, {}, ""};
  s.complaint.clear();
  const int flag = CVode(s.cvode, time, s.state, &reached.time, CV_NORMAL);
  if (flag < 0) {
    CVodeGetCurrentTime(s.cvode, &reached.time);
    reached.failure = fmt::format("the integration stops (CVODE flag {}): {}", flag, s.complaint);
  } else if (flag == CV_ROOT_RETURN) {
    reached.crossed.resize(std::size_t(s.equations.edges()));
    s.require(CVodeGetRootInfo(s.cvode, reached.crossed.data()), "CVodeGetRootInfo");
  }
  return reached;
}

void ChatterIntegrator::restart(const double time)
{
  Solver &s = *solver_;
  s.earlier_steps += s.steps_now();
  s.require(CVodeReInit(s.cvode, time, s.state), "CVodeReInit");
}

const double *ChatterIntegrator::state() const
{
  return N_VGetArrayPointer(solver_->state);
}

long ChatterIntegrator::steps() const
{
  return solver_->earlier_steps + solver_->steps_now();
}
}  // namespace mill::dynamics
