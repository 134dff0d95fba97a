#pragma once
#include "app/stages/contact/contact_model.h"
#include "core/records/records.h"
#include <memory>
#include <mutex>
#include <string>

namespace mill {
struct Case;

/// What a roll contact is asked for.
struct PairQuestion {
  double load       = not_given;  ///< N
  double crown      = not_given;  ///< m, of the backup roll; NaN: that of the case
  double work_crown = not_given;  ///< m, of the work roll; NaN: that of the case
  bool in_stand     = false;      ///< rolls held as in the stand; else squeezed between mirrored contacts, as K3
};

/// One solved load.
struct PairState {
  double load = 0, approach = 0;   ///< N, m
  double tangent = 0, secant = 0;  ///< N/m, dF/d(approach) with the nodes that touch; F/approach
  BarrelProfile profile;           ///< along the barrel
  std::vector<char> touching;      ///< (stations nodes_across), of a quarter of the contact, or of a half
  int nodes_across = 0;
  std::string reference;  ///< datum of the approach, one sentence
};

/// A roll contact of a stand, meshed and condensed once, for many loads and crowns.  A load that widens the
/// contact beyond its patch meshes a wider one, once.
class RollPair {
public:
  /// @param name     "upper" or "lower"
  /// @param largest  N, the largest load that the mesh is made for; NaN: twice the working load of the first pass
  /// @throws InputError  no stand; no such contact; as contact_model()
  RollPair(std::shared_ptr<const Case> stand, std::string name, double largest, std::string cache, int threads,
           const Progress &progress);
  ~RollPair();

  /// @throws InputError  a load that is not positive or beyond what the pair was made for; a changed crown of
  /// shifted rolls
  /// @throws SolverError as solve_load()
  /// Cost: some milliseconds.
  PairState solve(const PairQuestion &question);

  double largest_load() const;  ///< N

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};
}  // namespace mill
