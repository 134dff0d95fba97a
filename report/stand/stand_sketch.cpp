#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include "report/results/tables.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace mill::report {
namespace {
constexpr double top = 46, pitch = 92, box_width = 250, box_height = 38;  // px, the chain
constexpr double height = top + 6 * pitch + 2 * 50 + 20;

// Lengths of the drawing in px from lengths of the stand in m.
struct Rolls {
  double scale, x, y;  // px/m, px of mid-length, px of the pass line
  const std::map<std::string, double> &length;
  double operator()(const char *name) const
  {
    return length.at(name) * scale;
  }
};

bool has_geometry(const Run &run)
{
  for (const char *name : {"work_roll_diameter", "work_roll_length", "work_neck_diameter", "work_total_length",
                           "work_bearing_span", "backup_diameter", "backup_length", "backup_neck_diameter",
                           "backup_neck_length", "backup_bearing_span", "strip_width"})
    if (const auto match = run.manifest.geometry.find(name);
        match == run.manifest.geometry.end() || !(match->second > 0))
      return false;
  return true;
}

double mass_y(const int mass)  // M1 .. M6
{
  return top + 50 + (mass - 0.5) * pitch;
}

void draw_roll(Svg &svg, const Rolls &rolls, const double y, const double barrel, const double diameter,
               const double neck_end, const double neck)
{
  svg.rect(rolls.x - neck_end, y - neck / 2, 2 * neck_end, neck, "steel");
  svg.rect(rolls.x - barrel / 2, y - diameter / 2, barrel, diameter, "steel");
  svg.line(rolls.x - neck_end - 10, y, rolls.x + neck_end + 10, y, "centreline");
}

void draw_bearings(Svg &svg, const Rolls &rolls, const double y, const double span, const double neck)
{
  const double width = 0.45 * neck, outside = 1.3 * neck;
  for (const double side : {-0.5, 0.5}) {
    const double x = rolls.x + side * span;
    svg.rect(x - width / 2, y - outside / 2, width, outside, "bearing");
    svg.line(x - width / 2, y - outside / 2, x + width / 2, y + outside / 2, "bearing");
    svg.line(x - width / 2, y + outside / 2, x + width / 2, y - outside / 2, "bearing");
  }
}

void draw_width(Svg &svg, const double x, const double y, const double width, const std::string &label)
{
  svg.line(x - width / 2, y, x + width / 2, y, "dimension");
  for (const double side : {-0.5, 0.5})
    svg.line(x + side * width, y - 4, x + side * width, y + 4, "dimension");
  svg.text(x, y - 4, label, "t halo", Anchor::middle);
}

std::string millimetres(const double metres)
{
  return fixed(1e3 * metres, 0);
}

// Text of a bearing stiffness next to the left bearing, where the drawing has room.
void name_bearing(Svg &svg, const Run &run, const int number, const double x, const double y)
{
  const Result *bearing = chain_value(run, "Kzc" + std::to_string(number));
  if (!bearing || !std::isfinite(bearing->value))
    return;
  svg.text(x, y - 3, "Kzc" + std::to_string(number), "t strong", Anchor::end);
  svg.text(x, y + 12, known_digits(bearing->value * 1e-6, bearing->error_estimate) + " kN/mm", "t", Anchor::end);
}

void draw_ruler(Svg &svg, const Rolls &rolls, const double y)
{
  const double half = std::floor(rolls.length.at("backup_bearing_span") + 0.5) / 2;  // whole metres
  const double left = rolls.x - half * rolls.scale;
  svg.line(left, y, left + 2 * half * rolls.scale, y, "dimension");
  for (int i = 0; i <= int(4 * half); ++i) {
    const double x = left + 0.5 * i * rolls.scale;
    svg.line(x, y, x, y + 5, "dimension");
    svg.text(x, y + 18, std::to_string(500 * i), "t", Anchor::middle);
  }
  svg.text(rolls.x, y + 35, "length along the roll axes, to scale [mm]", "axis", Anchor::middle);
}

std::array<double, 4> draw_rolls(Svg &svg, const Run &run, const double x, const double y)
{
  const auto &length = run.manifest.geometry;
  const double tall  = 2 * (length.at("backup_diameter") + length.at("work_roll_diameter"));
  const double broad =
      std::max(length.at("work_total_length"), length.at("backup_length") + 2 * length.at("backup_neck_length"));
  const Rolls rolls{std::min(430 / tall, 340 / broad), x, y, length};
  const double work = rolls("work_roll_diameter"), backup = rolls("backup_diameter");
  const std::array<double, 4> axis{y - work - backup / 2, y - work / 2, y + work / 2, y + work + backup / 2};
  const double backup_end = rolls("backup_length") / 2 + rolls("backup_neck_length");
  for (const int i : {0, 3}) {
    draw_roll(svg, rolls, axis[i], rolls("backup_length"), backup, backup_end, rolls("backup_neck_diameter"));
    draw_bearings(svg, rolls, axis[i], rolls("backup_bearing_span"), rolls("backup_neck_diameter"));
    name_bearing(svg, run, i + 1, x - backup_end - 14, axis[i]);
    svg.text(x, axis[i] + (i == 0 ? -10 : 20), "\u2300 " + millimetres(length.at("backup_diameter")), "t halo",
             Anchor::middle);
  }
  for (const int i : {1, 2}) {
    draw_roll(svg, rolls, axis[i], rolls("work_roll_length"), work, rolls("work_total_length") / 2,
              rolls("work_neck_diameter"));
    draw_bearings(svg, rolls, axis[i], rolls("work_bearing_span"), rolls("work_neck_diameter"));
    name_bearing(svg, run, i + 1, x - backup_end - 14, axis[i]);
    svg.text(x, axis[i] + 5, "\u2300 " + millimetres(length.at("work_roll_diameter")), "t halo", Anchor::middle);
  }
  svg.rect(x - rolls("strip_width") / 2, y - 2, rolls("strip_width"), 4, "strip");
  const double below = axis[3] + backup / 2;
  draw_width(svg, x, below + 22, rolls("backup_length"), "barrel " + millimetres(length.at("backup_length")));
  draw_width(svg, x, below + 44, rolls("backup_bearing_span"),
             "bearing centres " + millimetres(length.at("backup_bearing_span")));
  draw_width(svg, x, axis[0] - backup / 2 - 12, rolls("strip_width"),
             "strip " + millimetres(length.at("strip_width")));
  draw_ruler(svg, rolls, below + 62);
  return axis;
}

void draw_ground(Svg &svg, const double x, const double y, const bool above)
{
  svg.line(x - 40, y, x + 40, y, "spring");
  for (int i = -4; i < 4; ++i)
    svg.line(x + 10 * i, y, x + 10 * (i + 1), above ? y - 9 : y + 9, "dimension");
}

void draw_spring(Svg &svg, const double x, const double from, const double to)
{
  const double coil = (to - from - 16) / 6;
  std::vector<Eigen::Vector2d> zigzag{{x, from}, {x, from + 8}};
  for (int i = 0; i < 6; ++i)
    zigzag.emplace_back(x + (i % 2 ? -9 : 9), from + 8 + (i + 0.5) * coil);
  zigzag.emplace_back(x, to - 8);
  zigzag.emplace_back(x, to);
  svg.polyline(zigzag, "spring");
}

void draw_damper(Svg &svg, const double x, const double from, const double to)
{
  const double middle = (from + to) / 2;
  svg.line(x, from, x, middle - 2, "spring");
  svg.line(x - 6, middle - 2, x + 6, middle - 2, "spring");
  svg.polyline({{x - 9, middle - 9}, {x - 9, middle + 6}, {x + 9, middle + 6}, {x + 9, middle - 9}}, "spring");
  svg.line(x, middle + 6, x, to, "spring");
}

// What does not fit next to the chain ends in an ellipsis; the whole text stands in the tables.
std::string shortened(std::string text, const double width)
{
  if (text_width(text, 11) <= width)
    return text;
  while (!text.empty() && text_width(text + "\u2026", 11) > width) {
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80)
      text.pop_back();  // the rest of a character of several bytes
    text.pop_back();
  }
  return text + "\u2026";
}

