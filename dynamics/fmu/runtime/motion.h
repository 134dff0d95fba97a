#pragma once
#include "modal_system.h"
#include <complex>
#include <cstddef>
#include <vector>

namespace mill::fmu {
/// Displacement and velocity of n modes.
struct ModalState {
  std::vector<double> q;  ///< (n) m kg^1/2
  std::vector<double> p;  ///< (n) m/s kg^1/2
  /// The same in the coordinates of the poles while modes are coupled; empty otherwise, or when q or p were set.
  std::vector<std::complex<double>> z;
};

/// A force that runs along a straight line from the beginning of a step.
struct StraightForce {
  double start = 0;  ///< N, above the mean force
  double slope = 0;  ///< N/s
};

/// Advances the modes under straight lines of force, exactly but for rounding, for any length of step.
/// Without dampers of gap and oil films every mode has a closed form (35.3); a damper couples them and they are
/// advanced by the poles of the coupled system (35.4), or, where its shapes are so nearly dependent that this
/// would lose digits, by a matrix exponential (35.5).  Lengths met again cost no functions: what is prepared for a
/// length also serves those that differ by the rounding of the times of a client (35.6).
class Motion {
public:
  /// Cost: none without a damper, an eigenproblem of size 2 n with one.
  explicit Motion(const ModalSystem &system);

  /// One straight stretch of force after the other, `length` >= 0 in s.
  /// Cost: O(n), O(n^2) with a matrix exponential; a new length n exponentials, or a matrix exponential.
  void advance(ModalState &state, double length, const StraightForce &force);

  /// A run of several stretches begins and ends: between them the coupled modes stay in the coordinates of their
  /// poles.
  void begin(const ModalState &state);
  void end(ModalState &state);

  /// Accelerations q'' of the modes (n).
  void acceleration(const ModalState &state, double force, std::vector<double> &result) const;

  /// Equilibrium under a constant force (N above the mean).  The system is_held().
  ModalState equilibrium(double force) const;

  enum class Form { separate_modes, poles, exponential };
  Form form() const
  {
    return form_;
  }

private:
  using Complex = std::complex<double>;
  // What one length of step needs, per unit of state, force and slope.
  struct Prepared {
    double length = -1;                                  ///< s
    std::vector<double> qq, qp, qf, qs, pq, pp, pf, ps;  // (n) separate modes
    std::vector<Complex> z, zf, zs;                      // (poles)
    Matrix x;                                            // (2n, 2n), and the columns of force and slope
    std::vector<double> xf, xs;
  };
  const Prepared &prepared_for(double length);
  void prepare(Prepared &step, double length) const;
  void prepare_modes(Prepared &step, double length) const;
  void prepare_poles(Prepared &step, double length) const;
  void prepare_exponential(Prepared &step, double length) const;
  void advance_modes(ModalState &state, const Prepared &step, double rest, const StraightForce &force) const;
  void advance_poles(const Prepared &step, double rest, const StraightForce &force);
  void advance_exponential(const Prepared &step, double rest, const StraightForce &force);

  std::size_t n_;
  std::vector<double> rad_, bite_;
  double damping_;
  std::vector<std::vector<double>> dampers_;  // (r) (n), of the gap and of oil films
  Form form_;
  double fastest_ = 0;  // 1/s, bound of the rates of the system
  std::vector<Prepared> prepared_;
  std::size_t next_place_ = 0;
  // coupled modes: x = [scale q; p], x' = A x + B F
  Matrix A_;
  std::vector<double> x_, y_, w_;
  std::vector<Complex> pole_, gain_, z_;
  ComplexMatrix to_poles_, from_poles_;  // (poles, 2n) and (2n, poles)
};
}  // namespace mill::fmu
