#pragma once
#include "core/base/each_member.h"
#include "core/records/records.h"
#include "fem/roll/contact_study.h"
#include "fem/roll/held_roll.h"
#include "reduce/chain/line_contact.h"
#include <optional>

// One roll contact of a stand: its pairs, and the curves that were solved with them.  What its results are made
// of.
namespace mill::fem {
/// The two rolls of a contact, held in each way and on each mesh that a result or its error needs.
struct ContactPairs {
  reduce::CylinderPair closed_form;  ///< the same two rolls, infinitely long, for the contact length
  ContactPair mirrored;         ///< each roll squeezed between two opposite contacts: datum of the closed forms
  ContactPair in_stand;         ///< backup roll on its bearings, work roll on the strip
  ContactPair coarse;           ///< as mirrored, on the companion mesh
  ContactPair in_stand_coarse;  ///< as in_stand, on the companion mesh
  ContactPair whole;            ///< as mirrored, over both sides: for the joint stiffness
  ContactPair whole_coarse;     ///< the same on the companion mesh
  Extent extent = Extent::quarter;
};

/// The same contact by the Fourier engine, which shares neither mesh nor solver with the first.  theory.md 11
struct SecondEngine {
  ContactCurve mirrored, in_stand;         ///< as the curves of the first engine, at the same loads
  BarrelProfile mirrored_at, in_stand_at;  ///< at the first working load
};

template <class Io, class R, if_record<R, SecondEngine> = 0> void each_member(Io &&io, R &record)
{
  auto &[mirrored, in_stand, mirrored_at, in_stand_at] = record;
  io("mirrored", mirrored);
  io("in_stand", in_stand);
  io("mirrored_at", mirrored_at);
  io("in_stand_at", in_stand_at);
}

/// Load-approach curves of the pairs of the same name.
struct ContactCurves {
  ContactCurve mirrored, in_stand, coarse, in_stand_coarse;
  std::optional<SecondEngine> second;  ///< none: rolls or loads that the Fourier engine does not know
};

/// A number with its error, and the answers to the same question that the error was made from.  The member that is
/// one states its unit.
struct Compared {
  double value  = not_given;  ///< unit of the quantity
  double error  = not_given;  ///< -, relative
  double coarse = not_given;  ///< the same unit, of the companion mesh
  double second = not_given;  ///< the same unit, of the Fourier engine; NaN: it was not asked
};
}  // namespace mill::fem
