#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

// The verification manual: problems with a known answer, run by name.
namespace mill::verify {
/// How a result is judged against its reference.
enum class Judged {
  relative,  ///< |result - reference| <= tolerance |reference|
  absolute,  ///< |result - reference| <= tolerance
  at_least,  ///< result >= reference
  at_most,   ///< result <= reference
  reported   ///< printed beside the reference, not judged
};

/// A check that was asked for, does not hold, and stays in the manual with its asked reference.
struct KnownDeviation {
  double result;       ///< when the deviation was recorded
  double spread;       ///< how far a later result may be from it, in the unit of the check
  std::string cause;   ///< why the asked reference is not reached
  std::string remedy;  ///< what would reach it
};

struct Check {
  std::string quantity;  ///< "peak pressure"
  std::string unit;      ///< as printed: "MPa", "um", "-"
  double result, reference, tolerance;
  Judged judged = Judged::relative;
  std::optional<KnownDeviation> known = std::nullopt;
};

enum class Verdict {
  pass,             ///< within its bound
  fail,             ///< outside it; not a number; or a known deviation that moved or is gone
  known_deviation,  ///< outside its bound by what was recorded
  reported          ///< not judged
};
Verdict verdict(const Check &check);

/// Verdict is not fail.
bool passes(const Check &check);

Check relative(const std::string &quantity, const std::string &unit, double result, double reference,
               double tolerance);
Check at_most(const std::string &quantity, const std::string &unit, double result, double limit);
Check reported(const std::string &quantity, const std::string &unit, double result, double reference);

/// The check as asked, with the deviation that is known of it.
Check known_deviation(Check asked, const KnownDeviation &known);

/// One page of the manual.
struct Case {
  std::string name;              ///< "cgs1-small"
  std::string kind;              ///< "unit", "verification", "benchmark"
  std::string problem;           ///< what is solved, with which method and how many unknowns; one or two sentences
  std::string source;            ///< of the reference
  std::string tolerance_reason;  ///< why this tolerance and no other
  std::function<std::vector<Check>()> run;
  std::string family = "";  ///< "contact" or "bearing": a name for all its cases; set by all_cases
};

/// All cases, in the order of the manual.
std::vector<Case> all_cases();

// One function per family, each in a file of its name.
std::vector<Case> closed_forms();               ///< formulas and kernels in isolation
std::vector<Case> half_space_cases();           ///< boundary elements on the half space
std::vector<Case> section_cases();              ///< plane strain and axisymmetric bodies
std::vector<Case> solid_cases();                ///< three-dimensional bodies
std::vector<Case> friction_cases();             ///< Coulomb contact
std::vector<Case> nonlinear_cases();            ///< large displacements, plasticity
std::vector<Case> roll_cases();                 ///< rolls, identities, engines, scaling
std::vector<Case> bearing_cases();              ///< roller bearings from the law of one roller
std::vector<Case> roller_cases();               ///< one roller between its raceways by finite elements
std::vector<Case> ring_cases();                 ///< rings, neck and chock
std::vector<Case> bearing_motion_cases();       ///< a mass on a bearing
std::vector<Case> slab_cases();                 ///< roll bite: closed slab theories, film friction, flattening
std::vector<Case> inhomogeneous_cases();        ///< roll bite: Karman, Orowan and Sims integrated
std::vector<Case> elastic_arc_cases();          ///< roll bite: arcs that are no circle
std::vector<Case> strip_flow_cases();           ///< roll bite: rigid-plastic strip by finite elements
std::vector<Case> strip_elastic_cases();        ///< roll bite: elastic-plastic strip by finite elements
std::vector<Case> roll_arc_cases();             ///< flexibility of the roll's surface in the bite
std::vector<Case> mass_cases();                 ///< equivalent masses and the beam model of the stand
std::vector<Case> component_cases();            ///< rolls by their component modes against theory and full models
std::vector<Case> housing_cases();              ///< mill housing by finite elements, screw-down
std::vector<Case> chatter_stand_cases();        ///< bite and stand coupled: eigenvalues, Routh, critical speed
std::vector<Case> chatter_motion_cases();       ///< time simulation of the coupled stand
std::vector<Case> chatter_sensitivity_cases();  ///< derivatives of friction and critical speed, maps
std::vector<Case> chatter_tandem_cases();       ///< several stands with the delay of the strip between them
}  // namespace mill::verify
