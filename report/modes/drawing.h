#pragma once
#include "report/modes/model_data.h"
#include "report/plot/svg.h"
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

// The stand as a drawing whose every corner knows which displacement it follows.
namespace mill::report {
/// A corner of the drawing: at rest at (x, y), it follows displacement `from`, and `to` with the weight `share`.
struct Corner {
  double x, y;  ///< px
  int from     = 0;
  int to       = 0;
  double share = 0;  ///< 0 .. 1
};

struct MovingShape {
  std::string classes;
  bool closed;
  std::vector<Corner> corners;
  bool ghost = false;  ///< the other extreme of the motion
};

struct FixedText {
  double x, y;  ///< px
  std::string text, classes;
  Anchor anchor;
};

/// Where a displacement of the drawing comes from: a point of the model, or a place of one of its lines.
struct Displacement {
  int point = -1;
  int line  = -1;
  double z  = 0;  ///< m, on the line
};

struct StandDrawing {
  double width = 0, height = 0;             ///< px
  std::vector<Displacement> displacements;  ///< the first is the ground
  std::vector<MovingShape> shapes;          ///< in the order of drawing
  std::vector<FixedText> texts;

  /// (displacements) of one mode, largest of the mode = 1; what was not stored rests.
  Eigen::VectorXd of(const ComparedModel &model, const ModelMode &mode) const;
};

/// The stand seen along the rolling direction: rolls with their necks, chocks, cylinder, frame and the springs
/// between them.  A roll without a line of its own moves with its point; one without a point rests.  Points that
/// the drawing has no place for stand as named squares on the left.
/// @param geometry  m, as in run.json; without it the rolls take assumed proportions
StandDrawing stand_drawing(const ComparedModel &model, const std::map<std::string, double> &geometry);

/// Corners at `swing` px times the displacement, up.
std::vector<Eigen::Vector2d> moved(const MovingShape &shape, const Eigen::VectorXd &displacement, double swing);
}  // namespace mill::report
