#include "dynamics/marks/marks.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>

namespace mill::dynamics {
namespace {
void check(const MarksQuestion &q, const MarkSources &sources)
{
  require_input(q.spacing > 0 && std::isfinite(q.spacing), "the spacing of the marks must be positive");
  require_input(q.speed > 0 && std::isfinite(q.speed), "the speed of the strip must be positive");
  require_input(q.forward_slip > -1 && q.forward_slip < 1, "the forward slip must lie between -100 % and 100 %");
  require_input(q.accuracy > 0 && q.accuracy < 1, "the accuracy of the spacing must lie between 0 and 100 %");
  require_input(std::isnan(q.side_band) || q.side_band > 0, "the distance of the side bands must be positive");
  const auto known = [](const MarkRoll &roll) { return roll.diameter > 0; };
  if (std::none_of(sources.rolls.begin(), sources.rolls.end(), known))
    throw InputError("marks: no roll of the case has a diameter, so that no spacing can be laid around it");
}

double surface_speed(const MarksQuestion &q)
{
  return q.speed / (1 + q.forward_slip);
}

// How a number of marks or multiples lies to the whole ones.  (40.3)
struct ToWhole {
  double whole, off, chance;
  const char *verdict;
};

ToWhole wholeness(const double number, const double accuracy)
{
  ToWhole w;
  w.whole   = std::max(1.0, std::round(number));
  w.off     = number / w.whole - 1;
  w.chance  = std::min(1.0, 2 * accuracy * number);
  w.verdict = std::abs(w.off) > accuracy ? word_of(Wholeness::between)
              : w.chance > 0.5           ? word_of(Wholeness::unclear)
                                         : word_of(Wholeness::whole);
  return w;
}

void add_rolls(MarksRecord &record, const MarkSources &sources)
{
  const MarksQuestion &q = record.question;
  for (const MarkRoll &roll : sources.rolls) {
    if (!(roll.diameter > 0)) {
      record.notes.push_back("the diameter of the " + roll.name + " is not known: it is left out");
      continue;
    }
    const double n    = marks_per_turn(q.spacing, roll.diameter, q.forward_slip);
    const auto w      = wholeness(n, q.accuracy);
    const double turn = rotation_of(surface_speed(q), roll.diameter);
    record.rolls.push_back({roll.name, roll.diameter, turn, n, w.whole, w.off, w.chance, w.verdict});
    SideBands bands;
    bands.roll  = roll.name;
    bands.below = record.frequency - turn;
    bands.above = record.frequency + turn;
    if (!std::isnan(q.side_band)) {
      bands.off            = q.side_band / turn - 1;
      bands.exact_speed    = q.side_band * M_PI * roll.diameter * (1 + q.forward_slip);
      bands.exact_diameter = surface_speed(q) / (M_PI * q.side_band);
    }
    record.side_bands.push_back(bands);
  }
}

void add_events(MarksRecord &record, const MarkSources &sources)
{
  for (const CampbellLine &line : sources.events) {
    const double frequency = line.per_length * surface_speed(record.question);
    const auto w           = wholeness(record.frequency / frequency, record.question.accuracy);
    record.events.push_back(
        {line.name, frequency, record.frequency / frequency, w.whole, w.off, w.chance, w.verdict});
  }
}

// The speeds next below and above the one asked for at which whole waves around a roll excite a mode.  (40.4)
void add_meetings(MarksRecord &record, const int mode, const int roll)
{
  const MarksQuestion &q = record.question;
  const double length    = M_PI * record.rolls[std::size_t(roll)].diameter * (1 + q.forward_slip);
  const double f         = record.modes[std::size_t(mode)].frequency;
  const double n         = length * f / q.speed;
  const auto add         = [&](const double waves) {
    if (waves < 1 || waves > 1e6)
      return;
    const double speed = length * f / waves;
    record.meetings.push_back({mode, roll, int(waves), speed, speed / q.speed - 1});
  };
  const double above = std::ceil(n);
  add(above);  // more waves: slower
  add(above == n ? n - 1 : std::floor(n));
}

void add_modes(MarksRecord &record, const MarkSources &sources)
{
  const MarksQuestion &q = record.question;
  for (const CampbellMode &mode : sources.modes) {
    if (!(mode.frequency > 0))
      continue;
    ModeMarks m;
    m.key            = mode.key;
    m.name           = mode.name;
    m.frequency      = mode.frequency;
    m.error_estimate = mode.error_estimate;
    m.off            = mode.frequency / record.frequency - 1;
    m.speed          = mode.frequency * q.spacing;
    m.near           = std::abs(m.off) <= q.accuracy + (std::isnan(mode.error_estimate) ? 0 : mode.error_estimate);
    record.modes.push_back(m);
    for (std::size_t roll = 0; roll < record.rolls.size(); ++roll)
      add_meetings(record, int(record.modes.size()) - 1, int(roll));
  }
  if (record.modes.empty())
    record.notes.push_back("no mode of the stand is known: the spacing is laid around the rolls only");
}
}  // namespace

double mark_frequency(const double speed, const double spacing)
{
  return speed / spacing;
}

double mark_spacing(const double speed, const double frequency)
{
  return speed / frequency;
}

double rotation_of(const double surface_speed, const double diameter)
{
  return surface_speed / (M_PI * diameter);
}

double marks_per_turn(const double spacing, const double diameter, const double forward_slip)
{
  return M_PI * diameter * (1 + forward_slip) / spacing;
}

MarksRecord marks_of(const MarksQuestion &question, const MarkSources &sources)
{
  check(question, sources);
  MarksRecord record;
  record.question  = question;
  record.frequency = mark_frequency(question.speed, question.spacing);
  record.damping   = sources.damping;
  record.model     = sources.model;
  add_rolls(record, sources);
  add_events(record, sources);
  add_modes(record, sources);
  return record;
}

MapAxes map_axes(const MarksQuestion &question, const double diameter, const std::vector<CampbellMode> &modes,
                 const int columns, const int rows)
{
  require_input(columns > 1 && rows > 1, "a map of marks needs two speeds and two numbers of waves");
  const double least = 0.5 * question.speed, most = 1.5 * question.speed;
  const double asked  = marks_per_turn(question.spacing, diameter, question.forward_slip);
  const double length = asked * question.spacing;  // m of strip per turn
  const double around = std::round(asked) - rows / 2;
  double highest      = 0;
  bool met            = false;
  for (const CampbellMode &mode : modes) {
    highest = std::max(highest, length * mode.frequency / least);
    met = met || (length * mode.frequency / least >= around && length * mode.frequency / most <= around + rows);
  }
  const double first = around > 1 && met ? around : 1;
  const double last  = std::min(first + rows - 1, std::max({20.0, std::ceil(2 * asked), std::ceil(highest)}));
  MapAxes axes;
  axes.speed = Eigen::VectorXd::LinSpaced(columns, least, most);
  axes.waves = Eigen::VectorXd::LinSpaced(Eigen::Index(last - first) + 1, first, last);
  return axes;
}

MarkMap mark_map(const MarksQuestion &question, const MarkRoll &roll, const MarkSources &sources,
                 const MapAxes &axes)
{
  require_input(sources.damping > 0, "a map of marks needs a modal damping above nil");
  MarkMap map;
  map.roll             = roll.name;
  map.speed            = axes.speed;
  map.waves            = axes.waves;
  const double damping = 4 * sources.damping * sources.damping;
  const double turn    = 1 / (M_PI * roll.diameter * (1 + question.forward_slip));  // Hz per m/s of the strip
  map.gain.resize(axes.speed.size(), axes.waves.size());
  for (Eigen::Index j = 0; j < axes.waves.size(); ++j)
    for (Eigen::Index i = 0; i < axes.speed.size(); ++i) {
      const double f = axes.waves[j] * axes.speed[i] * turn;
      double least   = INFINITY;  // square of the stiffest mode's inverse magnification
      for (const CampbellMode &mode : sources.modes) {
        const double square = f / mode.frequency * (f / mode.frequency);
        least               = std::min(least, (1 - square) * (1 - square) + damping * square);
      }
      map.gain(i, j) = std::isfinite(least) ? -10 * std::log10(least) : not_given;
    }
  return map;
}
}  // namespace mill::dynamics
