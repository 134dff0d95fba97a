#include "report/twin/calibration/figures.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
using nlohmann::json;

double value_of(const json &value)
{
  return value.is_number() ? value.get<double>() : std::nan("");
}

std::string spoken(std::string place)
{
  std::replace(place.begin(), place.end(), '_', ' ');
  return place;
}
}  // namespace

std::vector<std::string> response_drawings(const Table &response, const json &sensors)
{
  std::vector<std::string> drawings;
  const Eigen::VectorXd *frequency = response.column("frequency");
  for (const json &sensor : sensors) {
    const std::string name = sensor.get<std::string>();
    const auto *measured = response.column(name + ".measured"), *before = response.column(name + ".before"),
               *after = response.column(name + ".after");
    if (!frequency || !measured || !before || !after)
      continue;
    const bool per_force = response.units.size() > 1 && response.units[1] == "m/s2/N";  // else its level
    const double scale   = per_force ? 1000 : 1;                                        // per kN
    Plot plot;
    plot.title  = spoken(name);
    plot.width  = 1000;
    plot.height = 330;
    plot.x      = {"frequency", "Hz", Scale::logarithmic};
    plot.y      = per_force ? Axis{"acceleration per bite force", "m/s²/kN", Scale::logarithmic}
                            : Axis{"acceleration", "m/s²/√Hz", Scale::logarithmic};
    plot.lines  = {{"measured (check records)", *frequency, scale * *measured, Pen::pale},
                   {"case as it was", *frequency, scale * *before, Pen::dashed},
                   {"calibrated", *frequency, scale * *after, Pen::dark}};
    drawings.push_back(svg_plot(plot));
  }
  return drawings;
}

std::string force_drawing(const Table &force)
{
  const auto *frequency = force.column("frequency"), *density = force.column("density"),
             *low = force.column("low"), *high = force.column("high");
  if (!frequency || !density || !low || !high)
    return "";
  Plot plot;
  plot.width  = 1000;
  plot.height = 300;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  plot.y      = {"force", "N/√Hz", Scale::logarithmic};
  plot.lines  = {{"estimate", *frequency, *density, Pen::dark},
                 {"95 %", *frequency, *low, Pen::dotted},
                 {"", *frequency, *high, Pen::dotted}};
  return svg_plot(plot);
}

bool is_identified(const json &unknown)
{
  const char *const earlier = "told";  // name of the entry in folders of earlier versions
  return unknown.value("identified", unknown.value(earlier, false));
}

std::string moved_drawing(const json &unknowns)
{
  Plot plot;
  plot.width  = 1000;
  plot.height = 300;
  plot.x      = {"unknown", "-"};
  plot.y      = {"moved, over the deviation of the prior", "-"};
  Line known{"identified: estimate and 95 %", {}, {}, Pen::dark, true, true},
      open{"not identified", {}, {}, Pen::warm, true, true};
  // one broken line: low, estimate, high, gap
  std::vector<double> tx, ty, ox, oy;
  int i = 0;
  for (const json &u : unknowns) {
    const double sd = value_of(u["prior_sd"]), prior = value_of(u["prior"]);
    plot.x.categories.push_back(u["name"].get<std::string>());
    const bool sure = is_identified(u);
    auto &x = sure ? tx : ox, &y = sure ? ty : oy;
    for (const double at :
         {value_of(u["interval"][0]), value_of(u["estimate"]), value_of(u["interval"][1]), std::nan("")}) {
      x.push_back(double(i));
      y.push_back((at - prior) / sd);
    }
    ++i;
  }
  const auto filled = [&](Line &line, const std::vector<double> &x, const std::vector<double> &y) {
    line.x = Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size()));
    line.y = Eigen::Map<const Eigen::VectorXd>(y.data(), Eigen::Index(y.size()));
    if (!x.empty())
      plot.lines.push_back(line);
  };
  filled(known, tx, ty);
  filled(open, ox, oy);
  const double last = double(std::max(1, i - 1));
  plot.x.low        = -0.5;
  plot.x.high       = last + 0.5;
  for (const double limit : {-3.0, 3.0})
    plot.lines.push_back({limit < 0 ? "limit of 3" : "", Eigen::Vector2d(-0.5, last + 0.5),
                          Eigen::Vector2d(limit, limit), Pen::dotted});
  return svg_plot(plot);
}

