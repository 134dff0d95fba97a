#pragma once
#include "chatter_motion.h"
#include "curve_motion.h"
#include "force_series.h"
#include "log.h"
#include "motion.h"
#include "variables.h"
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

namespace mill::fmu {
/// Where an instance is in its life.  FMI 3 has no call between the first and the third.
enum class Phase : int { instantiated, set_up, initialization, step, intermediate, terminated, failed };

using Reference = std::uint32_t;  ///< value reference: place in the table of variables

/// What a client has set use_stored_force to.
enum class StoredForce : int { not_set, off, on };

/// All that changes in an instance while it runs: what a copy of its state holds.
struct Snapshot {
  std::vector<double> values;  ///< of every real variable, by reference, SI
  ModalState modes;
  ChatterState vibration;                ///< of kind "chatter" alone
  double force      = 0;                 ///< N, at the present time
  double slope      = 0;                 ///< N/s, of the input over the coming step
  double last_slope = 0;                 ///< N/s, of the force at the end of the last step
  double time = 0, start = 0, stop = 0;  ///< s
  bool has_stop          = false;
  StoredForce use_stored = StoredForce::not_set;
  bool input_set         = false;  ///< the client has given a bite force
  bool outputs_stale     = false;  ///< values of the outputs are those before the last step
  bool ended             = false;  ///< the strip tore or the rolls met in the last step
  std::uint64_t place    = 0;      ///< samples of the series at or before the present time
  Phase phase            = Phase::instantiated;
};

/// One exported model in the hands of a client: what both versions of the interface share.  A call that is refused
/// writes the reason into the log and changes nothing.  theory.md 35
class Instance {
public:
  /// Reads the model.
  /// @param folder   of the resources, ends with a slash
  /// @param version  of the interface, 2 or 3
  /// @throws std::runtime_error  there is no model, or it has another token
  Instance(std::string folder, const std::string &token, std::unique_ptr<Log> log, int version);

  /// The client gives the bite force inside the steps: the stored force is then played only where
  /// use_stored_force asks for it.
  void expect_force()
  {
    force_expected_ = true;
  }

  Log &log() const
  {
    return *log_;
  }
  Phase phase() const
  {
    return now_.phase;
  }
  double time() const
  {
    return now_.time;
  }
  void fail()  ///< after an error of our own: only freeing and Reset are left
  {
    now_.phase = Phase::failed;
  }
  /// Is the call allowed in this phase?  Otherwise a message names the function and the phase.
  bool allows(const char *function, std::initializer_list<Phase> phases) const;

  // The order of a run; times in s.
  Status set_up(const char *function, double start, bool has_stop, double stop);
  Status enter_initialization(const char *function);
  Status exit_initialization(const char *function);
  Status terminate(const char *function);
  Status reset(const char *function);

  // Values, in SI; all of a call or none.
  Status get(const char *function, const Reference *references, std::size_t n, double *values);
  Status set(const char *function, const Reference *references, std::size_t n, const double *values);
  Status get_truth(const char *function, const Reference *references, std::size_t n, bool *values);
  Status set_truth(const char *function, const Reference *references, std::size_t n, const bool *values);
  Status get_whole(const char *function, const Reference *references, std::size_t n, std::int32_t *values);
  Status set_whole(const char *function, const Reference *references, std::size_t n);
  /// Of a type that no variable has: right for none, refused for any.
  Status refuse_type(const char *function, const Reference *references, std::size_t n, const char *type) const;
  /// Derivatives of inputs by time, of order 1, for the coming step alone; of outputs at the present time.
  Status set_input_derivatives(const char *function, const Reference *references, std::size_t n, const int *orders,
                               const double *values);
  Status get_output_derivatives(const char *function, const Reference *references, std::size_t n,
                                const int *orders, double *values);

  /// Partial derivatives that a client wants: along a direction of the knowns, or adjoint, along one of the
  /// unknowns.
  struct Direction {
    const Reference *unknowns;
    std::size_t n_unknowns;
    const Reference *knowns;
    std::size_t n_knowns;
    const double *seed;
    double *result;
    bool adjoint;
  };
  /// By the force and by the time exactly but for rounding; by a parameter from differences of fourth order, to
  /// about 1e-9 of the derivative.  Cost: four evaluations of the model for each known.  theory.md (35.8)
  Status derivative(const char *function, const Direction &asked);

