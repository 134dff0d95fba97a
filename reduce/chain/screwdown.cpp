#include "reduce/chain/screwdown.h"
#include "core/base/errors.h"
#include "reduce/chain/quoted_mm.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::reduce {
namespace {
constexpr double n_sides = 2;

bool given(const double value)
{
  return !std::isnan(value);
}
double disc(const double diameter)
{
  return 0.25 * M_PI * diameter * diameter;
}

struct Length {
  const char *key;
  double Screwdown::*value;
};
const Length screw_diameter{"screw_diameter", &Screwdown::screw_diameter},
    screw_length{"screw_length", &Screwdown::screw_length},
    nut_outside_diameter{"nut_outside_diameter", &Screwdown::nut_outside_diameter},
    nut_height{"nut_height", &Screwdown::nut_height},
    piston_diameter{"piston_diameter", &Screwdown::piston_diameter},
    piston_length{"piston_length", &Screwdown::piston_length}, stroke{"stroke", &Screwdown::stroke},
    load_cell_diameter{"load_cell_diameter", &Screwdown::load_cell_diameter},
    load_cell_bore{"load_cell_bore", &Screwdown::load_cell_bore},
    load_cell_height{"load_cell_height", &Screwdown::load_cell_height};

class Checks {
public:
  Checks(const Screwdown &s, const Material &steel) : drawing(s)
  {
    for (const Length &length : {screw_diameter, screw_length, nut_outside_diameter, nut_height, piston_diameter,
                                 piston_length, stroke, load_cell_diameter, load_cell_height})
      if (given(s.*length.value) && !(s.*length.value > 0))
        refuse(std::string("screwdown.") + length.key + " = " + quoted_mm(s.*length.value) +
               " must be positive: give the length of the drawing, or leave the key out");
    for (const auto &[key, modulus] :
         {std::pair{"screwdown.nut_modulus", s.nut_modulus}, std::pair{"screwdown.oil_modulus", s.oil_modulus},
          std::pair{"youngs_modulus", steel.youngs_modulus}})
      if (!(modulus > 0))
        refuse(std::string(key) + " = \"" + short_number(modulus / 1e6) + " MPa\" must be positive");
  }
  void refuse(const std::string &message)
  {
    problems.push_back({{}, message, {}});
  }
  // `having` is not a spring without `missing`.
  void needs(const Length &having, const Length &missing, const char *why)
  {
    if (given(drawing.*having.value) && !given(drawing.*missing.value))
      refuse(std::string("screwdown.") + having.key + " = " + quoted_mm(drawing.*having.value) +
             " is given without screwdown." + missing.key + ", " + why + ": give it, or leave both out");
  }
  void done() const
  {
    if (!problems.empty())
      throw InputError(problems);
  }

private:
  const Screwdown &drawing;
  std::vector<Problem> problems;
};

void require(const Screwdown &s, const Material &steel)
{
  Checks checks(s, steel);
  checks.needs(screw_diameter, screw_length, "how long the screw is between nut and piston");
  checks.needs(screw_length, screw_diameter, "the diameter of its core");
  checks.needs(nut_outside_diameter, nut_height, "over which the thread carries");
  checks.needs(nut_height, nut_outside_diameter, "how much bronze stands around the screw");
  if (given(s.nut_height) && given(s.nut_outside_diameter) && !given(s.screw_diameter))
    checks.needs(nut_height, screw_diameter, "the bore of the nut");
  checks.needs(stroke, piston_diameter, "the area of the oil");
  checks.needs(piston_length, piston_diameter, "its section");
  if (given(s.piston_diameter) && !given(s.stroke) && !given(s.piston_length))
    checks.refuse("screwdown.piston_diameter = " + quoted_mm(s.piston_diameter) +
                  " is given without screwdown.stroke (oil column) or screwdown.piston_length (piston): give one "
                  "of them, or leave it out");
  checks.needs(load_cell_diameter, load_cell_height, "how high its ring is");
  checks.needs(load_cell_height, load_cell_diameter, "its section");
  if (given(s.nut_outside_diameter) && given(s.screw_diameter) && !(s.nut_outside_diameter > s.screw_diameter))
    checks.refuse("screwdown.nut_outside_diameter = " + quoted_mm(s.nut_outside_diameter) +
                  " is not larger than screwdown.screw_diameter = " + quoted_mm(s.screw_diameter) +
                  ": the nut goes around the screw; exchange them or correct one");
  if (s.load_cell_bore < 0)
    checks.refuse("screwdown.load_cell_bore = " + quoted_mm(s.load_cell_bore) + " is negative: 0 is a solid cell");
  if (s.load_cell_bore > 0 && !given(s.load_cell_diameter))
    checks.needs(load_cell_bore, load_cell_diameter, "its outside");
  if (given(s.load_cell_diameter) && s.load_cell_bore >= s.load_cell_diameter)
    checks.refuse("screwdown.load_cell_bore = " + quoted_mm(s.load_cell_bore) +
                  " is not smaller than screwdown.load_cell_diameter = " + quoted_mm(s.load_cell_diameter) +
                  ": nothing would carry the load; correct one of them");
  checks.done();
}

double in_series(const std::vector<double> &springs)
{
  double flexibility = 0;
  for (const double k : springs)
    if (given(k))
      flexibility += 1 / k;
  return 1 / flexibility;
}
}  // namespace

