#include "report/modes/drawing.h"
#include "core/records/stand_place.h"
#include "report/modes/mode_sizes.h"
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace mill::report {
namespace {
constexpr double drawing_width = 640, middle = 300;          // px
constexpr double ground_spring = 28, plate = 14, link = 24;  // px, heights of what stands above the upper chock
constexpr double frame_height = 22, cylinder_height = 16;    // px
constexpr double contact_gap = 24, strip_gap = 30, headroom = 34;  // px
constexpr int barrel_stations = 8, neck_stations = 4;              // spans of half a roll

// A roll in the drawing: place, sizes in px and which displacement each of its stations follows.
struct DrawnRoll {
  double y;        // px, axis at rest
  RollSizes size;  // px
  std::vector<double> at;
  std::vector<int> station;
  int seat, middle;
};

class Builder {
public:
  Builder(const ComparedModel &model, const StandSizes &sizes) : model_(model), sizes_(sizes)
  {
    drawing_.displacements.push_back({});
    const double tall  = 4 * (sizes.backup.radius + sizes.work.radius);
    const double broad = 2 * std::max(sizes.backup.half_total, sizes.work.half_total);
    scale_             = std::min(400 / tall, 430 / broad);
  }

  StandDrawing build();

private:
  int point(const std::string &name);
  DrawnRoll roll(const std::string &name, const RollSizes &metres, double y);
  void outline(const DrawnRoll &roll);
  void box(double x, double y, double half_width, double height, int displacement, const std::string &classes);
  void spring(double x, double from_y, int from, double to_y, int to);
  void ground(double x, double y, bool above);
  void contact(const DrawnRoll &upper, const DrawnRoll &lower);
  void upper_frame(const DrawnRoll &backup);
  void lower_frame(const DrawnRoll &backup);
  void work_chock(const DrawnRoll &work, const std::string &name);
  void strip(const DrawnRoll &upper, const DrawnRoll &lower);
  void label(double y, const std::string &name);
  void others();

  const ComparedModel &model_;
  StandSizes sizes_;
  double scale_;  // px/m
  StandDrawing drawing_;
  std::set<std::string> placed_;                // points that the drawing shows
  double ground_above_ = 0, ground_below_ = 0;  // px
};

// 0, the ground, for a point that the model does not have.
int Builder::point(const std::string &name)
{
  placed_.insert(name);
  const auto match = std::find(model_.points.begin(), model_.points.end(), name);
  if (match == model_.points.end())
    return 0;
  const int index = int(match - model_.points.begin());
  for (std::size_t i = 1; i < drawing_.displacements.size(); ++i)
    if (drawing_.displacements[i].point == index)
      return int(i);
  drawing_.displacements.push_back({index, -1, 0});
  return int(drawing_.displacements.size()) - 1;
}

DrawnRoll Builder::roll(const std::string &name, const RollSizes &metres, const double y)
{
  DrawnRoll roll{y,
                 {metres.radius * scale_, metres.half_barrel * scale_, metres.neck * scale_,
                  metres.half_total * scale_, metres.seat * scale_},
                 {},
                 {},
                 point(name),
                 point(name)};
  placed_.insert(name + " end");  // the outline shows it
  int line = -1;
  for (std::size_t i = 0; i < model_.lines.size(); ++i)
    if (model_.lines[i].name == name && model_.lines[i].z.size() > 0)
      line = int(i);
  const auto follow = [&](const double z) {
    if (line < 0)
      return roll.middle;
    drawing_.displacements.push_back({-1, line, z});
    return int(drawing_.displacements.size()) - 1;
  };
  const auto add = [&](const double z) {
    roll.at.push_back(z * scale_);
    roll.station.push_back(follow(z));
  };
  for (int i = 0; i <= barrel_stations; ++i)
    add(metres.half_barrel * i / barrel_stations);
  for (int i = 1; i <= neck_stations; ++i)
    add(metres.half_barrel + (metres.half_total - metres.half_barrel) * i / neck_stations);
  roll.seat   = follow(metres.seat);
  roll.middle = roll.station[0];
  return roll;
}

// Barrel and necks as one closed line, then the axis.
void Builder::outline(const DrawnRoll &roll)
{
  std::vector<Corner> quarter;  // upper right, from mid-length outwards, as heights above the axis
  const int n = int(roll.station.size());
  for (int i = 0; i <= barrel_stations; ++i)
    quarter.push_back({roll.at[i], roll.size.radius, roll.station[i]});
  for (int i = barrel_stations; i < n; ++i)
    quarter.push_back({roll.at[i], roll.size.neck, roll.station[i]});
  std::vector<Corner> closed;
  const auto add = [&](const Corner &corner, const double right, const double up) {
    closed.push_back({middle + right * corner.x, roll.y - up * corner.y, corner.from});
  };
  for (auto c = quarter.rbegin(); c + 1 != quarter.rend(); ++c)
    add(*c, -1, 1);
  for (const Corner &c : quarter)
    add(c, 1, 1);
  for (auto c = quarter.rbegin(); c + 1 != quarter.rend(); ++c)
    add(*c, 1, -1);
  for (const Corner &c : quarter)
    add(c, -1, -1);
  drawing_.shapes.push_back({"ghost", true, closed, true});
  drawing_.shapes.push_back({"steel", true, closed});
  std::vector<Corner> axis;
  for (int i = n - 1; i > 0; --i)
    axis.push_back({middle - roll.at[i], roll.y, roll.station[i]});
  for (int i = 0; i < n; ++i)
    axis.push_back({middle + roll.at[i], roll.y, roll.station[i]});
  drawing_.shapes.push_back({"axis-line", false, axis});
}

void Builder::box(const double x, const double y, const double half_width, const double height,
                  const int displacement, const std::string &classes)
{
  const std::vector<Corner> corners{{x - half_width, y, displacement},
                                    {x + half_width, y, displacement},
                                    {x + half_width, y + height, displacement},
                                    {x - half_width, y + height, displacement}};
  if (displacement != 0)
    drawing_.shapes.push_back({"ghost", true, corners, true});
  drawing_.shapes.push_back({classes, true, corners});
}

void Builder::spring(const double x, const double from_y, const int from, const double to_y, const int to)
{
  constexpr int coils = 6;
  std::vector<Corner> zigzag;
  const auto add = [&](const double x_at, const double share) {
    zigzag.push_back({x_at, from_y + share * (to_y - from_y), from, to, share});
  };
  add(x, 0);
  add(x, 0.12);
  for (int i = 0; i < coils; ++i)
    add(x + (i % 2 ? -5 : 5), 0.12 + 0.76 * (i + 0.5) / coils);
  add(x, 0.88);
  add(x, 1);
  drawing_.shapes.push_back({"thin-spring", false, zigzag});
}

void Builder::ground(const double x, const double y, const bool above)
{
  drawing_.shapes.push_back({"ground-line", false, {{x - 26, y}, {x + 26, y}}});
  for (int i = -3; i < 3; ++i)
    drawing_.shapes.push_back(
        {"dimension", false, {{x + 8.0 * i, y}, {x + 8.0 * (i + 1), above ? y - 8 : y + 8}}});
}

// An elastic foundation of springs where two barrels meet.
void Builder::contact(const DrawnRoll &upper, const DrawnRoll &lower)
{
  for (const int station : {0, barrel_stations / 2, barrel_stations})
    for (const double side : {-1.0, 1.0}) {
      if (station == 0 && side < 0)
        continue;
      const double x =
          middle + side * std::min(upper.at[std::size_t(station)], lower.at[std::size_t(station)]) * 0.96;
      spring(x, upper.y + upper.size.radius, upper.station[std::size_t(station)], lower.y - lower.size.radius,
             lower.station[std::size_t(station)]);
    }
}

void Builder::upper_frame(const DrawnRoll &backup)
{
  const int frame = point("upper frame"), chock = point("upper backup chock"), cylinder = point("cylinder"),
            screw         = point("housing, screw");
  const double half_chock = 1.3 * backup.size.neck, chock_top = backup.y - half_chock;
  const double cylinder_y  = chock_top - link - cylinder_height;
  const double frame_y     = std::min(cylinder_y - link, backup.y - backup.size.radius - 12) - frame_height;
  const double screw_y     = frame_y - link - plate;
  const double half_width  = backup.size.seat + 0.22 * scale_;
  const double under_frame = frame_y + frame_height;
  ground_above_            = (screw ? screw_y : frame_y) - ground_spring;
  for (const double side : {-1.0, 1.0}) {
    const double x = middle + side * backup.size.seat;
    ground(x, ground_above_, true);
    spring(x, ground_above_, 0, screw ? screw_y : frame_y, screw ? screw : frame);
    if (screw)
      spring(x, screw_y + plate, screw, frame_y, frame);
    double y  = under_frame;
    int above = frame;
    if (cylinder) {
      spring(x, y, above, cylinder_y, cylinder);
      box(x, cylinder_y, 0.16 * scale_, cylinder_height, cylinder, "part");
      y     = cylinder_y + cylinder_height;
      above = cylinder;
    }
    if (chock) {
      spring(x, y, above, chock_top, chock);
      box(x, chock_top, 0.24 * scale_, 2 * half_chock, chock, "part");
    } else
      spring(x, y, above, backup.y - backup.size.neck, backup.seat);
  }
  if (screw)
    box(middle, screw_y, half_width, plate, screw, "part");
  box(middle, frame_y, half_width, frame_height, frame, "part");
  label(frame_y + frame_height / 2, "upper frame");
  if (screw)
    label(screw_y + plate / 2, "housing, screw");
  if (cylinder)
    label(cylinder_y + cylinder_height / 2, "cylinder");
}

void Builder::lower_frame(const DrawnRoll &backup)
{
  const int frame = point("lower frame"), chock = point("lower backup chock"), seat = point("housing, chock seat");
  const double half_chock = 1.3 * backup.size.neck;
  const double frame_y    = std::max(backup.y + half_chock + link, backup.y + backup.size.radius + 12);
  const double seat_y     = frame_y + frame_height + link;
  const double half_width = backup.size.seat + 0.22 * scale_;
  const double last       = seat ? seat_y + plate : frame_y + frame_height;
  ground_below_           = last + ground_spring;
  for (const double side : {-1.0, 1.0}) {
    const double x = middle + side * backup.size.seat;
    ground(x, ground_below_, false);
    spring(x, last, seat ? seat : frame, ground_below_, 0);
    if (seat)
      spring(x, frame_y + frame_height, frame, seat_y, seat);
    if (chock) {  // stands on the lower frame
      box(x, backup.y + half_chock, 0.10 * scale_, frame_y - backup.y - half_chock, chock, "part");
      box(x, backup.y - half_chock, 0.24 * scale_, 2 * half_chock, chock, "part");
    } else
      spring(x, backup.y + backup.size.neck, backup.seat, frame_y, frame);
  }
  box(middle, frame_y, half_width, frame_height, frame, "part");
  if (seat)
    box(middle, seat_y, half_width, plate, seat, "part");
  label(frame_y + frame_height / 2, "lower frame");
  if (seat)
    label(seat_y + plate / 2, "housing, chock seat");
}

void Builder::work_chock(const DrawnRoll &work, const std::string &name)
{
  const int chock = point(name);
  if (!chock)
    return;
  const double half = 1.45 * work.size.neck;
  for (const double side : {-1.0, 1.0})
    box(middle + side * work.size.seat, work.y - half, 0.11 * scale_, 2 * half, chock, "part");
}

// Keeps half way between the rolls.
void Builder::strip(const DrawnRoll &upper, const DrawnRoll &lower)
{
  const double y = 0.5 * (upper.y + lower.y), half = sizes_.half_strip * scale_;
  std::vector<Corner> corners;
  for (const auto &[x, dy] :
       {std::pair{-half, -1.5}, std::pair{half, -1.5}, std::pair{half, 1.5}, std::pair{-half, 1.5}})
    corners.push_back({middle + x, y + dy, upper.middle, lower.middle, 0.5});
  drawing_.shapes.push_back({"strip", true, corners});
}

// Names stand next to what moves, all in one column.
void Builder::label(const double y, const std::string &name)
{
  const double widest = std::max({sizes_.backup.half_total, sizes_.work.half_total, sizes_.backup.seat + 0.24});
  drawing_.texts.push_back({middle + widest * scale_ + 14, y + 4, name, "t", Anchor::start});
}

// What a later model may bring.
void Builder::others()
{
  double y = headroom + 30;
  for (const std::string &name : model_.points) {
    const StandPlace place = stand_place(name);
    const bool on_a_roll   = place.roll && (place.seat || place.end);
    if (placed_.count(name) || name.empty() || on_a_roll)  // the roll's own outline shows those
      continue;
    box(34, y, 9, 18, point(name), "part");
    drawing_.texts.push_back({4, y + 46, name, "t small", Anchor::start});
    y += 84;
  }
}

StandDrawing Builder::build()
{
  const double backup_radius = sizes_.backup.radius * scale_, work_radius = sizes_.work.radius * scale_;
  const double above = ground_spring + plate + link + frame_height + 2 * link + cylinder_height +
                       std::max(1.3 * sizes_.backup.neck * scale_, backup_radius);
  const double first           = headroom + above;
  const double second          = first + backup_radius + contact_gap + work_radius;
  const double third           = second + 2 * work_radius + strip_gap;
  const double fourth          = third + work_radius + contact_gap + backup_radius;
  const DrawnRoll upper_backup = roll("upper backup roll", sizes_.backup, first),
                  upper_work   = roll("upper work roll", sizes_.work, second),
                  lower_work   = roll("lower work roll", sizes_.work, third),
                  lower_backup = roll("lower backup roll", sizes_.backup, fourth);
  upper_frame(upper_backup);
  lower_frame(lower_backup);
  work_chock(upper_work, "upper work-roll chock");
  work_chock(lower_work, "lower work-roll chock");
  contact(upper_backup, upper_work);
  contact(lower_work, lower_backup);
  strip(upper_work, lower_work);
  for (const DrawnRoll *roll : {&upper_backup, &upper_work, &lower_work, &lower_backup})
    outline(*roll);
  for (const auto &[y, name] : {std::pair{first, "upper backup roll"}, std::pair{second, "upper work roll"},
                                std::pair{third, "lower work roll"}, std::pair{fourth, "lower backup roll"}})
    label(y, name);
  others();
  // Nothing is drawn above the upper ground: the drawing starts there.
  drawing_.width   = drawing_width;
  const double off = ground_above_ - headroom;
  for (MovingShape &shape : drawing_.shapes)
    for (Corner &corner : shape.corners)
      corner.y -= off;
  for (FixedText &text : drawing_.texts)
    text.y -= off;
  const double below = ground_below_ - off + 26, metre = scale_;
  drawing_.shapes.push_back({"dimension", false, {{middle - metre / 2, below}, {middle + metre / 2, below}}});
  for (const double side : {-0.5, 0.5})
    drawing_.shapes.push_back(
        {"dimension", false, {{middle + side * metre, below - 4}, {middle + side * metre, below + 4}}});
  drawing_.texts.push_back({middle, below + 16,
                            "1 m of the stand, to scale; motion relative, largest of the mode = 1 [-]", "axis",
                            Anchor::middle});
  drawing_.height = below + 26;
  return drawing_;
}
}  // namespace

StandDrawing stand_drawing(const ComparedModel &model, const std::map<std::string, double> &geometry)
{
  return Builder(model, sizes_of(model, geometry)).build();
}
}  // namespace mill::report
