#pragma once
#include "app/run/run_context.h"
#include "core/model/contact_settings.h"
#include "core/records/records.h"
#include <map>
#include <string>
#include <vector>

namespace mill {
struct FourHigh;
struct TwoCylinders;

/// One contact of the stand, solved: its curve and the stiffness at every working load.
struct SolvedContact {
  ContactCurve curve;              ///< each roll squeezed between mirrored contacts: datum of the closed forms
  std::vector<Parameter> tangent;  ///< (passes) N/m
  std::vector<Parameter> secant;   ///< (passes) N/m
};

/// Loads, N, that the curve of a contact runs over: those of the case, or from a tenth of the smallest to twice
/// the largest working load.
/// @param loads  (passes) N, working loads
/// @throws InputError  a given range that does not hold a working load
std::array<double, 2> swept_range(const std::string &name, const ContactSettings &settings,
                                  const std::vector<double> &loads);

/// Solves the roll contacts upper (K3) and lower (K5) by finite elements at the working loads, writes
/// curves/contact-*.csv and fields/*.vtu, and adds K3.*, K5.* and contact.*.* to the results.  A contact whose
/// stiffness is given is not solved and not in the answer.
/// @param loads  (passes) N, working loads
std::map<std::string, SolvedContact> solve_contacts(RunContext &run, const FourHigh &stand,
                                                    const std::vector<double> &loads);

/// The same for kind = "two-cylinders": contact.line.*.
void solve_cylinders(RunContext &run, const TwoCylinders &pair);

/// "976.2 kN"
std::string in_kN(double load);
}  // namespace mill