  /// Can a step from `from` over `length` (s) be taken?  Otherwise a message says why: error, or discard where
  /// version 3 may go on with other values (there is no steady bite).
  Status may_step(const char *function, double from, double length);
  /// Carries out a step that may_step() accepts.  Exact for the force received where the stand is linear.  Where
  /// the strip of kind "chatter" tears or its rolls meet inside the step, the instance stays at that moment,
  /// ended() is true and a message says why.  @return  then discard in version 2, and ok in version 3, whose
  /// clients ask ended() and keep the rows before
  /// @throws std::runtime_error  kind "chatter": this happens at the start of the run; kind "curves": see
  /// CurveMotion
  Status do_step(const char *function, double from, double length);
  bool ended() const
  {
    return now_.ended;
  }
  /// In the middle of a step: the client sets the force that acts at its end.
  void enter_intermediate();
  void leave_intermediate(double length);

  // Copies of the state; the pointers are those of the interface.
  Status copy(const char *function, void **state) const;
  Status restore(const char *function, const void *state);
  Status free_copy(const char *function, void **state) const;
  Status serialized_size(const char *function, const void *state, std::size_t *size) const;
  Status serialize(const char *function, const void *state, char *bytes, std::size_t size) const;
  Status deserialize(const char *function, const char *bytes, std::size_t size, void **state) const;

  static constexpr Reference bite_force = 1;  ///< the input

private:
  bool may_get(const char *function) const;
  const Variable *known(const char *function, Reference reference, Type type) const;
  Status compute(const char *function, const Reference *references, std::size_t n, Type type);
  bool may_set(const char *function, const Variable &variable) const;
  bool in_range(const char *function, const Variable &variable, double value) const;
  bool of_order_one(const char *function, const Variable &variable, int order) const;
  bool may_derive(const char *function, const Direction &asked) const;
  void set_start_values();
  Tuning tuning_of(const std::vector<double> &values) const;
  void use_parameters();
  void bring_up_to_date();
  double first_force();
  void settle(double force);
  void load_series();
  bool plays_series() const;
  void play_series(double end);
  void drive(double end);
  double mean() const;
  void travel(double length, const StraightForce &force);
  /// @param rates_at  null: modes themselves; else `modes` are the rates of these
  void evaluate(const ModalState &modes, double force, std::vector<double> &values,
                const ModalState *rates_at = nullptr);
  double stored_force_rate() const;
  std::vector<double> unknowns_at(std::vector<double> values, double more_force, const Direction &asked);
  std::vector<double> by_known(const Direction &asked, Reference known);
  bool is_copy(const char *function, const void *state) const;
  bool may_hold(const Snapshot &state) const;
  // Kind "chatter".
  PassData pass_of(const std::vector<double> &values) const;
  double bite_number(BiteNumber number) const;
  std::string solve_pass();
  ChatterInput input_now() const;
  void evaluate_vibration();
  std::string vibrate(double &end);
  Status end_run(const char *function, const std::string &why);

  std::string folder_;
  std::unique_ptr<Log> log_;
  ModelData model_;
  std::vector<Variable> variables_;
  std::uint64_t mark_ = 0;  // of this model, in its copies
  ForceSeries series_;
  Snapshot now_;
  int version_;
  bool force_expected_ = false;
  double force_at_end_ = 0;  // N, given by the client in the middle of a step
  bool end_is_given_   = false;
  double force_before_ = 0;

  Tuning built_;  // parameters for which system_ and motion_ were made
  ModalSystem system_;
  std::unique_ptr<Motion> motion_;
  std::unique_ptr<CurveMotion> curves_;     // of kind "curves": steps instead of motion_
  std::unique_ptr<ChatterMotion> chatter_;  // of kind "chatter": steps instead of both
  std::vector<double> built_pass_;          // parameters for which it was made
  std::vector<double> scratch_, row_;
};

/// Short decimal text for messages, with a point in every locale.
std::string number_text(double value);
}  // namespace mill::fmu
