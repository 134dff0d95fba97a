#include "report/models/figures.h"
#include "report/page/cells.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
std::string share(const double value)
{
  return std::isfinite(value) ? fixed(100 * value, value > 0.995 && value < 1 ? 1 : 0) + "\u00a0%" : "\u2013";
}

// The six masses' mode for a mode of the detailed model; nullptr when none is like it.
const ModePartners *chain_mode(const ModelData &data, const std::string &model, const int mode)
{
  const ModePartners *best = nullptr;
  double likeness          = 0;
  for (const ModePartners &pair : data.pairs)
    if (const auto match = pair.partner.find(model); match != pair.partner.end() && match->second.mode == mode)
      if (const double mac = match->second.mac; !(mac < alike) && (!best || mac > likeness)) {
        best     = &pair;
        likeness = mac;
      }
  return best;
}

// Frequencies of a mode in the other detailed model, by likeness.
double other_frequency(const ModelData &data, const ComparedModel &detailed, const int mode)
{
  const MacTable &mac = data.mac;
  if (mac.rows == detailed.name)
    if (const int partner = mac_partner(mac, mode))
      return mac.column_frequency[partner - 1];
  return std::nan("");
}

std::string verdict(const ModePartners *pair, const double frequency)
{
  if (!pair)
    return "<td class=\"poor-word\">cannot be shown</td>";
  const double error = std::abs(pair->six_mass / frequency - 1);
  return std::string("<td class=\"") +
         (error <= 0.03  ? "good-word"
          : error <= 0.1 ? "fair-word"
                         : "poor-word") +
         "\">" + (error <= 0.05 ? "right to " : "wrong by ") + significant(100 * error, 2) + "\u00a0%</td>";
}
}  // namespace

namespace {
// Shapes that look alike at the places compared are not counterparts when their frequencies are far apart.
bool near(const MacTable &mac, const Eigen::Index row, const Eigen::Index column)
{
  if (mac.row_frequency.size() <= row || mac.column_frequency.size() <= column)
    return true;
  return !(std::abs(std::log(mac.row_frequency[row] / mac.column_frequency[column])) > std::log(1.5));
}
}  // namespace

int mac_partner(const MacTable &mac, const int row)
{
  if (row < 1 || row > mac.values.rows() || mac.values.cols() == 0)
    return 0;
  int best = 0;
  for (Eigen::Index j = 0; j < mac.values.cols(); ++j)
    if (const double v = mac.values(row - 1, j);
        v >= alike && near(mac, row - 1, j) && (!best || v > mac.values(row - 1, best - 1)))
      best = int(j) + 1;
  // Two modes may both look like one of the other model; it is the counterpart of the more alike.
  return best && mac.values(row - 1, best - 1) >= mac.values.col(best - 1).maxCoeff() ? best : 0;
}

std::string model_table(const ModelData &data)
{
  std::string body;
  for (const ComparedModel &model : data.models) {
    const auto below = std::count_if(model.modes.begin(), model.modes.end(), [&](const ModelMode &mode) {
      return !(mode.frequency > data.frequency_limit);
    });
    body += "<tr><th scope=\"row\">" + escaped(model.title) + "</th>" + cell(std::to_string(model.unknowns)) +
            cell(std::to_string(below)) + "<td>" + escaped(model.source) + "</td></tr>\n";
  }
  if (body.empty())
    return "";
  return table_of("<th>model</th><th>unknowns</th><th>modes" +
                      (std::isfinite(data.frequency_limit)
                           ? " below " + significant(data.frequency_limit, 4) + "\u00a0Hz"
                           : std::string()) +
                      "</th><th>made from</th>",
                  body);
}

std::string verdict_table(const ModelData &data)
{
  const ComparedModel *detailed = data.detailed();
  if (!detailed || !data.find("six-mass"))
    return "";
  const bool named  = std::any_of(detailed->modes.begin(), detailed->modes.end(),
                                  [](const ModelMode &mode) { return !mode.name.empty(); });
  const bool second = data.mac.rows == detailed->name && data.find(data.mac.columns);
  std::string body;
  for (int mode = 1; mode <= int(detailed->modes.size()); ++mode) {
    const ModelMode &shown = detailed->modes[std::size_t(mode - 1)];
    if (shown.frequency > data.frequency_limit)
      continue;
    const ModePartners *pair = chain_mode(data, detailed->name, mode);
    body += "<tr><th scope=\"row\">" + std::to_string(mode) + "</th>" +
            (named ? "<td title=\"" + escaped(shown.decided) + "\">" + escaped(shown.name) + "</td>" : "") +
            cell("<b>" + frequency_text(shown.frequency, shown.error_estimate) + "</b>");
    if (second) {
      const double other = other_frequency(data, *detailed, mode);
      body += cell(fixed(other, 1) + (std::isfinite(other) ? " <span class=\"deviation\">(" +
                                                                 percent(other / shown.frequency - 1) + ")</span>"
                                                           : ""));
    }
    body += pair ? cell(fixed(pair->six_mass, 1) + " <span class=\"deviation\">(" +
                        percent(pair->six_mass / shown.frequency - 1) + ")</span>") +
                       cell(fixed(pair->partner.at(detailed->name).mac, 2))
                 : cell("\u2013") + cell("\u2013");
    body += cell(share(shown.in_chain)) + verdict(pair, shown.frequency) + "</tr>\n";
  }
  if (body.empty())
    return "";
  return table_of(std::string("<th>mode</th>") + (named ? "<th>name</th>" : "") + "<th>" +
                      escaped(detailed->title) + " [Hz]</th>" +
                      (second ? "<th>" + escaped(data.title(data.mac.columns)) + " [Hz]</th>" : "") + "<th>" +
                      escaped(data.title("six-mass")) +
                      " [Hz]</th><th>likeness [-]</th><th>within reach</th><th>the six masses</th>",
                  body);
}

std::string stray_sentence(const ModelData &data)
{
  const ComparedModel *detailed = data.detailed();
  if (!detailed)
    return "";
  std::vector<std::string> strays;
  for (const ModePartners &pair : data.pairs) {
    const auto match = pair.partner.find(detailed->name);
    if (match != pair.partner.end() && !(match->second.mac < alike))
      continue;
    strays.push_back("mode " + std::to_string(pair.mode) + " (" + fixed(pair.six_mass, 1) + "\u00a0Hz)");
  }
  if (strays.empty())
    return "";
  std::string all = strays.front();
  for (std::size_t i = 1; i < strays.size(); ++i)
    all += (i + 1 == strays.size() ? " and " : ", ") + strays[i];
  return "Of the six masses' own modes, " + all + (strays.size() == 1 ? " looks" : " look") +
         " like no mode of the detailed model: a peak there in a simulated response is not a mode of the stand.";
}
}  // namespace mill::report
