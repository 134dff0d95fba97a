#include "app/stages/chatter_files.h"
#include "app/stages/chatter_results.h"
#include "core/records/csv.h"
#include "dynamics/chatter/loop.h"
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
using Json = nlohmann::ordered_json;
using dynamics::Verdict;

Json number(const double x)
{
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

std::string base_of(const ChatterStudy &s)
{
  return "chatter-" + slug(s.question.condition.name);
}

// Growth, frequency and bite over speed; the process damping at the frequency of the mode in question.
void write_speeds(RunContext &run, const ChatterStudy &s)
{
  const ChatterQuestion &q  = s.question;
  const auto n              = Eigen::Index(s.found.points.size());
  const double at_frequency = s.mode ? s.mode->frequency : 0;
  Eigen::VectorXd speed(n), growth(n), frequency(n), force(n), friction(n), film(n), damping(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto &point = s.found.points[std::size_t(i)];
    const auto &state = s.found.states[std::size_t(i)];
    const bool bite   = point.no_bite.empty();
    speed[i]          = point.speed;
    growth[i]         = point.growth;
    frequency[i]      = point.frequency;
    force[i]          = bite ? state.force / 1e3 : not_given;
    friction[i]       = bite ? state.friction : not_given;
    film[i]           = bite ? 1e6 * state.film_thickness : not_given;
    damping[i]        = not_given;
    if (bite && at_frequency > 0) {
      const auto by = dynamics::working_point(q.bite, point.speed, q.scheme).by;
      damping[i]    = dynamics::process_damping(q.stand, by, at_frequency) / 1e6;
    }
  }
  Table table;
  table.add("speed", "m/s", speed).add("growth_rate", "1/s", growth).add("frequency", "Hz", frequency);
  table.add("force", "kN", force).add("friction", "-", friction);
  if (!film.array().isNaN().all())
    table.add("film_thickness", "um", film);
  if (at_frequency > 0)
    table.add("process_damping", "MN s/m", damping);
  run.out.write("curves/" + base_of(s) + "-speed.csv", csv_text(table));
}

// One branch of each pair of roots.
void write_locus(RunContext &run, const ChatterStudy &s)
{
  const auto &locus = s.locus;
  Table table;
  table.add("speed", "m/s", locus.speed);
  int mode = 0;
  for (Eigen::Index b = 0; b < locus.branch.rows(); ++b) {
    const Eigen::VectorXd imaginary = locus.branch.row(b).imag(), real = locus.branch.row(b).real();
    const double mean = imaginary.array().isNaN().select(0, imaginary).sum();
    if (mean < 0)
      continue;  // the other half of a pair
    const std::string name = "mode" + std::to_string(++mode);
    table.add(name + "_growth", "1/s", real).add(name + "_frequency", "Hz", imaginary / (2 * M_PI));
  }
  if (mode > 0)
    run.out.write("curves/" + base_of(s) + "-locus.csv", csv_text(table));
}

struct MapAxis {
  std::string name, unit;
  double factor;
};

MapAxis axis_of(const dynamics::MapQuantity quantity)
{
  switch (quantity) {
  case dynamics::MapQuantity::reduction:
    return {"reduction", "%", 100};
  case dynamics::MapQuantity::tension:
    return {"tension", "%", 100};
  case dynamics::MapQuantity::viscosity:
    break;
  }
  return {"viscosity", "mPa s", 1e3};
}

void write_maps(RunContext &run, const ChatterStudy &s)
{
  for (const dynamics::StabilityMap &map : s.maps) {
    const MapAxis axis   = axis_of(map.quantity);
    const Eigen::Index n = map.speed.size(), m = map.value.size();
    Eigen::VectorXd speed(n * m), value(n * m), growth(n * m), frequency(n * m);
    for (Eigen::Index j = 0; j < m; ++j) {
      speed.segment(j * n, n)     = map.speed;
      value.segment(j * n, n)     = Eigen::VectorXd::Constant(n, axis.factor * map.value[j]);
      growth.segment(j * n, n)    = map.growth.col(j);
      frequency.segment(j * n, n) = map.frequency.col(j);
    }
    Table table, boundary;
    table.add("speed", "m/s", speed).add(axis.name, axis.unit, value);
    table.add("growth_rate", "1/s", growth).add("frequency", "Hz", frequency);
    boundary.add(axis.name, axis.unit, axis.factor * map.value);
    boundary.add("critical_speed", "m/s", map.critical_speed).add("frequency", "Hz", map.critical_frequency);
    run.out.write("curves/" + base_of(s) + "-map-" + axis.name + ".csv", csv_text(table));
    run.out.write("curves/" + base_of(s) + "-boundary-" + axis.name + ".csv", csv_text(boundary));
  }
}

Table history_table(const ChatterStudy &s, const dynamics::ChatterHistory &h, const double force,
                    const double entry_tension, const double exit_tension, const double friction)
{
  const auto &labels = s.question.stand.structure.labels;
  const auto row_of  = [&](const std::string &label) -> Eigen::VectorXd {
    const auto found = std::find(labels.begin(), labels.end(), label);
    return 1e6 * h.point.row(found - labels.begin()).transpose();
  };
  Table table;
  table.add("time", "s", h.time).add("gap", "um", 1e6 * h.gap);
  for (const char *roll : {"upper work roll", "lower work roll"})
    if (std::find(labels.begin(), labels.end(), roll) != labels.end())
      table.add(std::string(roll).substr(0, 5) + "_work_roll", "um", row_of(roll));
  table.add("force", "kN", (h.force.array() + force) / 1e3);
  table.add("entry_tension", "MPa", (h.entry_tension.array() + entry_tension) / 1e6);
  table.add("exit_tension", "MPa", (h.exit_tension.array() + exit_tension) / 1e6);
  table.add("friction", "-", h.friction.array() + friction);
  return table;
}

void write_histories(RunContext &run, const ChatterStudy &s)
{
  for (const ChatterRecord &record : s.records)
    run.out.write("response/" + base_of(s) + "-" + record.name + ".csv",
                  csv_text(history_table(s, record.history, 0, 0, 0, 0)));
  if (s.run) {
    const RollingCondition &c = s.question.condition;
    run.out.write(
        "response/" + base_of(s) + "-limit-cycle.csv",
        csv_text(history_table(s, s.run->history, s.run_force, c.entry_tension, c.exit_tension, s.run_friction)));
  }
}

Json searches(const std::vector<OtherSearch> &all)
{
  Json list = Json::array();
  for (const OtherSearch &o : all) {
    Json one{
        {"name",           o.name                   },
        {"verdict",        word_of(o.found.verdict) },
        {"critical_speed", number(o.found.speed)    },
        {"frequency",      number(o.found.frequency)},
        {"growth_rate",    number(o.growth)         }
    };
    if (o.mode) {
      one["ratio"]               = number(o.mode->work_roll_ratio);
      one["force_phase"]         = number(o.mode->force_phase);
      one["entry_tension_phase"] = number(o.mode->entry_tension_phase);
      one["upper_moves_more"]    = o.mode->work_roll_ratio > 1;
    }
    list.push_back(one);
  }
  return list;
}

Json phases(const dynamics::ChatterMode &mode)
{
  Json shape = Json::array();
  for (const auto &body : mode.body)
    shape.push_back({
        {"label",     body.label            },
        {"amplitude", number(body.amplitude)},
        {"phase",     number(body.phase)    }
    });
  return {
      {"frequency",     number(mode.frequency)          },
      {"ratio",         number(mode.work_roll_ratio)    },
      {"force",         number(mode.force_phase)        },
      {"entry_tension", number(mode.entry_tension_phase)},
      {"exit_tension",  number(mode.exit_tension_phase) },
      {"friction",      number(mode.friction_phase)     },
      {"shape",         shape                           }
  };
}

Json critical(const ChatterStudy &s)
{
  return {
      {"verdict",                 word_of(s.found.verdict)                                      },
      {"speed",                   number(s.found.speed)                                         },
      {"frequency",               number(s.found.frequency)                                     },
      {"growth_at_working_speed", number(s.question.speed_assumed ? not_given : s.growth)       },
      {"margin",                  number(s.found.margin)                                        },
      {"margin_speed",            number(s.found.margin_speed)                                  },
      {"searched",                {s.question.analysis.speeds[0], s.question.analysis.speeds[1]}},
      {"sentence",                verdict_sentence(s)                                           }
  };
}

Json limit_cycle(const ChatterStudy &s)
{
  Json events = Json::array();
  for (const auto &event : s.run->events) {
    std::string what = dynamics::in_words(event.change);
    if (event.contact >= 0 && std::size_t(event.contact) < s.contacts.size())
      what += ": " + s.contacts[std::size_t(event.contact)];
    events.push_back({
        {"time", event.time},
        {"what", what      }
    });
    if (events.size() == 200)
      break;  // the rest repeats what the report shows of them
  }
  std::string limits;
  for (const std::string &limit : s.cycle.settled ? s.cycle.limits : std::vector<std::string>{})
    limits += (limits.empty() ? "" : ", ") + limit;
  return {
      {"file",         "response/" + base_of(s) + "-limit-cycle"},
      {"speed",        number(s.run_speed)                      },
      {"settled",      s.cycle.settled                          },
      {"amplitude_um", number(1e6 * s.cycle.amplitude)          },
      {"frequency",    number(s.cycle.frequency)                },
      {"limited_by",   limits                                   },
      {"stopped",      s.run->stopped                           },
      {"events",       events                                   }
  };
}

Json sensitivities(const ChatterStudy &s)
{
  Json list = Json::array();
  if (!s.sensitivities)
    return list;
  for (const dynamics::Sensitivity &one : s.sensitivities->inputs)
    list.push_back({
        {"key",                    one.key                                    },
        {"name",                   one.name                                   },
        {"unit",                   one.unit                                   },
        {"value",                  number(one.value)                          },
        {"friction_slope",         number(one.friction)                       },
        {"friction_minus",         number(one.lowered.friction)               },
        {"friction_plus",          number(one.raised.friction)                },
        {"speed_slope",            number(one.critical_speed)                 },
        {"speed_minus",            number(one.lowered.critical_speed)         },
        {"speed_plus",             number(one.raised.critical_speed)          },
        {"speed_at_held_friction", number(one.critical_speed_at_held_friction)},
        {"growth",                 number(one.growth)                         },
        {"minus_outcome",          one.lowered.outcome                        },
        {"plus_outcome",           one.raised.outcome                         },
        {"curved",                 !one.monotone                              }
    });
  return list;
}

Json study_json(const ChatterStudy &s)
{
  const RollingCondition &c = s.question.condition;
  Json json{
      {"condition", c.name                                                },
      {"speed",     number(s.question.speed_assumed ? not_given : c.speed)},
      {"scheme",    s.question.analysis.linearisation                     },
      {"reduction", 100 * (1 - c.exit_thickness / c.entry_thickness)      },
      {"viscosity",
       number(has_film(s.question.bite.strip.friction) ? 1e3 * s.question.bite.strip.friction.viscosity
                                                       : not_given)       },
      {"structure", s.question.structure                                  },
      {"critical",  critical(s)                                           },
      {"histories", Json::array()                                         }
  };
  for (const ChatterRecord &record : s.records)
    json["histories"].push_back({
        {"file",            "response/" + base_of(s) + "-" + record.name},
        {"speed",           record.speed                                },
        {"growth_rate",     number(record.growth)                       },
        {"measured_growth", number(record.in_time)                      }
    });
  json["limit_cycle"]   = s.run ? limit_cycle(s) : Json(nullptr);
  json["phases"]        = s.mode ? phases(*s.mode) : Json(nullptr);
  json["sensitivities"] = sensitivities(s);
  json["schemes"]       = searches(s.schemes);
  json["variants"]      = searches(s.variants);
  json["structures"]    = searches(s.structures);
  json["conclusions"]   = Json::array();
  for (const Conclusion &conclusion : conclusions(s))
    json["conclusions"].push_back({
        {"text",   conclusion.text  },
        {"holds",  conclusion.holds },
        {"detail", conclusion.detail}
    });
  json["published"] = Json::array();
  for (const PublishedRow &row : published_rows(s))
    json["published"].push_back({
        {"quantity",  row.quantity             },
        {"unit",      row.unit                 },
        {"here",      number(row.here)         },
        {"published", number(row.published)    },
        {"measured",  number(row.measured)     },
        {"note",      s.question.condition.note}
    });
  return json;
}
}  // namespace

const char *word_of(const Verdict verdict)
{
  switch (verdict) {
  case Verdict::crossing:
    return "crossing";
  case Verdict::stable:
    return "stable";
  case Verdict::unstable:
    return "unstable";
  case Verdict::unstable_below:
    return "unstable below";
  case Verdict::no_bite:
    break;
  }
  return "no bite";
}

void write_chatter(RunContext &run, const ChatterStudy &s)
{
  write_speeds(run, s);
  write_locus(run, s);
  write_maps(run, s);
  write_histories(run, s);
  run.out.write("curves/" + base_of(s) + ".json", study_json(s).dump(1) + "\n");
}
}  // namespace mill
