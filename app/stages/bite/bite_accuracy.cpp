#include "app/stages/bite/bite_accuracy.h"
#include "core/numerics/mesh_pair.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
constexpr const char *theories[] = {"karman", "orowan", "bland-ford", "hu-ehmann"};

// The slab theory that is compared with the finite elements, or another one where it has no solution.
const BiteAnswer *slab_beside(const BiteStudy &s)
{
  if (s.slab().refused.empty())
    return &s.slab();
  for (const char *key : theories)
    if (const BiteAnswer *answer = s.find(key))
      return answer;
  return nullptr;
}
}  // namespace

double apart(const double a, const double b)
{
  return std::abs(a / b - 1);
}

double bite_error(const BiteStudy &s, const double value, const double coarse,
                  const std::function<double(const BiteAnswer &)> &same)
{
  std::vector<double> others;
  const BiteAnswer &chosen = s.chosen(), *fe = s.find("fe");
  if (&chosen == fe) {
    const BiteAnswer *slab = slab_beside(s);
    others                 = {value + mesh_pair_safety * (coarse - value), slab ? same(*slab) : not_given};
  } else {
    for (const BiteAnswer &answer : s.answers)
      if (answer.refused.empty() && &answer != &chosen &&
          (&answer == fe || std::count(std::begin(theories), std::end(theories), answer.key)))
        others.push_back(same(answer));
    others.erase(std::remove_if(others.begin(), others.end(), [](const double x) { return std::isnan(x); }),
                 others.end());
  }
  if (s.softer)
    others.push_back(value * same(*s.softer) / same(s.slab()));
  if (s.beyond_circle()) {
    const BiteAnswer *free = s.find("karman-elastic-arc");
    others.push_back(free ? same(*free) : not_given);
  }
  double widest = others.empty() ? not_given : 0;
  for (const double other : others) {
    if (std::isnan(other))
      return not_given;
    widest = std::max(widest, apart(other, value));
  }
  return widest;
}
}  // namespace mill
