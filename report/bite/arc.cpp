#include "core/base/files.h"
#include "core/records/rows_of_bite.h"
#include "report/bite/figures.h"
#include "report/page/curves.h"
#include "report/results/names.h"
#include <algorithm>
#include <cctype>
#include <cmath>

namespace mill::report {
namespace {
using Eigen::Index;
using Eigen::VectorXd;

struct Model {
  const char *key, *name;
  Pen pen;
  bool drawn;  // along the arc; the others only widen the table
};
// In the order in which they are shown.
const Model known_models[] = {
    {"fe", "finite elements", Pen::dark, true},
    {"karman-elastic-arc", "K\u00e1rm\u00e1n, free arc of the roll", Pen::dotted, true},
    {"orowan", "Orowan, inhomogeneous", Pen::dashed, true},
    {"karman", "K\u00e1rm\u00e1n, homogeneous", Pen::warm, true},
    {"bland-ford", "Bland and Ford", Pen::pale, true},
    {"hu-ehmann", "Hu and Ehmann", Pen::chained, true},
    {"sims", "Sims, sticking friction", Pen::pale, false},
    {"karman-rigid", "K\u00e1rm\u00e1n, homogeneous, rigid roll", Pen::pale, false},
};

const Model *find_model(const std::string &key)
{
  for (const Model &model : known_models)
    if (key == model.key)
      return &model;
  return nullptr;
}

Plot along_arc(const char *title, const char *quantity, const char *unit, const bool narrow = false)
{
  Plot plot;
  plot.title = title;
  if (narrow) {
    plot.width  = 333;
    plot.height = 320;
  }
  plot.x = {narrow ? "distance from the line of centres" : "distance from the line of centres, entry to the right",
            "mm"};
  plot.y = {quantity, unit};
  return plot;
}

// One line per model that is drawn; the neutral point of the first that has one is marked.
bool add_models(Plot &plot, const Run &run, const BitePass &pass, const char *column, const char *unit,
                const bool named = true)
{
  bool marked = false;
  for (const std::string &key : pass.models) {
    const Model *model = find_model(key);
    const Table *arc   = bite_table(run, pass, key);
    if (!arc || (model && !model->drawn))
      continue;
    if (add_line(plot, *arc, {"x", "mm"}, {column, unit}, named ? bite_model_name(key) : "",
                 model ? model->pen : Pen::pale) &&
        !marked)
      if (const double x = neutral_point(*arc); std::isfinite(x)) {
        plot.marks.push_back({1e3 * x, "neutral point"});
        marked = true;
      }
  }
  return !plot.lines.empty();
}
}  // namespace

std::vector<BitePass> bite_passes(const Run &run)
{
  std::vector<BitePass> passes;
  for (const Result &result : run.results) {
    const auto id = result_id(result.name);
    if (!id || !id->is_of(row::bite::force))
      continue;
    const std::string name = id->place("pass");
    BitePass pass{name, slug(name), {}};
    for (const PassInfo &info : run.manifest.passes)
      if (info.name == name)
        pass.slug = info.slug;
    for (const Model &model : known_models)
      if (run.find(row::bite_model::force.of(name, model.key)))
        pass.models.push_back(model.key);
    for (const Result &other : run.results)
      if (const auto of_model = result_id(other.name);
          of_model && of_model->is_of(row::bite_model::force) && name == of_model->place("pass"))
        if (const std::string key = of_model->place("bite_model"); !find_model(key))
          pass.models.push_back(key);
    passes.push_back(std::move(pass));
  }
  return passes;
}

std::string bite_model_name(const std::string &key)
{
  const Model *model = find_model(key);
  return model ? model->name : key;
}

double bite_value(const Run &run, const BitePass &pass, const std::string &quantity, const std::string &model)
{
  const Result *result = run.find(result_name({family::bite, pass.name, model, quantity}));
  return result ? result->value : std::nan("");
}

const Table *bite_table(const Run &run, const BitePass &pass, const std::string &what)
{
  return stored_curve(run, curve::bite_arc, pass.slug, what);
}

double neutral_point(const Table &arc)
{
  const VectorXd x = values_of(arc, {"x", "m"}), slip = values_of(arc, {"slip", "-"});
  double result = std::nan("");
  if (slip.size() != x.size())
    return result;
  // Where the strip is at rest against the roll the computed slip changes sign within rounding.
  const double noise = slip.size() > 0 ? 1e-9 * slip.cwiseAbs().maxCoeff() : 0;
  Index last         = -1;
  for (Index i = 0; i < x.size(); ++i) {
    if (!(std::abs(slip[i]) > noise))
      continue;
    if (last >= 0 && slip[i] * slip[last] < 0) {
      if (std::isfinite(result))
        return std::nan("");
      result = x[last] - slip[last] * (x[i] - x[last]) / (slip[i] - slip[last]);
    }
    last = i;
  }
  return result;
}

std::string bite_pressure(const Run &run, const BitePass &pass)
{
  Plot plot  = along_arc("Pressure on the roll", "pressure", "MPa");
  plot.y.low = 0;
  return add_models(plot, run, pass, "pressure", "MPa") ? svg_plot(plot) : "";
}

std::string bite_shear(const Run &run, const BitePass &pass)
{
  Plot plot = along_arc("Friction stress on the strip", "friction stress, towards the exit", "MPa");
  if (!add_models(plot, run, pass, "shear", "MPa"))
    return "";
  const Table *arc = bite_table(run, pass, "fe");
  if (const double mu = bite_value(run, pass, "friction"); arc && mu > 0) {
    const VectorXd x = values_of(*arc, {"x", "mm"}), p = values_of(*arc, {"pressure", "MPa"});
    if (p.size() == x.size() && x.size() > 0) {
      plot.lines.push_back({"\u00b1\u00b5p of the finite elements", x, mu * p, Pen::pale_dashed});
      plot.lines.push_back({"", x, -mu * p, Pen::pale_dashed});
    }
  }
  return svg_plot(plot);
}

std::string bite_slip(const Run &run, const BitePass &pass)
{
  Plot plot = along_arc("Slip of the strip on the roll", "strip speed over roll speed, less one", "%", true);
  return add_models(plot, run, pass, "slip", "%", false) ? svg_plot(plot) : "";
}

std::string bite_shapes(const Table &roll)
{
  Plot plot = along_arc("Roll and strip", "height over the middle of the strip", "mm", true);
  add_line(plot, roll, {"x", "mm"}, {"strip", "mm"}, "surface of the strip", Pen::warm);
  add_line(plot, roll, {"x", "mm"}, {"circle", "mm"}, "circle of the unloaded roll", Pen::pale_dashed);
  add_line(plot, roll, {"x", "mm"}, {"roll", "mm"}, "loaded roll", Pen::dark);
  return plot.lines.empty() ? "" : svg_plot(plot);
}

std::string bite_flattening(const Table &roll)
{
  const VectorXd x = values_of(roll, {"x", "mm"}), circle = values_of(roll, {"circle", "\u00b5m"}),
                 surface = values_of(roll, {"roll", "\u00b5m"});
  if (x.size() == 0 || circle.size() != x.size() || surface.size() != x.size())
    return "";
  if ((surface - circle).cwiseAbs().maxCoeff() < 1e-3)
    return "";  // nanometres: a rigid roll
  Plot plot = along_arc("How far the roll deflects", "loaded roll over its circle", "\u00b5m", true);
  plot.lines.push_back({"", x, surface - circle, Pen::dark});
  return svg_plot(plot);
}
}  // namespace mill::report