std::string residual_drawing(const json &bands, const json &sensors, const std::string &title)
{
  constexpr Pen pens[] = {Pen::dark, Pen::warm, Pen::dashed, Pen::chained, Pen::warm_dashed, Pen::dark_dashed};
  Plot plot;
  plot.title      = title;
  plot.width      = 490;
  plot.height     = 300;
  plot.x          = {"third octave", "Hz", Scale::logarithmic};
  plot.y          = {"left, over its limit", "-"};
  std::size_t pen = 0;
  double from = std::nan(""), to = std::nan("");
  for (const json &sensor : sensors) {
    std::vector<double> x, y;
    for (const json &band : bands)
      if (band["sensor"] == sensor && band["counts"].get<bool>()) {
        x.push_back(value_of(band["centre"]));
        y.push_back(value_of(band["ratio"]) / value_of(band["limit"]));
      }
    if (x.empty())
      continue;
    from = std::isnan(from) ? x.front() : std::min(from, x.front());
    to   = std::isnan(to) ? x.back() : std::max(to, x.back());
    plot.lines.push_back(
        {spoken(sensor.get<std::string>()), Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size())),
         Eigen::Map<const Eigen::VectorXd>(y.data(), Eigen::Index(y.size())), pens[pen++ % 6], true, true});
  }
  if (!std::isnan(from))
    plot.lines.push_back({"limit", Eigen::Vector2d(from, to), Eigen::Vector2d(1, 1), Pen::dotted});
  plot.y.low = 0;
  return svg_plot(plot);
}

std::string level_drawing(const json &bands, const std::string &title)
{
  std::vector<double> x, ratio, high, low;
  for (const json &band : bands)
    if (band["counts"].get<bool>()) {
      x.push_back(value_of(band["centre"]));
      ratio.push_back(value_of(band["ratio"]));
      high.push_back(value_of(band["limit"]));
      low.push_back(1 / high.back());
    }
  const auto column = [](const std::vector<double> &values) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size())));
  };
  Plot plot;
  plot.title  = title;
  plot.width  = 490;
  plot.height = 300;
  plot.x      = {"band", "Hz", Scale::logarithmic};
  plot.y      = {"level over its surroundings", "-"};
  plot.lines  = {{"twelfth octaves", column(x), column(ratio), Pen::dark, true, true},
                 {"limits", column(x), column(high), Pen::dotted},
                 {"", column(x), column(low), Pen::dotted}};
  plot.y.low  = 0;
  return svg_plot(plot);
}

std::vector<std::string> profile_drawings(const Table &profiles)
{
  std::vector<std::string> drawings;
  for (std::size_t c = 0; c + 1 < profiles.columns.size(); c += 2) {
    const std::string name = profiles.names[c].substr(0, profiles.names[c].find('.'));
    Plot plot;
    plot.title              = name;
    plot.width              = 325;
    plot.height             = 260;
    plot.x                  = {"change of " + name, "%"};
    plot.y                  = {"deviance", "-"};
    const Eigen::VectorXd x = 100 * (profiles.columns[c].array().exp() - 1).matrix();
    const Eigen::VectorXd y = profiles.columns[c + 1].cwiseMin(60.0);
    plot.lines              = {{"", x, y, Pen::dark, true},
                               {"95 %: 3.84", Eigen::Vector2d(x[0], x[x.size() - 1]), Eigen::Vector2d(3.84, 3.84), Pen::dotted},
                               {"second minimum: 9", Eigen::Vector2d(x[0], x[x.size() - 1]), Eigen::Vector2d(9, 9), Pen::pale}};
    plot.y.low              = 0;
    plot.y.high             = 60;
    drawings.push_back(svg_plot(plot));
  }
  return drawings;
}
}  // namespace mill::report
