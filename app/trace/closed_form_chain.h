#pragma once
#include "app/trace/closed_form_parts.h"
#include "core/case/moving_keys.h"
#include "core/model/lumped_model.h"
#include "core/records/records.h"
#include "reduce/bearing/assembly.h"
#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mill {
struct FourHigh;

struct Case;

/// A stand as its closed forms see it at the load of a pass.
struct ClosedFormStand {
  std::shared_ptr<const FourHigh> stand;  ///< frame on its measured modulus, strip fitted
  LumpedModel model;
};

/// What evaluations of neighbouring cases share: forces that are read once, bearings and responses already solved;
/// and what is asked of them.
struct ClosedFormMemory {
  /// Chains of the last stand that was evaluated, one for each pass, before their modes.
  std::vector<ClosedFormStand> stands;
  bool with_responses = true;  ///< false: no levels of the passes, which take longest
  bool with_inputs    = true;  ///< false: no lists of keys, where numbers alone are asked for
  /// Chains of cases as they stand, by file and settings.
  std::map<std::string, std::vector<ClosedFormResult>> cases;
  std::map<std::string, ForceRecord> forces;           ///< by file, or by the numbers of a made record
  std::map<std::string, std::array<double, 2>> white;  ///< N2/Hz and Hz: white force of the same rms
  /// Bearings in equilibrium, by all that describes them and the radial load in N.
  std::map<std::pair<std::string, double>, bearing::AssemblyState> bearings;
  /// g: upper peak, upper rms, lower peak, lower rms, by force and numbers of the chain
  std::map<std::pair<std::string, std::vector<double>>, std::array<double, 4>> driven;
};

/// Factors on the springs that finite elements would give, by result name: a run's value over the closed one. K_ZW
/// has one for all passes.
using SpringFactors = std::map<std::string, double>;

/// Every result that a case leads to, by closed forms and two cheap stages: chain and response.  theory.md 24
/// The same functions as a run from the springs on; K3, K4, K5 and Kzc by closed_form_parts.h.  The order is that
/// of the relations: contacts, bearings, bite, beam, springs, masses, modes, responses.
///
/// @throws InputError   what the closed forms refuse
/// @throws SolverError  a bearing without equilibrium; a chain that is not held
/// Cost: below 10 ms without responses and lists of keys, 20 ms for each pass of 200 000 output times.
std::vector<ClosedFormResult> closed_form_chain(const Case &the_case, ClosedFormMemory &memory,
                                                const SpringFactors &factors = {});

/// N/m, K_ZW of the backup roll as a stepped beam, by the mass reference of the case, whatever bending_model says.
double beam_stiffness(const FourHigh &stand);
/// The keys of a case for its closed forms; nullptr where no lists are asked for.
std::unique_ptr<MovingKeys> wanted_keys(const ClosedFormMemory &memory, const CaseSpec &spec);
/// Of kind "four-high" and of kind "lumped".
std::vector<ClosedFormResult> closed_form_four_high(const FourHigh &drawn, ClosedFormMemory &memory,
                                                    const SpringFactors &factors);
std::vector<ClosedFormResult> closed_form_lumped(const Case &the_case, ClosedFormMemory &memory);

/// 1 for a spring that has none.
double factor(const SpringFactors &factors, const std::string &name);

/// Lists of a result that is made of others (ClosedFormResult::from), and of keys of its own.
void inherit(ClosedFormResult &result, const std::vector<ClosedFormResult> &all, const KeyList &own_keys);

/// nullptr when absent.
const ClosedFormResult *find(const std::vector<ClosedFormResult> &results, const std::string &name);
}  // namespace mill