void name_spring(Svg &svg, const Run &run, const int number, const double x, const double y)
{
  const std::string name = "K" + std::to_string(number);
  const Result *spring   = chain_value(run, name);
  svg.text(x, y - 1,
           name + "  " +
               (spring ? known_digits(spring->value * 1e-6, spring->error_estimate, 5) + " kN/mm" : "not stored"),
           "t strong");
  if (spring)
    svg.text(x, y + 14,
             shortened(short_source(spring->source) + (spring->at.empty() ? "" : ", at " + spring->at), 300),
             "t small");
}

void draw_chain(Svg &svg, const Run &run, const double x)
{
  const double first = top + 8, last = mass_y(6) + box_height / 2 + 58;
  draw_ground(svg, x, first, true);
  draw_ground(svg, x, last, false);
  for (int spring = 1; spring <= 7; ++spring) {
    const double from = spring == 1 ? first : mass_y(spring - 1) + box_height / 2;
    const double to   = spring == 7 ? last : mass_y(spring) - box_height / 2;
    draw_spring(svg, x, from, to);
    name_spring(svg, run, spring, x + 40, (from + to) / 2);
    if (spring == 4)
      draw_damper(svg, x - 46, from, to);
  }
  svg.text(x - 64, (mass_y(3) + mass_y(4)) / 2 + 4, "C", "t strong", Anchor::end);
  for (int mass = 1; mass <= 6; ++mass) {
    const Result *value = run.find("M" + std::to_string(mass));
    svg.rect(x - box_width / 2, mass_y(mass) - box_height / 2, box_width, box_height, "mass", 3);
    svg.text(x, mass_y(mass) - 2,
             "M" + std::to_string(mass) + "  " +
                 (value ? known_digits(value->value, value->error_estimate, 5) + " kg" : "not stored"),
             "t strong", Anchor::middle);
    svg.text(x, mass_y(mass) + 13, value ? shortened(short_source(value->source), box_width - 10) : "", "t small",
             Anchor::middle);
  }
  svg.text(x, height - 8, "mass [kg], stiffness [kN/mm] of the whole stand", "axis", Anchor::middle);
}
}  // namespace

