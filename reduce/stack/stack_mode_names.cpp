#include "reduce/stack/stack_mode_names.h"
#include "reduce/stack/stations.h"
#include <cmath>
#include <string>

namespace mill::reduce {
namespace {
using Eigen::Index;
using Eigen::VectorXd;

// Of a roll that is one mass.
double up(const MovingStack &moving, const std::size_t roll, const VectorXd &shape)
{
  for (std::size_t i = 0; i < moving.moved.size(); ++i) {
    const MovedRoll &one = moving.moved[i];
    if (one.roll == roll && one.axis == 1 && one.motion == MovedRoll::Motion::translation)
      return shape[Index(i)];
  }
  return 0;
}

KineticShare share_of(const Stack &stack, const MovedRoll &moved, const double kinetic)
{
  const std::string &roll  = stack.rolls[moved.roll].name;
  const std::string across = moved.axis == 1 ? "" : ", horizontal", key = moved.axis == 1 ? "_y" : "_x";
  switch (moved.motion) {
  case MovedRoll::Motion::translation:
    return {"roll " + roll, "roll " + roll + (moved.axis == 1 ? ", vertical" : ", horizontal"),
            "roll_" + roll + key, kinetic};
  case MovedRoll::Motion::tilting:
    return {"tilting of roll " + roll, "tilting of roll " + roll + across, "tilting_" + roll + key, kinetic};
  default:
    return {"bending of roll " + roll, "bending of roll " + roll + across, "bending_" + roll + key, kinetic};
  }
}
}  // namespace

std::vector<GapMotion> gap_motions(const Stack &stack, const StackState &state, const MovingStack &moving,
                                   const StandModel &model, const StandModes &modes)
{
  // A point of a roll by its middle, where the model has it.
  const auto middle = [&](const std::size_t roll, const VectorXd &shape) {
    for (const StandLine &line : model.lines)
      if (line.name == stack.rolls[roll].name) {
        Index nearest;
        (line.z.array() - stack.rolls[roll].shift).abs().minCoeff(&nearest);
        return line.rows.row(nearest).dot(shape);
      }
    return up(moving, roll, shape);
  };
  const VectorXd shares =
      gap_shares(modes.frequency, modes.shape, model.b, model.b.dot(static_displacement(model)));
  std::vector<GapMotion> motions;
  for (Index k = 0; k < shares.size(); ++k) {
    const VectorXd y = modes.shape.col(k), energy = y.cwiseProduct(model.M * y);
    GapMotion motion{modes.frequency[k], shares[k], {{"upper", 0, 0, 0}, {"lower", 0, 0, 0}}, {}};
    for (std::size_t i = 0; i < moving.moved.size(); ++i) {
      const MovedRoll &moved = moving.moved[i];
      const KineticShare one = share_of(stack, moved, energy[Index(i)]);
      motion.stacks[stack.rolls[moved.roll].axis[1] > 0 ? 0 : 1].kinetic += one.kinetic;
      if (!motion.parts.empty() && motion.parts.back().key == one.key)
        motion.parts.back().kinetic += one.kinetic;
      else
        motion.parts.push_back(one);
    }
    for (const auto &[side, roll] : {std::pair(0, stack.upper), std::pair(1, stack.lower)}) {
      StackMotion &of = motion.stacks[std::size_t(side)];
      of.work_roll    = middle(roll, y);
      double carried  = 0;
      for (std::size_t c = 0; c < stack.contacts.size(); ++c)
        if (stack.contacts[c].a == roll) {
          const double vertical = state.pairs[c].force * std::abs(direction_of(stack, stack.contacts[c])[1]);
          of.backup_roll += vertical * middle(stack.contacts[c].b, y);
          carried += vertical;
        }
      of.backup_roll = carried > 0 ? of.backup_roll / carried : of.work_roll;
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}
}  // namespace mill::reduce
