#include "core/model/roller_bearing.h"
#include "core/records/rows_of_bearing.h"
#include "report/bearing/figures.h"
#include "report/contact/pressure_map.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include <algorithm>

namespace mill::report {
namespace {
// A run that compares models has more to show than one by the standard alone; missing parts are then named.
bool is_compared(const Run &run, const std::string &bearing)
{
  return run.manifest.kind == KindOfCase::bearing || stored_curve(run, curve::bearing_law, bearing);
}

// The arrangement of the rows decides the effect of a tilt; the text also states whether the case gives it.
std::string arrangement_sentence(const BearingInfo &info)
{
  const double rows = info("rows"), angle = info("cup_angle");
  if (!(rows > 1) || !(angle > 0) || info.hands.empty())
    return "";
  const bool assumed = info("arrangement_assumed") > 0;
  return " Rows: <code>" + escaped(arrangement_name(info.hands, int(rows))) + "</code>" +
         (assumed ? ", <b>assumed</b>: the case does not give <code>arrangement</code>"
                  : ", as the case gives it") +
         ". The arrangement decides how a tilt shares the load between the rows, their axial forces and the "
         "stiffness against tilting.";
}

// A bearing that is loaded along its axis alone has no secant, and no curve over a radial load.
bool has_radial_load(const Run &run, const std::string &bearing)
{
  const auto names = results_of_bearing(run, bearing);
  return names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string &name) {
           return bool(run.find(row::bearing::secant.of(name)));
         });
}

void sketch(Page &page, const Run &run, const std::string &bearing)
{
  const BearingInfo info = run.bearing(bearing);
  const auto drawings    = bearing_sketch(info);
  if (!drawings.empty())
    page.figure(drawings,
                "The bearing in its chock, to scale. Every row carries axially in one direction only; what "
                "two rows of opposite hand carry cancels as long as nothing tilts." +
                    arrangement_sentence(info) +
                    " The load points downwards, towards the face that carries the chock.");
}

void stiffness(Page &page, const Run &run, const std::string &bearing)
{
  const Table *curve  = stored_curve(run, curve::bearing, bearing);  // of a radial load
  const auto marks    = bearing_loads(run, bearing);
  const Table *rows   = stored_curve(run, curve::bearing_rows, bearing);
  const Table *ring   = stored_curve(run, curve::bearing_rollers, bearing);
  const auto polars   = ring ? roller_polars(*ring) : std::vector<std::string>();
  const bool compared = is_compared(run, bearing);
  if (compared && curve)
    page.figure(
        {force_over_displacement(*curve), stiffness_over_load(*curve, marks)},
        "One bearing (a roll has two) over its radial load. The <b>tangent</b> (solid) is the stiffness for "
        "vibration, the <b>secant</b> (dashed) is load over displacement from the concentric position, "
        "clearance included. The difference between this run and the same with rigid rings is the deflection of "
        "rings, neck and chock; the difference between that and the standard is the law of one roller.");
  std::vector<std::string> drawings;
  if (!compared && curve)
    drawings.push_back(stiffness_over_load(*curve, marks));
  if (rows)
    drawings.push_back(share_bars(*rows));
  if (compared && curve)
    if (const std::string shares = shares_over_load(*curve, marks); !shares.empty())
      drawings.push_back(shares);
  if (polars.size() == 1)
    drawings.push_back(polars[0]);
  if (!drawings.empty())
    page.figure(drawings,
                "Bearing <code>" + escaped(bearing) + "</code>: " +
                    (compared ? "" : "stiffness of <b>one</b> bearing (a roll has two) over its radial load, ") +
                    "the shares of its rows" +
                    (polars.size() == 1
                         ? ", and the load of every roller around the ring (0\u00b0: direction of the "
                           "load). "
                         : ". ") +
                    "Equal shares belong to a load without tilt; the loaded arc narrows with clearance. " +
                    (polars.size() == 1 ? heaviest_roller_sentence(*ring) : ""));
  if (polars.size() > 1)
    page.figure(polars,
                "Load of every roller around the ring, all rows on one scale; 0\u00b0 is the direction of the "
                "load. " +
                    heaviest_roller_sentence(*ring));
  if (!curve && has_radial_load(run, bearing))
    page.absent("Load curves are", curve_path(curve::bearing, bearing) + ".csv");
  if (!rows)
    page.absent("Row shares are", curve_path(curve::bearing_rows, bearing) + ".csv");
  if (!ring)
    page.absent("Roller loads are", curve_path(curve::bearing_rollers, bearing) + ".csv");
  if (const std::string table = rows ? row_table(*rows) : ""; !table.empty())
    page.table(table,
               "The rows at the working load. The stiffness is that of the heaviest roller of the row between "
               "its raceways; its rib is the stop at the big end.");
}

