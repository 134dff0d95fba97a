#include "core/records/bite_model.h"
#include "report/bite/figures.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <cmath>

namespace mill::report {
namespace {
bool has_elements(const BitePass &pass)
{
  return !pass.models.empty() && pass.models.front() == word_of(BiteModel::fe);
}

void along_the_arc(Page &page, const Run &run, const BitePass &pass)
{
  const std::string elements =
      has_elements(pass) ? " The finite elements carry a peak at the entry that grows with every refinement: the "
                           "strip meets the roll at an edge there. It holds little force."
                         : "";
  page.figure(
      {bite_pressure(run, pass), bite_shear(run, pass)},
      "Left: the friction hill. From both ends the pressure rises towards the <b>neutral point</b>, where strip "
      "and roll run equally fast and friction changes sign. Right: friction on the strip, positive where the "
      "roll pulls it in; where it stays inside \u00b1\u00b5p the strip sticks or yields in shear before it "
      "slips." +
          elements);
  const Table *roll = bite_table(run, pass, "roll");
  page.figure(
      {bite_slip(run, pass), roll ? bite_shapes(*roll) : "", roll ? bite_flattening(*roll) : ""},
      std::string("The strip enters slower than the roll and leaves faster; the value at the exit is the forward "
                  "slip; lines as above.") +
          (roll ? " Middle: roll and strip, heights stretched. Right: how far the surface of the loaded roll lies "
                  "off the circle it was ground to, both drawn with the same smallest gap; a circle of another "
                  "radius would be a parabola here."
                : ""));
}

void field(Page &page, const Run &run, const BitePass &pass)
{
  const Table *field = bite_table(run, pass, "field");
  if (!field)
    return;
  page.figure(
      {bite_field(*field, "strain"), bite_field(*field, "strain_rate")},
      "Upper half of the strip; it runs from right to left, heights are stretched. Above: the plastic strain "
      "gathered along the streamlines; a strip that deformed evenly over its thickness would show upright "
      "stripes. Below: where it deforms. Slab theories spread the rate evenly over every upright section; "
      "finite elements gather it in bands that start at the edges of the contact. The darkest step also holds "
      "everything above the scale.");
}

void models(Page &page, const Run &run, const BitePass &pass)
{
  if (const std::string table = bite_model_table(run, pass); !table.empty())
    page.table(table, "One pass by every model that applies to it; in brackets how far each is from the " +
                          std::string(has_elements(pass) ? "finite elements" : "first") +
                          ". Sims' theory assumes sticking friction everywhere and has no coefficient. The slope "
                          "is taken with the arc held. A model that refuses the pass is not listed; its message "
                          "is among the assumptions.");
  if (const std::string table = bite_breakdown_table(run, pass); !table.empty())
    page.table(table, "Where the force comes from, one assumption dropped at a time.");
}

void one_pass(Page &page, const Run &run, const BitePass &pass)
{
  page.heading("Bite of " + pass.name);
  along_the_arc(page, run, pass);
  field(page, run, pass);
  models(page, run, pass);
}

void fit(Page &page, const Run &run)
{
  if (!has_fit(run))
    return;
  page.heading("Friction and flow stress from measured values");
  page.table(
      fit_table(run),
      "Numbers fitted to the measured values of all passes. The intervals hold the standard deviations of the "
      "measurement, the other numbers following; an error of the model, or of a thickness, is not in them. "
      "Bite and K4 of this run are those of the fitted strip.");
  page.figure(
      {fit_region(run)},
      "Inside the closed line lie 95 % of the pairs of friction and flow stress that the measured values allow "
      "together. On each other line one measured value alone is met (its tangent at the fit, six values at most): "
      "where all lines run nearly parallel the values identify <b>one number</b> only, and the region is long.");
  if (const std::string table = fit_residuals(run); !table.empty())
    page.table(table, "How far the fitted model is from every measured value; two in three lie within one, one in "
                      "twenty beyond two.");
}

void stiffness(Page &page, const Run &run)
{
  const std::string relation = k4_relation(run);
  if (relation.empty())
    return;
  page.heading("K4");
  if (const std::string table = k4_table(run); !table.empty())
    page.table(table, "The quantities called K4 of the first pass, over the width of the strip.");
  page.paragraph(relation);
  page.figure(
      k4_curves(run),
      "K4 around the working point, one input changed at a time, by the slab theory; the points are finite "
      "elements on a coarser mesh. The arc is held in the slope and follows the state from point to point.");
  page.figure(bite_force_curves(run), "The force in the same states.");
  page.figure(
      {k4_map(run)},
      "How stiff the bite is over reduction and friction together. Darker is stiffer: thin passes with much "
      "friction are the stiffest. At the lower right the neutral point leaves the arc and no pass exists.");
}
}  // namespace

void bite_section(Page &page, const Run &run)
{
  const auto passes = bite_passes(run);
  if (passes.empty() ||
      run.manifest.kind == KindOfCase::chatter)  // there the bite is a part of the section on chatter
    return;
  page.section("bite", "Roll bite");
  one_pass(page, run, passes.front());
  if (const std::string table = bite_pass_table(run, passes); !table.empty())
    page.table(table, "All passes, by the model that gives K4.");
  fit(page, run);
  stiffness(page, run);
  page.figure(
      {bite_aspect(run, passes)},
      "Where finite elements and slab theories differ: bites of one angle and growing slenderness. <b>Above 1</b> "
      "the finite elements need more force: a thick slab is only pressed in at its surfaces, as by a punch, "
      "which no slab theory contains. <b>Below 1</b> they need less: shear at the surface helps the strip to "
      "yield, which the homogeneous theory leaves out and Orowan's includes in part. Long thin bites with little "
      "friction agree.");
}
}  // namespace mill::report
