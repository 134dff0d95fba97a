#pragma once
#include "flow_stress_law.h"
#include "friction_law.h"
#include "refuse_input.h"
#include <string>
#include <type_traits>
#include <vector>

// The part of resources/model.json that only kind "chatter" has: a stand whose bite belongs to the model.
namespace mill::fmu {
/// The pass, its roll and the laws of its strip, SI.
struct PassData {
  double entry_thickness = 0, exit_thickness = 0;  ///< m
  double entry_tension = 0, exit_tension = 0;      ///< Pa
  double width             = 0;                    ///< m
  double initial_thickness = 0;                    ///< m, where the strain is zero; 0: that of the entry
  double roll_radius       = 0;                    ///< m, before it is flattened
  double roll_speed        = 0;                    ///< m/s
  double youngs_modulus = 0, poisson_ratio = 0;    ///< Pa, -, of the roll
  std::string scheme;                              ///< sequential | implicit | frozen_friction

  FlowStress flow;
  Friction friction;
};

/// n unknowns of the stand, c contacts between work and backup rolls.
struct ChatterData {
  std::vector<double> stiffness, damping;  ///< (n * n by rows) 1/s^2, 1/s: M^-1 K, M^-1 C
  std::vector<double> force_row;           ///< (n) 1/kg, M^-1 b
  std::vector<double> gap_row;             ///< (n) -, b: gap change = b . x
  std::vector<double> point;               ///< (m * n by rows) -, points away from the strip
  std::vector<double> displaced;           ///< (n) -, x with both work rolls 1 m away from the strip
  std::vector<double> contact_row;         ///< (c * n by rows) -, approach of the two rolls
  std::vector<double> contact_force_row;   ///< (c * n by rows) 1/kg, M^-1 of it
  std::vector<double> contact_stiffness;   ///< (c) N/m
  std::vector<double> magnitude;           ///< (2n + 2) motion of each state that goes with a gap change of 1 m
  double entry_distance = 0, exit_distance = 0;  ///< m, of free strip
  double strip_modulus = 0, strip_density = 0;   ///< Pa, kg/m3
  double longest_step = 0;                       ///< s, so that no edge is crossed and crossed back
  double start        = 0;                       ///< m, displacement of both work rolls at the start
  PassData pass;
};

// The name of a law, and the constants that it reads.
template <class IO, class Law, class Named, class Constants>
void each_of_law(IO &io, const char *name, Law &law, const Named &named, const Constants &constants)
{
  std::string word = name_of(law.law);
  io(name, word);
  if constexpr (!std::is_const_v<Law>)
    law.law = named(word);
  for (const auto &constant : constants)
    if (reads(law, constant.member))
      io(constant.key, law.*constant.member);
}
template <class IO, class Rows> void each_of_table(IO &io, Rows &rows)
{
  std::vector<double> strain, stress;
  for (const auto &row : rows) {
    strain.push_back(row[0]);
    stress.push_back(row[1]);
  }
  io("strain", strain);
  io("stress", stress);
  if constexpr (!std::is_const_v<Rows>) {
    if (stress.size() != strain.size())
      refuse_input("a table of the flow stress has another number of strains than of stresses");
    rows.clear();
    for (std::size_t i = 0; i < strain.size(); ++i)
      rows.push_back({strain[i], stress[i]});
  }
}

template <class IO, class P> void each_member(IO &io, P &pass, const PassData *)
{
  io("entry_thickness", pass.entry_thickness);
  io("exit_thickness", pass.exit_thickness);
  io("entry_tension", pass.entry_tension);
  io("exit_tension", pass.exit_tension);
  io("width", pass.width);
  io("initial_thickness", pass.initial_thickness);
  io("roll_radius", pass.roll_radius);
  io("roll_speed", pass.roll_speed);
  io("youngs_modulus", pass.youngs_modulus);
  io("poisson_ratio", pass.poisson_ratio);
  io("scheme", pass.scheme);
  each_of_law(io, "flow_law", pass.flow, flow_stress_law, flow_stress_constants());
  each_of_table(io, pass.flow.table);
  each_of_law(io, "friction_law", pass.friction, friction_law, friction_constants());
}
template <class IO, class C> void each_member(IO &io, C &chatter, const ChatterData *)
{
  io("stiffness", chatter.stiffness);
  io("damping", chatter.damping);
  io("force_row", chatter.force_row);
  io("gap_row", chatter.gap_row);
  io("point", chatter.point);
  io("displaced", chatter.displaced);
  io("contact_row", chatter.contact_row);
  io("contact_force_row", chatter.contact_force_row);
  io("contact_stiffness", chatter.contact_stiffness);
  io("magnitude", chatter.magnitude);
  io("entry_distance", chatter.entry_distance);
  io("exit_distance", chatter.exit_distance);
  io("strip_modulus", chatter.strip_modulus);
  io("strip_density", chatter.strip_density);
  io("longest_step", chatter.longest_step);
  io("start", chatter.start);
  io("pass", chatter.pass);
}
}  // namespace mill::fmu
