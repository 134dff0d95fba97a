#include "meshes/housing/housing.h"
#include "core/base/errors.h"
#include "meshes/common/structured.h"
#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>

namespace mill::meshes {
namespace {
// Below this share of a post's width the elements around the fillet are slivers, and the stress there means
// nothing.
constexpr double sharpest_fillet = 0.05;
// Least half height of a foot's band over the post's width.
constexpr double lowest_foot = 0.05;

std::string mm(const double metres)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << '"' << 1000 * metres << " mm\"";  // six digits
  return text.str();
}

// A stretch of the frame between two sections: `section_at(s)` is the section at s = 0..1, outside and window
// point.
struct Section {
  std::array<double, 2> outside, window;
};
struct Stretch {
  double length;  // of its longer side
  double width;   // of its narrower end
  std::function<Section(double s)> section_at;
};

std::array<double, 2> between(const std::array<double, 2> &a, const std::array<double, 2> &b, const double s)
{
  return {(1 - s) * a[0] + s * b[0], (1 - s) * a[1] + s * b[1]};
}

// From the middle of a beam to its corner, as if the window's bottom were y = 0 and the beam below it.
std::vector<Stretch> beam_and_corner(const MillHousing &h, const double beam_height, const double pad)
{
  const double a = 0.5 * h.window_width, r = h.fillet_radius, b = h.post_width, flat = a - r;
  std::vector<Stretch> out;
  std::vector<double> x{0, 0.5 * pad};
  if (flat - x.back() > 1e-6 * flat)
    x.push_back(flat);
  else
    x.back() = flat;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    out.push_back({x[i + 1] - x[i], beam_height, [=](const double s) {
                     const double place = i + 2 == x.size() && s == 1 ? flat : x[i] + s * (x[i + 1] - x[i]);
                     return Section{{place, -beam_height}, {place, 0}};
                   }});
  const auto arc = [=](const double angle) {  // from below the centre of the fillet towards the post
    return std::array<double, 2>{flat + r * std::sin(angle), r * (1 - std::cos(angle))};
  };
  const std::array<double, 2> under{flat, -beam_height}, corner{a + b, -beam_height}, next_to_post{a + b, r};
  out.push_back({b + r, beam_height, [=](const double s) {
                   return Section{between(under, corner, s), arc(0.25 * M_PI * s)};
                 }});
  out.push_back({beam_height + r, b, [=](const double s) {
                   return Section{between(corner, next_to_post, s), arc(0.25 * M_PI * (1 + s))};
                 }});
  return out;
}

// The same for the upper beam: from the corner to the middle.
std::vector<Stretch> upper_half(const MillHousing &h)
{
  auto lower = beam_and_corner(h, h.upper_beam_height, h.screw_pad);
  std::reverse(lower.begin(), lower.end());
  for (auto &stretch : lower)
    stretch.section_at = [section_at = stretch.section_at, top = h.window_height](const double s) {
      Section section = section_at(1 - s);
      for (auto *point : {&section.outside, &section.window})
        (*point)[1] = top - (*point)[1];
      return section;
    };
  return lower;
}

std::vector<Stretch> around_the_window(const MillHousing &h)
{
  auto out       = beam_and_corner(h, h.lower_beam_height, h.seat_pad);
  const double a = 0.5 * h.window_width, r = h.fillet_radius, foot = foot_half_height(h);
  const std::vector<double> y{r, h.foot_height - foot, h.foot_height, h.foot_height + foot, h.window_height - r};
  for (std::size_t i = 0; i + 1 < y.size(); ++i)
    if (y[i + 1] - y[i] > 1e-6 * foot)
      out.push_back({y[i + 1] - y[i], h.post_width, [=, low = y[i], high = y[i + 1]](const double s) {
                       const double place = s == 1 ? high : low + s * (high - low);
                       return Section{{a + h.post_width, place}, {a, place}};
                     }});
  for (auto &stretch : upper_half(h))
    out.push_back(stretch);
  return out;
}

// Half the thickness, with lines at the ends of both pads.
std::vector<double> lines_along_the_rolls(const MillHousing &h, const double element)
{
  std::vector<double> ends{0.5 * h.seat_pad, 0.5 * h.screw_pad, 0.5 * h.thickness};
  std::sort(ends.begin(), ends.end());
  std::vector<double> out{0};
  for (const double end : ends) {
    const double span = end - out.back();
    if (span < 1e-6 * h.thickness)
      continue;
    const double start = out.back();
    const int n        = std::max(1, int(std::lround(span / element)));
    for (int i = 1; i <= n; ++i)
      out.push_back(start + span * i / n);
  }
  return out;
}
}  // namespace

double foot_half_height(const MillHousing &h)
{
  const double room = std::min(h.foot_height, h.window_height - h.foot_height) - h.fillet_radius;
  return std::min(0.25 * h.post_width, room);
}