std::string stand_sketch(const Run &run)
{
  const bool to_scale  = has_geometry(run);
  const double chain_x = to_scale ? 690 : 260;
  Svg svg(to_scale ? 1040 : 720, height,
          "stand to scale in mm, masses in kg and springs in kN/mm of the six-mass chain");
  if (to_scale) {
    const double pass_line = (mass_y(3) + mass_y(4)) / 2;
    const auto axis        = draw_rolls(svg, run, 290, pass_line);
    for (int roll = 0; roll < 4; ++roll)
      svg.polyline({{475, axis[roll]},
                    {505, axis[roll]},
                    {chain_x - box_width / 2 - 30, mass_y(roll + 2)},
                    {chain_x - box_width / 2, mass_y(roll + 2)}},
                   "leader");
    svg.text(290, 18, "Rolls, seen along the rolling direction", "title", Anchor::middle);
  }
  svg.text(chain_x, 18, "Six-mass chain", "title", Anchor::middle);
  draw_chain(svg, run, chain_x);
  return svg.str();
}

namespace {
// With the whole force imposed the bite's own spring and damper are already in it.
std::string how_the_bite_acts(const Run &run)
{
  for (const PassInfo &pass : run.manifest.passes)
    if (pass.force_meaning != ForceMeaning::measured)
      return "";
  return run.manifest.passes.empty()
             ? ""
             : " K4 and C do not act in this run: its force is the whole force of the bite, "
               "which holds their reaction.";
}
}  // namespace

void stand_section(Page &page, const Run &run)
{
  if (!has_chain(run))
    return;
  page.section("stand", "Stand and chain");
  page.figure(
      {stand_sketch(run)},
      std::string(has_geometry(run) ? "The rolls to scale and the chain that represents them. " : "The chain. ") +
          "Every mass moves vertically, every spring is that of both sides together; each number has its source "
          "next to it. Kzc is one bearing of each roll in kN/mm and acts horizontally." +
          how_the_bite_acts(run) +
          (has_geometry(run) ? "" : " The rolls are not drawn: this run stored no geometry."));
  modulus_part(page, run);
}
}  // namespace mill::report
