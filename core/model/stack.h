#pragma once
#include "core/model/material.h"
#include "core/model/roll.h"
#include <array>
#include <memory>
#include <string>
#include <vector>

// A roll stack as its engines see it: resolved, SI.  x in the rolling direction, y up, z along the barrels with
// the drive side positive.  theory.md 51
namespace mill {
/// Approach of a roller bearing over its radial load.
struct BearingCurve {
  std::vector<double> load;      ///< (n) N, ascending
  std::vector<double> approach;  ///< (n) m
  std::vector<double> tangent;   ///< (n) N/m, d(load)/d(approach)
};

/// Spring from the axis of a roll to the ground.
struct StackSupport {
  double z                        = 0;                    ///< m, in the roll's own frame
  std::array<double, 2> stiffness = {0, 0};               ///< N/m, along x and y
  std::array<double, 2> motion    = {0, 0};               ///< m, of its foot (eccentrics of saddles)
  std::string bearing;                                    ///< name of the bearing that the spring is; empty: none
  double housing                            = not_given;  ///< N/m, in series with the bearing; absent: rigid
  std::shared_ptr<const BearingCurve> curve = nullptr;    ///< of the bearing, once it is solved
};

/// Force on the axis of a roll.
struct StackLoad {
  double z                    = 0;       ///< m, in the roll's own frame
  std::array<double, 2> force = {0, 0};  ///< N
};

/// Mass on the axis of a roll, a chock.
struct StackLump {
  double z    = 0;  ///< m, in the roll's own frame
  double mass = 0;  ///< kg
};

/// A piece of the shaft with one diameter.
struct StackSection {
  double from = 0, to = 0;  ///< m, in the roll's own frame
  double diameter = 0;      ///< m
};

struct StackRoll {
  std::string name;
  std::string made_of;             ///< name of the listed roll whose mirror image this is; empty: it is listed
  double diameter            = 0;  ///< m, of the barrel or of its rings
  double length              = 0;  ///< m, of the barrel, which may touch
  std::array<double, 2> axis = {0, 0};  ///< m, unloaded
  double shift               = 0;       ///< m, of the roll with its loads along z
  std::vector<StackSection> sections;   ///< of the shaft that bends
  std::vector<StackSupport> supports;
  std::vector<StackLoad> loads;
  std::vector<StackLump> lumps;
  Roll profile;         ///< crown, tables, chamfers of the barrel; other members unused
  bool turned = false;  ///< end for end: its profile is that of -z
  Material material;
};

/// Rolls a and b touch, a nearer to the strip.
struct StackContact {
  std::size_t a = 0, b = 0;                  ///< places in Stack::rolls
  std::vector<std::array<double, 2>> zones;  ///< m, along b, where it has rings; empty: the barrel
  double ring_stiffness = not_given;         ///< Pa, of a ring per length; absent: rigid
};

/// The strip between Stack::upper and Stack::lower.
struct StackStrip {
  double width = 0, offset = 0;                      ///< m
  double force           = 0;                        ///< N
  double modulus         = 0;                        ///< Pa, k_h = -dq/dh
  double entry_modulus   = 0;                        ///< Pa, k_H = dq/dH
  double tension_modulus = 0;                        ///< Pa, k_t
  double arc             = 0;                        ///< m, 2a, length of contact
  double entry_thickness = 0;                        ///< m, mean over the width
  double exit_thickness  = 0;                        ///< m, mean over the width
  std::vector<std::array<double, 2>> entry_profile;  ///< m, (z from the middle of the strip, H - mean)
  double crown_at                 = 0.025;           ///< m, from the edge
  std::array<double, 2> edge_drop = {0.1, 0.025};    ///< m, from the edge
};

struct Stack {
  std::vector<StackRoll> rolls;
  std::vector<StackContact> contacts;
  std::size_t upper = 0, lower = 0;  ///< work rolls at the strip
  StackStrip strip;
};
}  // namespace mill
