#pragma once
#include "reduce/bite/bite.h"
#include <functional>

// Passes and independent integrations that the slab cases share.
namespace mill::verify {
/// 8 -> 5 mm, k 28 MPa, mu 0.2, roll 420 mm, 1 m wide, no tension.
bite::RollBite demo_bite();

/// Constant flow stress, Coulomb, no tension, 1 m wide; lengths in mm, stress in MPa.
bite::RollBite plain_bite(double R, double h1, double h2, double k, double mu);

/// Stand of a tandem mill under an oil film: condition 1, 2 or 3 of Liu et al. (2017) at a roll speed in m/s.
bite::RollBite film_bite(int condition, double roll_speed);

/// By Bland and Ford.
bite::BiteState solved(const bite::RollBite &bite, bite::Arc arc = bite::Arc::hitchcock);

/// Texts of the cases on that stand: where the references come from, up to the names of their entries; the passes.
extern const char *const film_source;
extern const char *const film_passes;

struct Working {
  std::string name;
  bite::RollBite bite;
  bite::BiteState state;
};

/// Condition 1 at 18.9 m/s and condition 2 at 18.2 m/s with their states.
std::vector<Working> working_conditions();

/// Pass 1..5 of a cluster mill (Brusa and Lemma 2009) with a plane-strain flow stress in Pa; Coulomb.
bite::RollBite cluster_bite(int pass, double flow_stress, double mu);

/// Friction law and printed force of those passes.
double cluster_friction(int pass);
double cluster_force(int pass);  ///< N

/// Steady slab equation on a parabola of radius R, integrated by Runge-Kutta from both ends to where the branches
/// meet.
struct SlabIntegral {
  double force;             ///< N, over the strip width
  double neutral_position;  ///< m
};

/// @param full  true: h p' = (h k)' -+ 2 mu p; false: with Bland and Ford's step, h k (p/k)' = p (h' -+ 2 mu)
/// @param mu    Coulomb's
SlabIntegral integrate_slab(const bite::RollBite &bite, double R, double mu, bool full);

/// Smallest x in low..high where a rising function reaches the target, by halving.
double rising_root(double low, double high, double target, const std::function<double(double)> &function);

/// Force, N; +infinity where the flattening has no root and 0 without a neutral point.
double force_or_limit(const bite::RollBite &bite, bite::Arc arc);
}  // namespace mill::verify
