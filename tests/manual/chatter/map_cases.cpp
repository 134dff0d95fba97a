#include "core/model/case.h"
#include "dynamics/chatter/loop.h"
#include "dynamics/chatter/map.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/chatter/models.h"
#include "tests/manual/check/verification.h"
#include <algorithm>
#include <cmath>

// Conditions 1 and 2 over the speed, and maps of the stability of stand D.
namespace mill::verify {
std::vector<Case> chatter_map_cases();

namespace {
using namespace dynamics;
using bite::RollBite;
std::vector<Check> constant_friction()
{
  std::vector<Check> checks;
  const double reference[2][2]{{21.201916245263902, 10198672.751358245}, {19.738938604434455, 10235726.659873577}};
  for (const int condition : {1, 2}) {
    RollBite bite                   = film_bite(condition, 18.2);
    bite.strip.friction             = Friction{};
    bite.strip.friction.coefficient = 0.04;
    const StandSpeed critical       = critical_speed(chatter_stand("D"), bite, Linearisation::sequential);
    const std::string name          = "condition " + std::to_string(condition) + ", ";
    checks.push_back(absolute(name + "critical speed", "m/s", critical.speed, reference[condition - 1][0], 1e-5));
    checks.push_back(relative(name + "force there", "kN", critical.at->state.force / 1e3,
                              reference[condition - 1][1] / 1e3, 1e-6));
  }
  return checks;
}

std::vector<Check> speed_trend()
{
  const double reference[][3]{
      {5, 22743469.452606227, 0.0770184639197065},    {10, 12121328.554802494, 0.050967252767000204},
      {15, 9538174.736191263, 0.03493853578237074},   {18, 8776325.15939798, 0.028671670597620064},
      {18.2, 8736293.890034175, 0.02832038583977992}, {18.4, 8697337.256368782, 0.027976456267518646},
      {20, 8420175.822830899, 0.02547199031830459},   {25, 7834189.718455815, 0.01989372060158044}};
  std::vector<Check> checks;
  for (const auto &[speed, force, mu] : reference) {
    const bite::BiteState state = working_point(film_bite(2, speed), speed, Linearisation::sequential).state;
    std::string where           = std::to_string(speed);
    where                       = where.substr(0, where.find('.') + 2) + " m/s, ";
    checks.push_back(relative(where + "force", "kN", state.force / 1e3, force / 1e3, 1e-8));
    checks.push_back(relative(where + "friction", "-", state.friction, mu, 1e-8));
  }
  return checks;
}

double different(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  double n = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    n += !(a.data()[i] == b.data()[i] || (std::isnan(a.data()[i]) && std::isnan(b.data()[i])));
  return n;
}

std::vector<Check> maps()
{
  const ChatterStandModel stand = chatter_stand("D");
  const RollBite bite           = film_bite(2, 18.2);
  const auto speed              = Eigen::VectorXd::LinSpaced(30, 1, 30);
  struct Axis {
    MapQuantity quantity;
    double from, to;  // of the quantity of the bite
  };
  std::vector<Check> checks;
  for (const auto &[quantity, from, to] :
       {Axis{MapQuantity::reduction, 0.6, 1.4}, Axis{MapQuantity::tension, 0, 4.5},
        Axis{MapQuantity::viscosity, 0.4, 2}}) {
    const double base     = quantity_of(bite, quantity);
    Eigen::VectorXd value = base * Eigen::VectorXd::LinSpaced(9, from, to);
    value[4]              = base;
    std::sort(value.begin(), value.end());
    const Eigen::Index middle = std::find(value.begin(), value.end(), base) - value.begin();
    const StabilityMap one    = stability_map(stand, bite, Linearisation::sequential, speed, quantity, value, 1);
    const StabilityMap two    = stability_map(stand, bite, Linearisation::sequential, speed, quantity, value, 2);
    const std::string name    = quantity_name(quantity) + ": ";
    checks.push_back(
        absolute(name + "boundary at condition 2", "m/s", one.critical_speed[middle], 18.207252873709336, 1e-5));
    double otherwise = 0, wrong_side = 0;
    for (Eigen::Index j = 0; j < value.size(); ++j)
      for (Eigen::Index i = 0; i < speed.size(); ++i) {
        if (std::isnan(one.growth(i, j)))
          continue;
        const auto position =
            working_point(with_quantity(bite, quantity, value[j]), speed[i], Linearisation::sequential);
        otherwise += (nyquist_count(stand, position.by).unstable > 0) != (one.growth(i, j) > 0);
        // Below the first crossing nothing grows.
        wrong_side += one.growth(i, j) > 0 && speed[i] < one.critical_speed[j];
      }
    checks.push_back(absolute(name + "cells in which Nyquist's criterion says otherwise", "-", otherwise, 0, 0));
    checks.push_back(absolute(name + "cells that grow below the boundary", "-", wrong_side, 0, 0));
    checks.push_back(absolute(name + "cells that differ with two threads", "-",
                              different(one.growth, two.growth) + different(one.frequency, two.frequency) +
                                  different(one.critical_speed, two.critical_speed),
                              0, 0));
    double empty = 0;
    for (Eigen::Index i = 0; i < one.growth.size(); ++i)
      empty += std::isnan(one.growth.data()[i]) != (one.reason.data()[i] != int(NoBite::none));
    checks.push_back(absolute(name + "empty cells without a reason", "-", empty, 0, 0));
  }
  return checks;
}
}  // namespace

std::vector<Case> chatter_map_cases()
{
  const std::string stand = std::string(chatter_stands) + "Condition 2 on stand D at 18.2 m/s. ";
  const std::string liu   = chatter_source;
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const std::string &problem, const std::string &source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("chatter-constant-friction", "regression",
      std::string(chatter_stands) + "Critical speed and force there of conditions 1 and 2 with mu = 0.04.",
      liu + "constant_friction", "1e-5 m/s: root finding; 1e-6 of the force follows from it.", constant_friction);
  add("chatter-speed-trend", "regression",
      "Condition 2: force and friction of the steady bite over the roll speed.", liu + "speed_trend.condition_2",
      "1e-8: fixed points converged to 1e-13.", speed_trend);
  add("chatter-stability-map", "verification",
      stand + "Maps of the growth rate over speed and reduction, tension, viscosity, 30 x 9 cells each: boundary "
              "against the search, the sign of every cell against Nyquist's criterion, one thread against two.",
      liu + "v_crit.D.seq (fitted for condition 2); winding of Nyquist's curve, which knows no eigenvalue",
      "1e-5 m/s: root finding; numbers of roots exact; with two threads the same numbers bit for bit.", maps);
  return cases;
}
}  // namespace mill::verify
