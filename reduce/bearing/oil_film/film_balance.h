#pragma once
#include "reduce/bearing/oil_film/film_reactions.h"
#include <memory>

namespace mill::bearing {
/// A film that carries its load.
struct BalancedFilm {
  std::shared_ptr<Film> film;
  FilmReactions reactions;
};

/// Finds the displacement at which the film carries `force` along the load and nothing across, by Newton's method
/// in the logarithm of the eccentricity over what is left of the clearance, and its direction.  theory.md 29.3.
/// @param start  displacement is where the search begins when it is not zero
/// @param near   a balanced film of a neighbouring load or of a coarser mesh, or null
/// @throws SolverError  no film carries the load, with how far the search went
BalancedFilm balance_film(FilmProblem problem, const FilmMesh &mesh, double force,
                          const BalancedFilm *near = nullptr);

/// Largest eccentricity ratio in this direction at which rigid surfaces do not touch.
double largest_eccentricity(const FilmProblem &problem, double direction);
}  // namespace mill::bearing
