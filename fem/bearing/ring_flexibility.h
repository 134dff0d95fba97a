#pragma once
#include "core/base/each_member.h"
#include "core/model/ring_sections.h"
#include "core/process/progress.h"
#include "reduce/bearing/ring_flexibility.h"
#include <string>
#include <vector>

namespace mill::fem {
struct RingOptions {
  int modes           = 3;     ///< Legendre polynomials along a roller
  int chock_harmonics = 8;     ///< for which a block differs from a round housing
  int last_harmonic   = 80;    ///< at which the series ends at the latest
  double share        = 1e-4;  ///< -, of the sum, below which harmonics are left out
};

struct RingResult {
  bearing::RingFlexibility flexibility;
  bearing::RingFlexibility companion;  ///< the same on the coarser meshes; rows = 0: none
  double error_estimate =
      0;  ///< -, change of the whole flexibility under a Stribeck load, coarser mesh against this one
  double chock_difference = 0;     ///< -, block against round housing in the last harmonic of the block
  double truncated        = 0;     ///< -, largest harmonic left out against the sum
  double indefinite       = 0;     ///< -, most negative eigenvalue of a harmonic against the largest of all
  int n_section_unknowns  = 0;     ///< per harmonic, cone with neck and cup with housing
  int n_chock_unknowns    = 0;     ///< of the block as meshed
  std::vector<std::string> notes;  ///< what a reader of the numbers should know, one sentence each
};

template <class Io, class R, if_record<R, RingResult> = 0> void each_member(Io &&io, R &record)
{
  auto &[flexibility, companion, error_estimate, chock_difference, truncated, indefinite, n_section_unknowns,
         n_chock_unknowns, notes] = record;
  io("flexibility", flexibility);
  io("companion", companion);
  io("error_estimate", error_estimate);
  io("chock_difference", chock_difference);
  io("truncated", truncated);
  io("indefinite", indefinite);
  io("n_section_unknowns", n_section_unknowns);
  io("n_chock_unknowns", n_chock_unknowns);
  io("notes", notes);
}

/// How far rings, neck and chock deflect under the rollers beyond the raceway pieces that the law of one roller
/// contains. Bodies of revolution by one factorisation per harmonic; the block by one per symmetry case. theory.md
/// 15
/// @param meshes  of these sections
/// @param coarse  a coarser set, for companion and error estimate; null: none (error_estimate 0)
/// @param threads  cone, cup and the parities of the block are done side by side
/// @throws SolverError  a matrix is not positive definite
/// Cost: some 10 s for four rows at mesh size 1, 1 GB.
RingResult ring_flexibility(const RingSections &sections, const RingMeshes &meshes, const RingMeshes *coarse,
                            const RingOptions &options = {}, const Progress &progress = {}, int threads = 1);

/// m/N: flexibility of the whole bearing's rings along a radial load on the line psi = 0 (towards the chock's
/// support), shared by the rollers of every row as max(0, cos psi)^(10/9), from the mean normal displacement
/// weighted by the load: sum Q w / F^2 with F the radial resultant of the normal loads.  One number to compare two
/// sets of rings.
double stribeck_flexibility(const bearing::RingFlexibility &rings, int rollers_per_row);
}  // namespace mill::fem