void require_housing(const MillHousing &h)
{
  std::vector<Problem> problems;
  const auto refuse = [&](const std::string &message) { problems.push_back({{}, message, {}}); };
  const std::vector<std::pair<const char *, double>> lengths{{"thickness", h.thickness},
                                                             {"post_width", h.post_width},
                                                             {"window_width", h.window_width},
                                                             {"window_height", h.window_height},
                                                             {"upper_beam_height", h.upper_beam_height},
                                                             {"lower_beam_height", h.lower_beam_height},
                                                             {"fillet_radius", h.fillet_radius},
                                                             {"screw_pad", h.screw_pad},
                                                             {"seat_pad", h.seat_pad}};
  for (const auto &[key, value] : lengths)
    if (!(value > 0))
      refuse(std::string("housing.") + key + " = " + mm(value) +
             " must be positive: give the length of the drawing");
  if (!problems.empty())
    throw InputError(problems);

  const double half_window = 0.5 * std::min(h.window_width, h.window_height), r = h.fillet_radius;
  if (r >= half_window)
    refuse("housing.fillet_radius = " + mm(r) + " is not less than half the window (" + mm(h.window_width) +
           " wide, " + mm(h.window_height) +
           " high): the corners would leave nothing straight between them; give a smaller radius");
  else if (r < sharpest_fillet * h.post_width)
    refuse("housing.fillet_radius = " + mm(r) + " is too sharp for posts " + mm(h.post_width) +
           " wide: stress has no limit in a sharp corner and the elements around it degenerate; give at least " +
           mm(sharpest_fillet * h.post_width));
  for (const auto &[key, pad] : {std::pair{"screw_pad", h.screw_pad}, std::pair{"seat_pad", h.seat_pad}}) {
    const double flat = h.window_width - 2 * r;
    if (flat > 0 && pad > flat * (1 + 1e-6))
      refuse(std::string("housing.") + key + " = " + mm(pad) +
             " is wider than the flat of the window between its fillets, " + mm(flat) +
             ": give a smaller pad, a wider window or a smaller fillet");
    if (pad > h.thickness * (1 + 1e-6))
      refuse(std::string("housing.") + key + " = " + mm(pad) + " is wider than housing.thickness = " +
             mm(h.thickness) + ": the pad would overhang; give a smaller pad or a thicker housing");
  }
  const double least = lowest_foot * h.post_width;
  if (problems.empty() && !(foot_half_height(h) >= least * (1 - 1e-6)))
    refuse("housing.foot_height = " + mm(h.foot_height) + " is outside the straight part of the posts: give " +
           mm(r + least) + " to " + mm(h.window_height - r - least) + " above the window's bottom");
  if (!problems.empty())
    throw InputError(problems);
}

MeshFile mesh_housing(const MillHousing &h, const HousingMeshSize &size, const std::string &path)
{
  require_housing(h);
  std::vector<Section> sections;
  for (const Stretch &stretch : around_the_window(h)) {
    // Half as many elements as through it at least along every stretch: load, corner and foot vary within theirs.
    const double element =
        std::min(size.stretch * stretch.width / size.through, size.longest > 0 ? size.longest : 1e300);
    const int n = std::max((size.through + 1) / 2, int(std::ceil(stretch.length / element - 1e-9)));
    for (int i = sections.empty() ? 0 : 1; i <= n; ++i)
      sections.push_back(stretch.section_at(double(i) / n));
  }
  const double narrowest = std::min({h.post_width, h.upper_beam_height, h.lower_beam_height});
  const auto z           = lines_along_the_rolls(h, size.stretch * narrowest / size.through);

  StructuredGrid grid;
  grid.n = {int(sections.size()), size.through + 1, int(z.size())};
  for (const double depth : z)
    for (int j = 0; j <= size.through; ++j)
      for (const Section &section : sections) {
        const auto point = between(section.outside, section.window, double(j) / size.through);
        grid.points.push_back({point[0], point[1], depth});
      }
  const double foot = foot_half_height(h);
  const auto on_pad = [](const std::array<double, 3> &middle, const double pad) {
    return middle[0] < 0.5 * pad && middle[2] < 0.5 * pad;
  };
  grid.group = [&](const int direction, const int side, const std::array<double, 3> &middle) -> std::string {
    if (direction == 0)
      return "symmetry.x";
    if (direction == 2)
      return side == 0 ? "symmetry.z" : "side";
    if (side == 0)
      return std::abs(middle[1] - h.foot_height) < foot ? "foot" : "outside";  // the beams are below and above
    const bool low = middle[1] < 0.5 * h.window_height;
    if (on_pad(middle, low ? h.seat_pad : h.screw_pad))
      return low ? "seat" : "screw";
    return "window";
  };
  return write_grid(grid, path);
}
}  // namespace mill::meshes
