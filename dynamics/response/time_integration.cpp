#include "dynamics/response/time_integration.h"
#include "core/base/require.h"
#include "dynamics/response/hold_stepper.h"
#include "dynamics/response/matrix_exponential.h"
#include "dynamics/response/time_walk.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <unordered_map>

namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

// x(n+1) = E11 x + E12 F0 + E13 (F1 - F0)  (7.2), (7.3)
class ExponentialForm {
public:
  ExponentialForm(const StateSpace &system, const double first_force)
      : system_(system), x_(equilibrium(system, first_force))
  {
  }

  struct Over {  // one length of step
    Eigen::MatrixXd E11;
    Eigen::VectorXd E12, E13;
  };
  Over over(const double h) const
  {
    const Eigen::Index s    = system_.A.rows();
    Eigen::MatrixXd G       = Eigen::MatrixXd::Zero(s + 2, s + 2);
    G.topLeftCorner(s, s)   = h * system_.A;
    G.col(s).head(s)        = h * system_.B;
    G(s, s + 1)             = 1;
    const Eigen::MatrixXd E = matrix_exponential(G);
    return {E.topLeftCorner(s, s), E.col(s).head(s), E.col(s + 1).head(s)};
  }

  void advance(const Over &step, const double F0, const double F1)
  {
    next_.noalias() = step.E11 * x_;
    x_              = next_ + step.E12 * F0 + step.E13 * (F1 - F0);
  }

  template <class Column> void output(const double F, Column &&column) const
  {
    column.noalias() = system_.C * x_;
    column += system_.D * F;
  }

  Eigen::VectorXd state() const
  {
    return x_;
  }
  void set_state(const Eigen::VectorXd &state)
  {
    x_ = state;
  }

private:
  const StateSpace &system_;
  Eigen::VectorXd x_, next_;
};

// p1 = (e^z - 1)/z and p2 = (p1 - 1)/z.  The quotients lose eps/|z| and eps/|z|^2 to cancellation, so for small
// |z| the series  p2 = sum z^k/(k+2)!  is summed instead: 14 terms leave 0.5^14/16! = 3e-18 at |z| = 0.5, and the
// quotients lose at most a digit beyond.  (7.5)
struct Phi {
  Complex e, p1, p2;
};
Phi phi(const Complex z)
{
  if (std::abs(z) >= 0.5) {
    const Complex e = std::exp(z), p1 = (e - 1.0) / z;
    return {e, p1, (p1 - 1.0) / z};
  }
  Complex p2 = 0;
  for (int k = 13; k >= 0; --k)
    p2 = 1.0 + p2 * z / double(k + 3);  // Horner on 2 p2 = 1 + z/3 (1 + z/4 (1 + ...))
  p2 /= 2;
  const Complex p1 = 1.0 + z * p2;
  return {1.0 + z * p1, p1, p2};
}

// x = V z with one z per real pole and one per complex pair; z' = lambda z + beta F.
struct Diagonal {
  Eigen::VectorXcd lambda, beta;
  Eigen::MatrixXd C_re, C_im;  // output = C_re Re(z) - C_im Im(z) + D F, pairs counted twice
  Eigen::MatrixXd x_re, x_im;  // x = x_re Re(z) - x_im Im(z)
  Eigen::MatrixXcd from_x;     // z = from_x x
};

// Rounding of the modal form grows with the condition of the eigenvectors: eps * 1e6 = 2e-10 keeps the 1e-9 that
// the two forms are to agree to.
constexpr double largest_condition = 1e6;

