#pragma once
#include "tests/manual/check/verification.h"

// All cases of the manual, group by group.
namespace mill::verify {
/// The cases of one source file; the suite runs each group as one test (tests/manual.cmake).
struct Group {
  std::string name;    ///< "BearingMotion"
  std::string family;  ///< "bearing"
  std::function<std::vector<Case>()> cases;
};
const std::vector<Group> &groups();

/// Cases that the suite runs with "ctest -C long" only: studies on several meshes and benchmarks of many seconds,
/// to which the other cases of their groups leave little to find.
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
std::vector<Case> elastic_arc_cases();          ///< roll bite: arcs that are not circular
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
