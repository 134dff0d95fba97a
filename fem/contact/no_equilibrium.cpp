#include "fem/contact/no_equilibrium.h"
#include "core/base/errors.h"
#include <string>

namespace mill::contact {
void refuse_undetermined(const std::vector<int> &imposed)
{
  throw SolverError({"contact: the free motions are not determined",
                     std::to_string(imposed.size()) + " free motions, and not as many nodes that can hold them",
                     "fewer nodes than free motions, or a line of action on the very edge of the contact",
                     "impose the tilt as a motion, or move the line of action inwards", ""});
}

void refuse_unreachable(const Support &support, const ScaledModes &modes, const std::vector<int> &imposed,
                        const Loading &loading)
{
  std::string values;
  for (const int j : imposed)
    values += (values.empty() ? "" : ", ") + std::to_string(loading.value[j] * modes.scale[j]);
  const std::string shares = "pressing forces leave " + std::to_string(100 * support.relative_missing) +
                             " % of the imposed resultants (" + values + ") unbalanced";
  if (imposed.size() == 1)
    throw SolverError({"contact: the imposed resultant needs tension", shares,
                       "a contact only presses; the resultant has the wrong sign for every node",
                       "change its sign, or impose the motion", ""});
  throw SolverError(
      {"contact: the line of action lies outside the contact", shares,
       "force and moment together need nodes that pull: the body tips over and its tilt has no bound",
       "move the line of action inside the nodes, or impose the tilt as a motion", ""});
}
}  // namespace mill::contact
