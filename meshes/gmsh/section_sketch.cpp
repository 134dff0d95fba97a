#include "meshes/gmsh/section_sketch.h"
#include <cmath>
#include <gmsh.h>

namespace mill::meshes {
namespace geo = gmsh::model::geo;

TaggedPoint Sketch::point(const double x, const double y) const
{
  return {geo::addPoint(x, y, 0), x, y};
}

TaggedPoint Sketch::at_angle(const double radius, const double degrees) const
{
  const double phi = degrees * M_PI / 180;
  return point(radius * std::sin(phi), radius * std::cos(phi));
}

template <class Add>
int Sketch::curve(const TaggedPoint &a, const TaggedPoint &b, const int cells, const double ratio, const Add &add)
{
  if (const auto match = curves.find({a.tag, b.tag}); match != curves.end())
    return match->second;
  if (const auto match = curves.find({b.tag, a.tag}); match != curves.end())
    return -match->second;
  const int tag = add();
  geo::mesh::setTransfiniteCurve(tag, cells + 1, "Progression", ratio);
  return curves[{a.tag, b.tag}] = tag;
}

int Sketch::line(const TaggedPoint &a, const TaggedPoint &b, const int cells, const double ratio)
{
  return curve(a, b, cells, ratio, [&] { return geo::addLine(a.tag, b.tag); });
}

int Sketch::arc(const TaggedPoint &a, const TaggedPoint &centre, const TaggedPoint &b, const int cells,
                const double ratio)
{
  return curve(a, b, cells, ratio, [&] { return geo::addCircleArc(a.tag, centre.tag, b.tag); });
}

int Sketch::block(const std::vector<int> &boundary, const std::vector<TaggedPoint> &corners) const
{
  const int surface = geo::addPlaneSurface({geo::addCurveLoop(boundary)});
  std::vector<int> tags;
  for (const TaggedPoint &corner : corners)
    tags.push_back(corner.tag);
  geo::mesh::setTransfiniteSurface(surface, "Left", tags);
  geo::mesh::setRecombine(2, surface);
  return surface;
}

int Sketch::quad(const TaggedPoint &a, const TaggedPoint &b, const TaggedPoint &c, const TaggedPoint &d)
{
  return block({line(a, b), line(b, c), line(c, d), line(d, a)}, {a, b, c, d});
}
}  // namespace mill::meshes
