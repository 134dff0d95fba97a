#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
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
  Judged judged                       = Judged::relative;
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

/// How many checks of each verdict.
struct Tally {
  std::size_t passed   = 0;
  std::size_t failed   = 0;
  std::size_t known    = 0;  ///< known deviations
  std::size_t reported = 0;  ///< not judged

  std::size_t judged() const
  {
    return passed + failed;
  }
};
Tally tally(const std::vector<Check> &checks);

/// How far two results of one check may be apart, in its unit, before a written one is out of date: the tolerance;
/// the spread of a known deviation; 1 % of a reported value; of a bound 10 % of it or 1 % of the result (a
/// residual far below its bound is round-off, which differs from machine to machine).
double allowed_change(const Check &check);

Check relative(const std::string &quantity, const std::string &unit, double result, double reference,
               double tolerance);
/// Within `tolerance` of the reference, in the unit of the quantity.
Check absolute(const std::string &quantity, const std::string &unit, double result, double reference,
               double tolerance);
/// Between two bounds, without unit.
Check within(const std::string &quantity, double result, double low, double high);
Check at_most(const std::string &quantity, const std::string &unit, double result, double limit);
Check reported(const std::string &quantity, const std::string &unit, double result, double reference);

/// The check as asked, with the deviation that is known of it.
Check known_deviation(Check asked, const KnownDeviation &known);

/// One page of the manual.
struct Case {
  std::string name;              ///< "cgs1-small"
  std::string kind;              ///< "unit", "verification", "benchmark", "regression": see kinds()
  std::string problem;           ///< what is solved, with which method and how many unknowns; one or two sentences
  std::string source;            ///< of the reference
  std::string tolerance_reason;  ///< why this tolerance and no other
  std::function<std::vector<Check>()> run;
  std::string family                    = "";       ///< "contact": a name for all its cases; set by cases_of
  std::function<std::string()> ran_with = nullptr;  ///< of a peer: program, version, date of the run, for the page
  bool long_form                        = false;    ///< names_of_long_form(); set by cases_of
};

/// Thrown by Case::run when what the case needs is not on this machine; says what and how to get it.
struct Skipped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A kind of case and what its reference is.
struct Kind {
  std::string name, meaning;
};
const std::vector<Kind> &kinds();

/// The cases of one source file; the suite runs each group as one test (tests/manual.cmake).
struct Group {
  std::string name;    ///< "BearingMotion"
  std::string family;  ///< "bearing"
  std::function<std::vector<Case>()> cases;
};
const std::vector<Group> &groups();

/// Cases that the suite runs with "ctest -C long" only: studies on several meshes and benchmarks of many seconds, to
/// which the other cases of their groups leave little to find.
const std::vector<std::string> &names_of_long_form();

/// Cases of a group with their families.
std::vector<Case> cases_of(const Group &group);

/// All cases, in the order of the manual: group by group.
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
std::vector<Case> oil_film_cases();             ///< oil-film bearings
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
