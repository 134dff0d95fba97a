#include "reduce/bite/schedule/dynamic_force.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include <cmath>

namespace mill::bite {
namespace {
double draft(const DynamicPass &p)
{
  return p.entry_thickness - p.exit_thickness;
}

// (K - s_m) w sqrt(R)
double strength(const DynamicPass &p)
{
  return (p.flow_stress - p.mean_tension) * p.width * std::sqrt(p.radius);
}

void check(const DynamicPass &p)
{
  const auto say = [&](const bool holds, const std::string &what) {
    if (!holds)
      throw InputError("dynamic force of pass \"" + p.name + "\": " + what);
  };
  say(draft(p) > 0 && p.exit_thickness > 0, "the exit thickness must be positive and below the entry thickness");
  say(p.width > 0 && p.radius > 0, "width and radius of the arc must be positive");
  say(p.exit_speed > 0, "the speed of the pass is not given; the strip's vibration becomes one of the thickness "
                        "through it");
  say(p.flow_stress > p.mean_tension, sentence("mean tension ", p.mean_tension / 1e6,
                                               " MPa is not below the flow stress ", p.flow_stress / 1e6, " MPa"));
}
}  // namespace

double force_per_displacement(const DynamicPass &pass)
{
  return strength(pass) / std::sqrt(draft(pass));
}

double force_of_displacement(const DynamicPass &pass, const double y)
{
  // sqrt(dh + 2 y) - sqrt(dh) without cancellation
  return strength(pass) * 2 * y / (std::sqrt(draft(pass) + 2 * y) + std::sqrt(draft(pass)));
}

double displacement_of_force(const DynamicPass &pass, const double force)
{
  const double s = force / strength(pass);  // sqrt(dh + 2 y) = sqrt(dh) + s
  return 0.5 * s * (s + 2 * std::sqrt(draft(pass)));
}

double strip_constant(const VibratingStrip &strip, const double omega)
{
  require_input(strip.span > 0 && strip.amplitude > 0 && strip.mode > 0 && omega > 0,
                "vibrating strip: span, amplitude, mode and frequency must be positive");
  const double bow = M_PI * strip.mode * strip.amplitude;
  return bow * bow * omega / (16 * strip.span);
}

double strip_frequency(const VibratingStrip &strip, const double tension, const double density)
{
  require_input(strip.span > 0 && strip.mode > 0 && tension > 0 && density > 0,
                "vibrating strip: span, mode, tension and density must be positive");
  return strip.mode * M_PI / strip.span * std::sqrt(tension / density);
}

DynamicForces dynamic_forces(const std::vector<DynamicPass> &passes, const std::vector<bool> &in_fit)
{
  require_input(passes.size() == in_fit.size(), "dynamic force: one choice for each pass is needed");
  DynamicForces all;
  double logarithms = 0;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const DynamicPass &p = passes[i];
    check(p);
    DynamicForce f;
    f.name             = p.name;
    f.printed          = p.printed;
    f.per_displacement = force_per_displacement(p);
    if (p.printed > 0) {
      f.displacement = displacement_of_force(p, p.printed);
      f.constant     = f.displacement * p.exit_speed / p.exit_thickness;
      f.in_fit       = in_fit[i];
    }
    if (f.in_fit) {
      logarithms += std::log(f.constant);
      ++all.data;
    }
    all.passes.push_back(f);
  }
  if (all.data == 0)
    throw InputError("the constant of the dynamic force cannot be found: one unknown and no pass with a dynamic "
                     "force to fit it to");
  all.common = std::exp(logarithms / all.data);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    DynamicForce &f = all.passes[i];
    f.with_common = force_of_displacement(passes[i], all.common * passes[i].exit_thickness / passes[i].exit_speed);
    if (passes[i].printed > 0)
      f.common_error = f.with_common / passes[i].printed - 1;
  }
  return all;
}
}  // namespace mill::bite