void rollers(Page &page, const Run &run, const std::string &bearing)
{
  std::vector<Mark> heaviest;
  for (const std::string &name : results_of_bearing(run, bearing))
    if (const Result *load = run.find(name + ".roller_max"); load && heaviest.empty())
      heaviest.push_back({1e-3 * load->value, "heaviest roller, " + name});
  if (const Table *law = stored_curve(run, curve::bearing_law, bearing))
    page.figure(roller_law_drawings(*law, heaviest),
                "One roller pressed between its raceways, both contacts in series. The contact elements include "
                "the raceways up to the backs of the rings; the standard and Palmgren do not state what they "
                "include, and in the plane-strain form each slice is independent of its neighbours. All have the "
                "profile of the roller, which makes the "
                "tangent step where slices or rows of elements come into contact.");
  else if (run.manifest.kind == KindOfCase::bearing)
    page.absent("The laws of one roller are", curve_path(curve::bearing_law, bearing) + ".csv");
  if (const Table *tilt = stored_curve(run, curve::bearing_tilt, bearing))
    if (const auto drawings = roller_tilt_drawings(*tilt); !drawings.empty())
      page.figure(drawings, "The heaviest roller tilted at a fixed approach: independent slices compared with the "
                            "contact elements that they replace.");
  std::vector<std::string> maps;
  for (const auto &[raceway, kind] :
       {std::pair("inner", &curve::bearing_pressure_inner), std::pair("outer", &curve::bearing_pressure_outer)})
    if (const Table *map = stored_curve(run, *kind, bearing))
      maps.push_back(pressure_map(*map, std::string("Pressure on the ") + raceway + " raceway",
                                  "distance from mid-roller", 510, 300));
  if (!maps.empty())
    page.figure(maps,
                "Contact pressure of the heaviest roller, one map per raceway, stretched across. A ridge at an "
                "end is an edge load: the profile is too flat for this load or tilt.");
}

void cage(Page &page, const Run &run, const std::string &bearing)
{
  const Table *table = stored_curve(run, curve::bearing_cage, bearing);
  if (!table)
    return;
  page.figure(
      {cage_variation(*table)},
      "Radial stiffness at the working load while the cage turns by one roller pitch: " + cage_sentence(*table) +
          ". This variation excites the roll at the roller-pass frequency, even with perfect parts.");
}

void one_bearing(Page &page, const Run &run, const std::string &bearing)
{
  page.heading("Bearing " + bearing);
  if (oil_film_figures(page, run, bearing))
    return;
  sketch(page, run, bearing);
  stiffness(page, run, bearing);
  rollers(page, run, bearing);
  cage(page, run, bearing);
  published_comparison(page, run, bearing);
  bearing_motion(page, run, bearing);
  own_figures(page, run, curve::bearing.family, bearing);
}
}  // namespace

void bearing_section(Page &page, const Run &run)
{
  auto bearings = items_of(run, curve::bearing);
  for (const std::string &name : items_of(run, curve::bearing_rows))  // without a radial load no curve exists
    if (std::find(bearings.begin(), bearings.end(), name) == bearings.end())
      bearings.push_back(name);
  const bool wanted = run.manifest.kind == KindOfCase::four_high || run.manifest.kind == KindOfCase::bearing;
  if (bearings.empty() && !wanted)
    return;
  page.section("bearings", "Bearings");
  if (bearings.empty())
    page.absent("Bearing figures are", curve_path(curve::bearing, "*") + ".csv");
  for (const std::string &name : bearings)
    one_bearing(page, run, name);
}
}  // namespace mill::report