double thread_flexibility(const double height, const double screw, const double nut)
{
  return height / 5 * (1 / screw + 1 / nut);
}

ScrewdownSprings screwdown_springs(const Screwdown &s, const Material &steel)
{
  require(s, steel);
  const double E = steel.youngs_modulus, core = disc(s.screw_diameter), face = disc(s.piston_diameter);
  ScrewdownSprings k;
  if (given(s.stroke))
    k.oil_column = n_sides * s.oil_modulus * face / s.stroke;  // (23.13)
  if (given(s.piston_length))
    k.piston = n_sides * E * face / s.piston_length;  // (23.14)
  if (given(s.screw_length))
    k.screw = n_sides * E * core / s.screw_length;
  if (given(s.nut_height))
    k.nut = n_sides /
            thread_flexibility(s.nut_height, E * core, s.nut_modulus * (disc(s.nut_outside_diameter) - core));
  if (given(s.load_cell_height))
    k.load_cell = n_sides * E * (disc(s.load_cell_diameter) - disc(s.load_cell_bore)) / s.load_cell_height;
  return k;
}

FrameWithScrewdown frame_with_screwdown(const Frame &frame, const Screwdown &drawing, const Material &steel)
{
  const ScrewdownSprings k = screwdown_springs(drawing, steel);
  FrameWithScrewdown out{frame, {}};
  const auto replace = [&](const std::string &key, double Frame::*member, const double value,
                           const std::string &parts) {
    out.replaced.push_back({"frame." + key, member, parts, frame.*member, value});
    out.frame.*member = value;
  };
  if (given(k.oil_column))
    replace("oil_column_stiffness", &Frame::oil_column_stiffness, k.oil_column, "oil column");
  std::string names;
  int n_parts    = 0;
  const auto add = [&](const char *part, const double stiffness) {
    if (!given(stiffness))
      return;
    names += (names.empty() ? "" : ", ") + std::string(part);
    ++n_parts;
  };
  add("screw", k.screw);
  add("nut", k.nut);
  add("piston", k.piston);
  if (!names.empty())
    replace("piston_stiffness", &Frame::piston_stiffness, in_series({k.screw, k.nut, k.piston}),
            n_parts > 1 ? names + " in series" : names);
  if (given(k.load_cell))
    replace("load_cell_stiffness", &Frame::load_cell_stiffness, k.load_cell, "load cell");
  return out;
}
}  // namespace mill::reduce