std::optional<Diagonal> diagonal(const StateSpace &system)
{
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(system.A);
  const Eigen::VectorXcd all = solver.eigenvalues();
  const Eigen::MatrixXcd V   = solver.eigenvectors();
  // Squares of the singular values of V: eigenvalues of G = V^H V, as those of [Re G -Im G; Im G Re G], each
  // twice.
  const Eigen::MatrixXcd G = V.adjoint() * V;
  Eigen::MatrixXd gram(2 * V.cols(), 2 * V.cols());
  gram << G.real(), -G.imag(), G.imag(), G.real();
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
  constexpr double largest = largest_condition * largest_condition;
  if (solver.info() != Eigen::Success || !(squares[squares.size() - 1] <= largest * squares[0]))
    return std::nullopt;
  const auto factor           = V.partialPivLu();
  const Eigen::VectorXcd beta = factor.solve(system.B.cast<Complex>());
  const Eigen::MatrixXcd C    = system.C.cast<Complex>() * V;
  const Eigen::MatrixXcd W    = factor.inverse();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < all.size(); ++k)
    if (all[k].imag() >= 0)
      kept.push_back(k);
  const auto n = Eigen::Index(kept.size());
  Diagonal d{Eigen::VectorXcd(n),          Eigen::VectorXcd(n),          Eigen::MatrixXd(C.rows(), n),
             Eigen::MatrixXd(C.rows(), n), Eigen::MatrixXd(V.rows(), n), Eigen::MatrixXd(V.rows(), n),
             Eigen::MatrixXcd(n, V.rows())};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index from = kept[std::size_t(k)];
    const double members    = all[from].imag() > 0 ? 2 : 1;
    d.lambda[k]             = all[from];
    d.beta[k]               = beta[from];
    d.C_re.col(k)           = members * C.col(from).real();
    d.C_im.col(k)           = members * C.col(from).imag();
    d.x_re.col(k)           = members * V.col(from).real();
    d.x_im.col(k)           = members * V.col(from).imag();
    d.from_x.row(k)         = W.row(from);
  }
  return d;
}

// z(n+1) = e z + beta h [(p1 - p2) F0 + p2 F1]  (7.4); real and imaginary parts apart, so that the compiler
// works on several modes at once.
class ModalForm {
public:
  ModalForm(const Diagonal &diagonal, const Eigen::VectorXd &D, const double first_force)
      : d_(diagonal), D_(D), C_(d_.C_re.rows(), 2 * d_.lambda.size()), z_(2 * d_.lambda.size())
  {
    C_ << d_.C_re, -d_.C_im;
    const Eigen::VectorXcd z = -first_force * d_.beta.cwiseQuotient(d_.lambda);
    z_ << z.real(), z.imag();
  }

  struct Over {  // one length of step: e, beta h (p1 - p2), beta h p2
    Eigen::ArrayXd er, ei, ar, ai, br, bi;
  };
  Over over(const double h) const
  {
    Over step;
    for (Eigen::ArrayXd *part : {&step.er, &step.ei, &step.ar, &step.ai, &step.br, &step.bi})
      part->resize(d_.lambda.size());
    for (Eigen::Index k = 0; k < d_.lambda.size(); ++k) {
      const Phi f     = phi(d_.lambda[k] * h);
      const Complex a = d_.beta[k] * h * (f.p1 - f.p2), b = d_.beta[k] * h * f.p2;
      step.er[k] = f.e.real(), step.ei[k] = f.e.imag();
      step.ar[k] = a.real(), step.ai[k] = a.imag();
      step.br[k] = b.real(), step.bi[k] = b.imag();
    }
    return step;
  }

  void advance(const Over &step, const double F0, const double F1)
  {
    const Eigen::Index n = step.er.size();
    for (Eigen::Index k = 0; k < n; ++k) {
      const double re = z_[k], im = z_[n + k];
      z_[k]     = step.er[k] * re - step.ei[k] * im + step.ar[k] * F0 + step.br[k] * F1;
      z_[n + k] = step.er[k] * im + step.ei[k] * re + step.ai[k] * F0 + step.bi[k] * F1;
    }
  }

  template <class Column> void output(const double F, Column &&column) const
  {
    column.noalias() = C_ * z_;
    column += D_ * F;
  }

  Eigen::VectorXd state() const
  {
    const Eigen::Index n = d_.lambda.size();
    return d_.x_re * z_.head(n) - d_.x_im * z_.tail(n);
  }
  void set_state(const Eigen::VectorXd &state)
  {
    const Eigen::VectorXcd z = d_.from_x * state.cast<Complex>();
    z_ << z.real(), z.imag();
  }

private:
  const Diagonal &d_;
  const Eigen::VectorXd &D_;
  Eigen::MatrixXd C_;
  Eigen::VectorXd z_;  // real parts, then imaginary parts
};

// Steps of the lengths met so far: a record with gaps has few (and few neighbours of each, by rounding of its
// times), a jittery one as many as samples.
template <class Form> class PreparedSteps {
public:
  explicit PreparedSteps(const Form &form) : form_(form) {}
  const typename Form::Over &operator()(const double length)
  {
    if (length == last_length_)
      return *last_;
    constexpr std::size_t most = 4096;
    auto match                 = steps_.find(length);
    if (match == steps_.end()) {
      ++n_prepared;
      if (steps_.size() == most)
        steps_.clear();
      match = steps_.emplace(length, form_.over(length)).first;
    }
    last_length_ = length;
    return *(last_ = &match->second);
  }
  Eigen::Index n_prepared = 0;

private:
  const Form &form_;
  std::unordered_map<double, typename Form::Over> steps_;
  double last_length_              = 0;
  const typename Form::Over *last_ = nullptr;
};

