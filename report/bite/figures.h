#pragma once
#include "report/page/page.h"
#include "report/page/run.h"
#include "report/plot/svg_plot.h"
#include <string>
#include <vector>

// What the section on the roll bite consists of.  Every function takes what is stored and leaves out the rest.
namespace mill::report {
/// One pass whose bite the run has solved.
struct BitePass {
  std::string name;                 ///< "pass 1"
  std::string slug;                 ///< "pass-1": curves/bite-<slug>.<model>.csv
  std::vector<std::string> models;  ///< keys of results and files, finite elements first, then the slab theories
};
/// Passes with results bite.<pass>.force, in the order of the run.
std::vector<BitePass> bite_passes(const Run &run);

/// "karman" -> "Kármán, homogeneous"; a key that is not known represents itself.
std::string bite_model_name(const std::string &key);

/// bite.<pass>.<quantity>, or bite.<pass>.<model>.<quantity> with a model, SI; NaN when not stored.
double bite_value(const Run &run, const BitePass &pass, const std::string &quantity,
                  const std::string &model = "");

/// curves/bite-<slug>.<what>.csv; nullptr when not stored.
const Table *bite_table(const Run &run, const BitePass &pass, const std::string &what);

/// Distance of the point where the slip changes sign from the line of centres; NaN when it does not or more than
/// once.
/// @return m
double neutral_point(const Table &arc);

// Drawings along the arc of one pass; empty when nothing is stored to draw.
std::string bite_pressure(const Run &run, const BitePass &pass);
std::string bite_shear(const Run &run, const BitePass &pass);  ///< with Coulomb's limit of the finite elements
std::string bite_slip(const Run &run, const BitePass &pass);
std::string bite_shapes(const Table &roll);      ///< circle, loaded roll and strip over the middle plane
std::string bite_flattening(const Table &roll);  ///< loaded roll over the circle

/// A quantity over the strip in the bite, column by column of the mesh, as coloured cells in their true places.
/// Empty when the table is not such a grid.
/// @param column  "strain", "strain_rate", "pressure", "velocity_x"
std::string bite_field(const Table &field, const std::string &column);

// Tables, HTML; empty when fewer than two things are stored to compare.
std::string bite_model_table(const Run &run, const BitePass &pass);
std::string bite_breakdown_table(const Run &run, const BitePass &pass);
std::string bite_pass_table(const Run &run, const std::vector<BitePass> &passes);
std::string k4_table(const Run &run);

/// The four quantities called K4, how they hang together in this run.  HTML; empty without K4.plastic_slope.
std::string k4_relation(const Run &run);

/// K4 (and the force) over one input each, from curves/bite-k4-*.csv.
std::vector<std::string> k4_curves(const Run &run);
std::vector<std::string> bite_force_curves(const Run &run);

/// K4 of the slab theory over reduction and friction, from curves/bite-k4-map.csv.
std::string k4_map(const Run &run);

// Friction and flow stress from measured values, bite.fit.*; empty when the run has no such fit.
bool has_fit(const Run &run);
std::string fit_table(const Run &run);      ///< values, intervals, what the slab alone gives
std::string fit_residuals(const Run &run);  ///< how far the model is from every measured value
std::string fit_region(const Run &run);     ///< friction against flow stress, with the lines of single values

/// Finite elements over slab theories against arc length over mean thickness; the passes are marked.
std::string bite_aspect(const Run &run, const std::vector<BitePass> &passes);
}  // namespace mill::report
