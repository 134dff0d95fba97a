#include "report/results/tables.h"
#include "core/records/bite_model.h"
#include "report/bite/figures.h"
#include "report/page/cells.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/named_mode.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
// A number, and in brackets how far it is from the one it is compared with.
std::string compared_cell(const double value, const double reference, const int digits = 4)
{
  return cell(significant(value, digits) + (value == reference ? "" : deviation_note(value, reference)));
}

// What the others are compared with: the finite elements where the run has them, else the first model.
std::string reference_of(const BitePass &pass)
{
  return pass.models.empty() ? "" : pass.models.front();
}

std::string source_of(const Run &run, const BitePass &pass, const std::string &model)
{
  const Result *force = run.find(result_name({family::bite, pass.name, model, "force"}));
  if (!force)
    return "";
  return method_of(*force);
}

double k4(const Run &run, const std::string &quantity)
{
  const Result *result = run.find(result_name({family::bite_spring, quantity}));
  return result ? result->value : std::nan("");
}

std::string in_kN_per_mm(const double value)
{
  return significant(1e-6 * value, 4) + "\u00a0kN/mm";
}
}  // namespace

std::string bite_model_table(const Run &run, const BitePass &pass)
{
  if (pass.models.size() < 2)
    return "";
  struct Entry {
    const char *quantity, *head;
    double factor;
  };
  const Entry entries[] = {
      {"force", "force [kN]", 1e-3},
      {"torque", "torque of one roll [kN\u00a0m]", 1e-3},
      {"forward_slip", "forward slip [%]", 100},
      {"neutral_angle", "neutral angle [\u00b0]", 180 / EIGEN_PI},
      {"flattened_radius", "radius of the arc [mm]", 1e3},
      {"plastic_slope", "K4, plastic slope [kN/mm]", 1e-6},
  };
  const std::string reference = reference_of(pass);
  std::string head            = "<th>model</th>", body;
  std::vector<const Entry *> shown;
  for (const Entry &entry : entries)
    if (std::any_of(pass.models.begin(), pass.models.end(), [&](const std::string &model) {
          return std::isfinite(bite_value(run, pass, entry.quantity, model));
        })) {
      shown.push_back(&entry);
      head += std::string("<th>") + entry.head + "</th>";
    }
  for (const std::string &model : pass.models) {
    const std::string source = source_of(run, pass, model);
    body += "<tr><th scope=\"row\">" + bite_model_name(model) +
            (source.empty() ? "" : "<small>" + escaped(source) + "</small>") + "</th>";
    for (const Entry *entry : shown)
      body += compared_cell(entry->factor * bite_value(run, pass, entry->quantity, model),
                            entry->factor * bite_value(run, pass, entry->quantity, reference));
    body += "</tr>\n";
  }
  return table_of(head, body);
}

std::string bite_breakdown_table(const Run &run, const BitePass &pass)
{
  const auto force = [&](const std::string &model) { return 1e-3 * bite_value(run, pass, "force", model); };
  struct Step {
    std::string what;
    double force;
  };
  std::vector<Step> steps;
  const auto add = [&](const std::string &what, const double value) {
    if (std::isfinite(value))
      steps.push_back({what, value});
  };
  const double rigid = force(word_of(BiteModel::karman_rigid)), circle = force(word_of(BiteModel::karman));
  add("homogeneous slab on a rigid roll (K\u00e1rm\u00e1n)", rigid);
  if (circle != rigid)
    add("the roll flattens (Hitchcock's circle)", circle);
  add("stress changes over the thickness (Orowan)", force("orowan"));
  add("all other effects in the finite elements: shear through the strip, its ends, the free shape of the roll",
      force("fe"));
  if (steps.size() < 2)
    return "";
  std::string body;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double change = i > 0 ? steps[i].force - steps[i - 1].force : std::nan("");
    body += "<tr><th scope=\"row\">" + steps[i].what + "</th>" +
            cell(i > 0 ? (change >= 0 ? "+" : "") + significant(change, 3) : "") +
            cell(i > 0 ? percent(change / steps[0].force) : "") + cell(significant(steps[i].force, 4)) + "</tr>\n";
  }
  return table_of("<th>step</th><th>change [kN]</th><th>relative to the rigid roll</th><th>force [kN]</th>", body);
}

