#include "core/model/dynamics_settings.h"
#include "report/frequency/figures.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr double per_kilonewton = 1e3;  // 1/kg = (m/s2)/N
const char *const unit          = "(m/s\u00b2)/kN";

const char *const force_places[] = {"upper backup roll",     "upper work roll",    "lower work roll",
                                    "lower backup roll",     "upper backup chock", "upper work-roll chock",
                                    "lower work-roll chock", "lower backup chock"};

std::string column_of(std::string place)
{
  std::replace(place.begin(), place.end(), ' ', '-');
  return place;
}

struct Parts {
  Eigen::VectorXd f, real, imag;
  bool stored() const
  {
    return f.size() > 1 && real.size() == f.size() && imag.size() == f.size();
  }
  Eigen::VectorXd magnitude() const
  {
    return per_kilonewton * (real.cwiseAbs2() + imag.cwiseAbs2()).cwiseSqrt();
  }
};

Parts response_parts(const Run &run, const std::string &model, const std::string &force, const std::string &place)
{
  const Table *table = stored_curve(run, curve::frf, model + "-" + column_of(force));
  if (!table)
    return {};
  const Eigen::VectorXd *real = table->column(column_of(place) + "_real"),
                        *imag = table->column(column_of(place) + "_imag");
  return real && imag ? Parts{values_of(*table, {"frequency", "Hz"}), *real, *imag} : Parts{};
}

Plot frame(const std::string &title, const double height)
{
  Plot plot;
  plot.title  = title;
  plot.width  = 510;
  plot.height = height;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  return plot;
}

// Four decades below the largest value is more than a sensor resolves.
void limit_height(Plot &plot)
{
  double largest = 0;
  for (const Line &line : plot.lines)
    largest = std::max(largest, line.y.maxCoeff());
  if (largest > 0 && std::isfinite(largest)) {
    plot.y.low  = 1e-4 * largest;
    plot.y.high = 2 * largest;
  }
}
}  // namespace

std::string responding_model(const Run &run)
{
  for (const char *model : {"craig-bampton", "beam", "six-mass"})
    if (stored_curve(run, curve::frf, std::string(model) + "-bite"))
      return model;
  return "";
}

std::vector<std::string> responding_places(const Run &run, const std::string &model)
{
  std::vector<std::string> texts;
  for (const char *place : force_places)
    if (response_parts(run, model, "bite", place).stored())
      texts.emplace_back(place);
  return texts;
}

std::string magnitude_drawing(const Run &run, const std::string &model, const std::string &place)
{
  Plot plot = frame("Magnitude, " + place, 360);
  plot.y    = {"acceleration / bite force", unit, Scale::logarithmic};
  if (const Table *band = stored_curve(run, curve::frf_band, model + "-bite"))
    for (const auto &[end, label] : {std::pair("_low", "95 % band"), std::pair("_high", "")})
      if (const Eigen::VectorXd *edge = band->column(column_of(place) + end))
        plot.lines.push_back({label, values_of(*band, {"frequency", "Hz"}), per_kilonewton * *edge, Pen::pale});
  const std::pair<StandModelKind, const char *> models[] = {{StandModelKind::craig_bampton, "finite elements"},
                                                            {StandModelKind::beam, "beams"},
                                                            {StandModelKind::six_mass, "six masses"}};
  for (const auto &[kind, label] : models)
    if (const Parts parts = response_parts(run, word_of(kind), "bite", place); parts.stored())
      plot.lines.push_back({label, parts.f, parts.magnitude(),
                            model == word_of(kind)         ? Pen::dark
                            : kind == StandModelKind::beam ? Pen::dotted
                                                           : Pen::warm_dashed});
  limit_height(plot);
  return svg_plot(plot);
}

std::string phase_drawing(const Run &run, const std::string &model, const std::string &place)
{
  const Parts parts = response_parts(run, model, "bite", place);
  Plot plot         = frame("Phase, " + place, 360);
  plot.y            = {"phase against the bite force", "deg", Scale::linear, -180, 180};
  if (parts.stored()) {
    Eigen::VectorXd phase = parts.imag.binaryExpr(
        parts.real, [](const double im, const double re) { return std::atan2(im, re) * 180 / M_PI; });
    for (Eigen::Index i = 1; i < phase.size(); ++i)  // a jump by a full turn is not drawn as a line
      if (std::abs(phase[i] - phase[i - 1]) > 270)
        phase[i - 1] = std::nan("");
    plot.lines.push_back({"", parts.f, phase, Pen::dark});
  }
  return svg_plot(plot);
}

std::string places_drawing(const Run &run, const std::string &model, const std::string &title,
                           const std::vector<std::string> &wanted, const bool at_itself)
{
  Plot plot        = frame(title, 380);
  plot.y           = {"acceleration / force", unit, Scale::logarithmic};
  const Pen pens[] = {Pen::dark, Pen::warm, Pen::dashed, Pen::warm_dashed};
  for (const std::string &place : wanted)
    if (const Parts parts = response_parts(run, model, at_itself ? place : "bite", place); parts.stored())
      plot.lines.push_back({place, parts.f, parts.magnitude(), pens[plot.lines.size() % 4]});
  if (plot.lines.empty())
    return "";
  limit_height(plot);
  return svg_plot(plot);
}
}  // namespace mill::report