// Poles where the modal form is wanted and possible.
std::optional<Diagonal> poles_for(const StateSpace &system, const HoldForm wanted)
{
  auto poles = wanted == HoldForm::modal ? diagonal(system) : std::nullopt;
  return poles && (poles->lambda.array().abs() > 0).all() ? poles : std::nullopt;
}

constexpr const char *not_by_modes =
    "repeated poles without independent shapes: integrated with the matrix exponential, not by modes";

template <class Form> void march(Form form, const ForceRecord &force, const OutputGrid &grid, HoldResult &result)
{
  PreparedSteps<Form> over(form);
  form.output(result.force[0], result.output.col(0));
  walk(force, grid, [&](const Step &now) {
    form.advance(over(now.length), now.F0, now.F1);
    if (now.output > 0) {
      result.force[now.output] = now.F1;
      form.output(now.F1, result.output.col(now.output));
    }
  });
  result.n_prepared = over.n_prepared;
}
// Form and prepared steps side by side: the latter look into the former.
template <class Form> struct Stepping {
  explicit Stepping(Form its_form) : form(std::move(its_form)), over(form) {}
  Stepping(const Stepping &)            = delete;
  Stepping &operator=(const Stepping &) = delete;
  Form form;
  PreparedSteps<Form> over;
};
}  // namespace

HoldResult first_order_hold(const StateSpace &system, const ForceRecord &force, const double output_rate,
                            const HoldForm wanted)
{
  require(force.time.size() >= 2 && force.time.size() == force.force.size() && output_rate > 0,
          "a force record needs two samples and a rate above zero");
  const OutputGrid grid = output_grid(force, output_rate);
  HoldResult result;
  result.form      = wanted;
  result.time      = grid.begin + Eigen::ArrayXd::LinSpaced(grid.n, 0, double(grid.n - 1)) * grid.step;
  result.force     = Eigen::VectorXd::Constant(grid.n, force.force[0]);
  result.output    = Eigen::MatrixXd::Zero(system.C.rows(), grid.n);
  const auto poles = poles_for(system, wanted);
  if (poles) {
    march(ModalForm(*poles, system.D, force.force[0]), force, grid, result);
    return result;
  }
  if (wanted == HoldForm::modal)
    result.note = not_by_modes;
  result.form = HoldForm::matrix_exponential;
  march(ExponentialForm(system, force.force[0]), force, grid, result);
  return result;
}

struct HoldStepper::State {
  StateSpace system;
  std::optional<Diagonal> poles;
  std::optional<Stepping<ModalForm>> modal;
  std::optional<Stepping<ExponentialForm>> exponential;
  std::string note;
};

HoldStepper::HoldStepper(const StateSpace &system, const double first_force, const HoldForm wanted)
    : state_(std::make_unique<State>())
{
  State &s = *state_;
  s.system = system;
  s.poles  = poles_for(s.system, wanted);
  if (s.poles) {
    s.modal.emplace(ModalForm(*s.poles, s.system.D, first_force));
    return;
  }
  if (wanted == HoldForm::modal)
    s.note = not_by_modes;
  s.exponential.emplace(ExponentialForm(s.system, first_force));
}

HoldStepper::~HoldStepper() = default;

void HoldStepper::advance(const double length, const double F0, const double F1)
{
  State &s = *state_;
  if (s.modal)
    s.modal->form.advance(s.modal->over(length), F0, F1);
  else
    s.exponential->form.advance(s.exponential->over(length), F0, F1);
}

void HoldStepper::output(const double force, Eigen::Ref<Eigen::VectorXd> column) const
{
  if (state_->modal)
    state_->modal->form.output(force, column);
  else
    state_->exponential->form.output(force, column);
}

Eigen::VectorXd HoldStepper::state() const
{
  return state_->modal ? state_->modal->form.state() : state_->exponential->form.state();
}

void HoldStepper::set_state(const Eigen::VectorXd &state)
{
  if (state_->modal)
    state_->modal->form.set_state(state);
  else
    state_->exponential->form.set_state(state);
}

HoldForm HoldStepper::form() const
{
  return state_->modal ? HoldForm::modal : HoldForm::matrix_exponential;
}

const std::string &HoldStepper::note() const
{
  return state_->note;
}
}  // namespace mill::dynamics
