#include "core/model/dynamics_settings.h"
#include "report/models/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr double ladder_top = 62, ladder_bottom = 640, step_width = 84, line_gap = 14.5;  // px

struct LadderColumn {
  const ComparedModel *model;
  double x;  // px, middle
  int side;  // where its numbers stand: -1 left, 0 above the step, 1 right
};

struct LadderFrame {
  double top;  // Hz, upper end of the axis
  double limit;
  double y(const double frequency) const
  {
    return ladder_bottom - frequency / top * (ladder_bottom - ladder_top);
  }
  bool holds(const double frequency) const
  {
    return frequency >= 0 && frequency <= top;
  }
};

// The six masses in the middle, so that every detailed model is their neighbour.
std::vector<LadderColumn> columns_of(const ModelData &data)
{
  std::vector<const ComparedModel *> order;
  for (const ComparedModel &model : data.models)
    if (!model.modes.empty() && model.name != word_of(StandModelKind::six_mass))
      order.push_back(&model);
  if (const ComparedModel *chain = data.find("six-mass"); chain && !chain->modes.empty())
    order.insert(order.begin() + std::min<std::ptrdiff_t>(1, std::ptrdiff_t(order.size())), chain);
  std::vector<LadderColumn> columns;
  for (std::size_t i = 0; i < order.size(); ++i)
    columns.push_back({order[i], 250 + 280 * double(i),
                       order.size() > 1 && i == 0                            ? -1
                       : i + 1 == order.size()                               ? 1
                       : order[i]->name == word_of(StandModelKind::six_mass) ? 0
                                                                             : 1});
  return columns;
}

const Partner *partner_of(const ModelData &data, const std::string &model, const int mode)
{
  for (const ModePartners &pair : data.pairs)
    if (const auto match = pair.partner.find(model);
        match != pair.partner.end() && match->second.mode == mode && !(match->second.mac < alike))
      return &match->second;
  return nullptr;
}

bool is_joined(const ModelData &data, const ComparedModel &model, const int mode)
{
  if (model.name != word_of(StandModelKind::six_mass))
    return data.pairs.empty() || partner_of(data, model.name, mode);
  for (const ModePartners &pair : data.pairs)
    if (pair.mode == mode)
      for (const auto &[name, partner] : pair.partner)
        if (data.find(name) && !(partner.mac < alike))
          return true;
  return data.pairs.empty();
}

// Heights of labels that would lie on their steps, pushed apart so that none covers another.
std::vector<double> spread(const std::vector<double> &wanted)
{
  std::vector<double> y = wanted;  // from the top of the page downwards
  for (int pass = 0; pass < 200; ++pass) {
    bool moved = false;
    for (std::size_t i = 0; i + 1 < y.size(); ++i)
      if (const double overlap = line_gap - (y[i + 1] - y[i]); overlap > 1e-6) {
        y[i] -= overlap / 2;
        y[i + 1] += overlap / 2;
        moved = true;
      }
    if (!moved)
      break;
  }
  return y;
}

void draw_axis(Svg &svg, const LadderFrame &frame, const double right)
{
  const Ticks ticks = linear_ticks(0, frame.top, 12);
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    svg.line(70, frame.y(ticks.at[i]), right, frame.y(ticks.at[i]), "grid");
    svg.text(64, frame.y(ticks.at[i]) + 4, ticks.labels[i], "t ty", Anchor::end);
  }
  svg.line(70, ladder_top, 70, ladder_bottom, "frame");
  svg.upright_text(16, (ladder_top + ladder_bottom) / 2, "natural frequency [Hz]", "axis");
  if (std::isfinite(frame.limit)) {
    svg.line(70, frame.y(frame.limit), right, frame.y(frame.limit), "limit");
    svg.text(76, frame.y(frame.limit) - 5, "limit " + significant(frame.limit, 4) + " Hz", "flag halo");
  }
}

void draw_column(Svg &svg, const ModelData &data, const LadderFrame &frame, const LadderColumn &column)
{
  svg.text(column.x, 24, column.model->title, "title", Anchor::middle);
  svg.text(column.x, 41,
           std::to_string(column.model->unknowns) + (column.model->unknowns == 1 ? " unknown" : " unknowns"),
           "t small", Anchor::middle);
  std::vector<int> shown;
  std::vector<double> positions;
  for (int mode = int(column.model->modes.size()); mode >= 1; --mode)
    if (const double f = column.model->modes[std::size_t(mode - 1)].frequency; frame.holds(f)) {
      shown.push_back(mode);
      positions.push_back(frame.y(f));
    }
  const std::vector<double> labels = spread(positions);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double f = column.model->modes[std::size_t(shown[i] - 1)].frequency, half = step_width / 2;
    const bool joined = is_joined(data, *column.model, shown[i]);
    if (joined)
      svg.rect(column.x - half, positions[i] - 2.5, step_width, 5, "step");
    else
      svg.rect(column.x - half, positions[i] - 2.5, step_width, 5, "step lone");
    if (column.side == 0) {  // above its step, or below where the next step is near
      const bool below = i > 0 && positions[i] - positions[i - 1] < 20;
      svg.text(column.x, positions[i] + (below ? 15 : -6), fixed(f, 1), "t halo", Anchor::middle);
      continue;
    }
    const double end = column.x + column.side * half, text = end + column.side * 26;
    svg.line(end, positions[i], text - column.side * 4, labels[i], "leader");
    svg.text(text, labels[i] + 4, fixed(f, 1), "t halo", column.side < 0 ? Anchor::end : Anchor::start);
  }
}

