#pragma once
#include <map>
#include <utility>
#include <vector>

namespace mill::meshes {
/// A point of the current Gmsh model.
struct TaggedPoint {
  int tag;      ///< in the model
  double x, y;  ///< where it is, in the unit of the drawing
};

/// Points, curves and quadrilateral blocks of one section in the current Gmsh model (built-in kernel).  A curve is
/// made once per pair of points, so that neighbours share it; a curve that is run through from its end to its
/// beginning has a negative tag.
class Sketch {
public:
  TaggedPoint point(double x, double y) const;
  /// On the circle around (0, 0), `degrees` from the y axis towards the x axis.
  TaggedPoint at_angle(double radius, double degrees) const;

  /// Straight curve with `cells` elements; ratio: size of an element over that of the one before it, from a to b.
  int line(const TaggedPoint &a, const TaggedPoint &b, int cells = 1, double ratio = 1);
  int arc(const TaggedPoint &a, const TaggedPoint &centre, const TaggedPoint &b, int cells, double ratio = 1);

  /// Quadrilateral block from its corners and the curves of its boundary in order, signed as they are run through.
  int block(const std::vector<int> &boundary, const std::vector<TaggedPoint> &corners) const;
  /// One quadrilateral element.
  int quad(const TaggedPoint &a, const TaggedPoint &b, const TaggedPoint &c, const TaggedPoint &d);

private:
  template <class Add>
  int curve(const TaggedPoint &a, const TaggedPoint &b, int cells, double ratio, const Add &add);
  std::map<std::pair<int, int>, int> curves;
};
}  // namespace mill::meshes