std::string bite_pass_table(const Run &run, const std::vector<BitePass> &passes)
{
  if (passes.size() < 2)
    return "";
  std::string body;
  for (const BitePass &pass : passes) {
    const auto value         = [&](const char *quantity) { return bite_value(run, pass, quantity); };
    const double model_slope = bite_value(run, pass, "plastic_slope", reference_of(pass));
    body += "<tr><th scope=\"row\">" + escaped(pass.name) + "</th>" + cell(significant(1e-3 * value("force"))) +
            cell(significant(1e-3 * value("torque"))) + cell(significant(100 * value("forward_slip"), 3)) +
            cell(significant(1e-6 * value("peak_pressure"))) + cell(significant(value("friction"), 3)) +
            cell(significant(1e3 * value("flattened_radius"))) + cell(significant(1e-6 * model_slope)) + "</tr>\n";
  }
  return table_of(
      "<th>pass</th><th>force [kN]</th><th>torque of one roll [kN\u00a0m]</th><th>forward slip "
      "[%]</th><th>peak pressure [MPa]</th><th>friction</th><th>radius of the arc [mm]</th><th>K4, plastic "
      "slope [kN/mm]</th>",
      body);
}

std::string k4_table(const Run &run)
{
  struct Entry {
    const char *quantity, *what;
  };
  const Entry entries[] = {
      {"plastic_slope", "how much the force falls when the gap opens, entry thickness held"},
      {"flattening", "force over elastic approach of <b>one</b> roll's surface and its axis"},
      {"combined", "both in series, plastic slope and two rolls: what acts between the work rolls"},
      {"path_plateau", "nodal force over nodal displacement along the contact: shrinks with every element"},
  };
  std::string body;
  for (const Entry &entry : entries) {
    const Result *result = run.find(result_name({family::bite_spring, entry.quantity}));
    if (!result)
      continue;
    body += std::string("<tr><th scope=\"row\"><code>K4.") + entry.quantity + "</code><small>" + entry.what +
            "</small></th>" + cell(known_digits(1e-6 * result->value, result->error_estimate)) + "<td>" +
            accuracy_cell(*result) + "</td><td>" + escaped(short_source(result->source)) + "</td></tr>\n";
  }
  return body.empty() ? "" : table_of("<th>name</th><th>value [kN/mm]</th><th>accuracy</th><th>source</th>", body);
}

std::string k4_relation(const Run &run)
{
  const double slope = k4(run, "plastic_slope"), flat = k4(run, "flattening"), combined = k4(run, "combined"),
               path = k4(run, "path_plateau");
  if (!std::isfinite(slope))
    return "";
  std::string text = "Four stiffnesses are called K4, and they differ by orders of magnitude. The <b>plastic "
                     "slope</b>, " +
                     in_kN_per_mm(slope) +
                     ", is not an elastic stiffness: when the gap opens by a micrometre, the strip is reduced "
                     "less and the force falls, which acts like a spring on small motions";
  if (std::isfinite(flat))
    text += ". The <b>flattening</b>, " + in_kN_per_mm(flat) + " for one roll, is elastic and " +
            significant(flat / slope, 3) + " times as stiff";
  if (std::isfinite(combined))
    text += "; in <b>series</b> with two of them the slope becomes " + in_kN_per_mm(combined) + " (" +
            percent(combined / slope - 1) +
            "), which acts between the work rolls against a disturbance of the strip";
  text += ".";
  if (std::isfinite(path)) {
    text += " The <b>path plateau</b>, " + in_kN_per_mm(path) +
            ", divides the force of one node by the displacement of that node. With half the element length the "
            "force of a node halves and its displacement stays: it is a property of the mesh, not of the mill, "
            "and is given here because published values are of that kind";
    const Result *result = run.find(result_name({family::bite_spring, "path_plateau"}));
    for (const Check &check : result->checks)
      if (std::isfinite(check.value) && check.value > 0)
        text += "; " + escaped(check.name) + ": " + in_kN_per_mm(check.value);
    text += ".";
  }
  return text +
         " A <b>measured</b> rolling force already includes the reaction of the strip: with one, K4 in the chain "
         "is zero.";
}
}  // namespace mill::report