const char *how_far(const double error)
{
  const double size = std::abs(error);
  return size <= 0.03 ? "good" : size <= 0.1 ? "fair" : "poor";
}

void draw_joins(Svg &svg, const ModelData &data, const LadderFrame &frame, const LadderColumn &chain,
                const LadderColumn &other)
{
  const double side = other.x > chain.x ? 1 : -1;
  for (const ModePartners &pair : data.pairs) {
    const auto match = pair.partner.find(other.model->name);
    if (match == pair.partner.end() || match->second.mac < alike || !frame.holds(pair.six_mass) ||
        !frame.holds(match->second.frequency))
      continue;
    const double error = pair.six_mass / match->second.frequency - 1;
    const double x1 = chain.x + side * step_width / 2, x2 = other.x - side * step_width / 2;
    const double y1 = frame.y(pair.six_mass), y2 = frame.y(match->second.frequency);
    svg.line(x1, y1, x2, y2, std::string("join ") + how_far(error));
    const double t = pair.mode % 2 ? 0.3 : 0.7;  // neighbours keep apart
    svg.text(x1 + t * (x2 - x1), y1 + t * (y2 - y1) + 4, percent(error), "flag halo", Anchor::middle);
  }
}

void draw_reach(Svg &svg, const LadderFrame &frame, const std::vector<ForceReach> &reach, double x)
{
  for (const ForceReach &force : reach) {
    const double end = frame.y(std::min(force.frequency, frame.top));
    svg.line(x, ladder_bottom, x, end, "reach");
    if (force.frequency <= frame.top)
      svg.line(x - 6, end, x + 6, end, "reach");
    else
      svg.polyline({{x, end - 8}, {x - 5, end}, {x + 5, end}}, "reach-head", true);
    svg.upright_text(x - 5, (ladder_bottom + end) / 2,
                     "force of " + force.pass + " to " + fixed(force.frequency, 0) + " Hz", "flag halo");
    x += 26;
  }
}

void draw_key(Svg &svg)
{
  const struct {
    const char *classes, *label;
  } keys[] = {{"join good", "within 3 %"}, {"join fair", "3 to 10 % off"}, {"join poor", "more than 10 % off"}};
  double x = 90;
  for (const auto &[classes, label] : keys) {
    svg.line(x, ladder_bottom + 28, x + 30, ladder_bottom + 28, classes);
    svg.text(x + 36, ladder_bottom + 32, label, "t");
    x += 150;
  }
  svg.rect(x + 10, ladder_bottom + 25.5, 30, 5, "step lone");
  svg.text(x + 46, ladder_bottom + 32, "no counterpart", "t");
}
}  // namespace

std::string frequency_ladder(const ModelData &data, const std::vector<ForceReach> &reach)
{
  const std::vector<LadderColumn> columns = columns_of(data);
  if (columns.empty())
    return "";
  LadderFrame frame{0, data.frequency_limit};
  if (std::isfinite(data.frequency_limit))
    frame.top = 1.08 * data.frequency_limit;
  else
    for (const LadderColumn &column : columns)
      for (const ModelMode &mode : column.model->modes)
        frame.top = std::max(frame.top, 1.08 * mode.frequency);
  if (!(frame.top > 0))
    return "";
  const double right = columns.back().x + 150;
  Svg svg(std::max(right + 30 + 26 * double(reach.size()), 720.0), ladder_bottom + 46,
          "natural frequencies in Hz of every model, partners joined");
  draw_axis(svg, frame, right);
  for (const LadderColumn &chain : columns)
    if (chain.model->name == word_of(StandModelKind::six_mass))
      for (const LadderColumn &other : columns)
        if (&other != &chain)
          draw_joins(svg, data, frame, chain, other);
  for (const LadderColumn &column : columns)
    draw_column(svg, data, frame, column);
  draw_reach(svg, frame, reach, right + 20);
  draw_key(svg);
  return svg.str();
}
}  // namespace mill::report
