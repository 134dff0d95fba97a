#pragma once
#include "fem/stack/block_factors.h"
#include "fem/stack/stacked_roll.h"
#include "reduce/stack/line_law.h"
#include <functional>
#include <map>

namespace mill::fem {
/// A contact of two rolls, station by station.  What the flexibility of the rolls leaves out: the part of the
/// flattening that depends on the width of the contact.  theory.md (51.17)
struct StationedContact {
  std::size_t contact = 0;  ///< place in Stack::contacts
  std::size_t a = 0, b = 0, line_a = 0, line_b = 0;
  ContactStations stations;
  Eigen::VectorXd gap;  ///< (N) m, of the undeformed profiles
  reduce::LineLaw law;
  std::array<double, 2> reach = {0, 0};  ///< m, c_i of (51.17)
  double first_width          = 0;       ///< m, b_0 of (51.17) for every usual load
  double width                = 0;       ///< m, b_0 of (51.17) as it is
  double least_width          = 0;       ///< m, of a station with hardly any load
  Eigen::VectorXd force;                 ///< (N) N
  Eigen::VectorXd slope;                 ///< (N) 1/Pa, of closing_of() at the last factors
  std::vector<char> touching;

  double closing_of(double line_load) const;  ///< m
  double slope_of(double line_load) const;    ///< 1/Pa
};

/// Right side of a linear problem of a half, and its solution.
struct HalfVector {
  std::vector<Eigen::VectorXd> contact;  ///< of each contact: (N) m, or forces N
  std::vector<Eigen::VectorXd> motion;   ///< of each roll: resultants N, N m, or motions m, rad
  Eigen::VectorXd strip;                 ///< (n) m, displacement of the work roll's surface towards its axis
};

/// The rolls on one side of the strip.  Contacts couple only through the rolls that they share: they are
/// eliminated one by one, level by level from the backing rolls to the strip, and a roll's motions after the
/// contacts on which it leans.  theory.md (51.16), (51.18)
class HalfStack {
public:
  /// @param at_strip  stations of the strip; read  places where the opening is read
  HalfStack(const Stack &stack, std::vector<std::size_t> rolls,
            const std::vector<std::shared_ptr<const RollKernel>> &kernels, std::size_t work_roll, int planes,
            const ContactStations &at_strip, const ContactStations &read, double longest_station);

  std::vector<StationedContact> contacts;

  /// Settings of the stack as they are now: shifts, supports, loads, profiles.  What stays is kept.
  /// @param before  the stack as it was
  /// @return        whether a flexibility changed, so that factorise() has to follow
  bool follow(const Stack &before);

  /// At the present forces of the contacts, with wider b_0 of (51.17) where one needs it.
  /// @throws SolverError  a roll is not held
  void factorise();
  /// b_0 of every contact as its present forces need it.  @param may_shrink  else it only grows
  /// @return  whether one changed, so that factorise() has to follow
  bool fit_widths(bool may_shrink);
  /// (n, n) m/N, of the strip's line with everything behind it.
  const Eigen::MatrixXd &at_strip() const
  {
    return by_strip;
  }
  /// Solution without load of the strip; `strip` is its displacement there.
  HalfVector without_strip(const HalfVector &right) const;
  /// Adds what the forces of the strip do.
  void add_strip(HalfVector &solution, const Eigen::VectorXd &strip_force) const;

  HalfVector zero() const;
  HalfVector unloaded() const;  ///< gaps and offsets, resultants of the loads
  HalfVector of_loads(std::size_t roll, const std::vector<StackLoad> &loads) const;
  /// Opening of every contact by the displacements that these forces and motions cause, without closing_of(); zero
  /// of one that touches everywhere.
  std::vector<Eigen::VectorXd> openings(const HalfVector &state, const Eigen::VectorXd &strip_force,
                                        const HalfVector &right) const;
  /// (7) m, displacement of the work roll where it is read, without that by loads and supports.
  Eigen::VectorXd read(const HalfVector &state, const Eigen::VectorXd &strip_force) const;
  Eigen::VectorXd read_unloaded() const;
  Eigen::VectorXd read_of_loads(std::size_t roll, const std::vector<StackLoad> &loads) const;
  StackedRoll::Deflection deflection(std::size_t roll, const HalfVector &state,
                                     const Eigen::VectorXd &strip_force) const;
  /// N, largest resultant of a roll that is not in balance.
  double imbalance(const HalfVector &state, const Eigen::VectorXd &strip_force) const;
  bool holds(std::size_t roll) const
  {
    return place.count(roll) > 0;
  }
  const std::vector<std::size_t> &rolls() const
  {
    return names;
  }

private:
  [[noreturn]] void not_held(std::size_t roll) const;  ///< @param roll  place in `stacked`
  [[noreturn]] void no_pressing(const StationedContact &contact) const;
  // The forces of a contact's touching stations, or the motions of a roll.
  struct Unknowns {
    bool is_force;
    std::size_t item;                 // contact, or roll of the half
    std::vector<Eigen::Index> entry;  // stations or motions
    Eigen::Index size() const
    {
      return Eigen::Index(entry.size());
    }
  };
  HalfVector right_of(const std::function<RollAnswer(std::size_t)> &answer_of) const;
  void make_contacts();
  void place_stations(StationedContact &contact, double force) const;
  void set_width(StationedContact &contact, double width) const;
  double width_for(const StationedContact &contact) const;
  void add_again(const std::vector<char> &rolls);
  void add_lines(const std::vector<char> &of_roll);
  void make_nodes();
  std::vector<std::vector<std::size_t>> graph() const;
  std::vector<std::size_t> order_of_elimination() const;
  void list_touching();
  Eigen::MatrixXd coupling(const Unknowns &one, const Unknowns &other) const;
  Eigen::MatrixXd coupling_with_strip(const Unknowns &one) const;
  bool is_coupled(const Unknowns &one, const Unknowns &other) const;
  bool is_at_strip(const Unknowns &one) const;
  std::vector<Eigen::VectorXd> nothing() const;
  std::vector<std::pair<std::size_t, std::size_t>> lines_on(std::size_t roll) const;  // contact, line
  void put(const std::vector<Eigen::VectorXd> &x, HalfVector &to) const;
  std::vector<Eigen::VectorXd> forces_on(std::size_t roll, const HalfVector &state,
                                         const Eigen::VectorXd &strip_force) const;

  const Stack &stack;
  std::vector<std::size_t> names;
  std::map<std::size_t, std::size_t> place;
  std::vector<StackedRoll> stacked;
  std::size_t work_roll, strip_line = 0, read_line = 0;
  ContactStations at_strip_line, at_read_line;
  double longest;
  std::vector<Unknowns> nodes;  // contacts, then rolls with motions; the strip is the node after them
  BlockFactors factors;
  Eigen::MatrixXd by_strip;
  double scale = 1;
};
}  // namespace mill::fem
