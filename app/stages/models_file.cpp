#include "app/stages/models_file.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
using Json = nlohmann::ordered_json;

Json number(const double x)
{
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

Json list(const Eigen::VectorXd &v)
{
  Json out = Json::array();
  for (const double x : v)
    out.push_back(number(x));
  return out;
}

Json names(const std::vector<std::string> &words)
{
  Json out = Json::array();
  for (const std::string &word : words)
    out.push_back(word);
  return out;
}

Json mode_json(const reduce::StandWithModes &s, const Eigen::Index i, const Eigen::VectorXd &in_chain)
{
  const Eigen::VectorXd shape = s.modes.shape.col(i);
  Eigen::VectorXd points(Eigen::Index(s.model.points.size()));
  for (std::size_t p = 0; p < s.model.points.size(); ++p)
    points[Eigen::Index(p)] = s.model.points[p].row.dot(shape);
  double largest = points.cwiseAbs().maxCoeff();
  std::vector<Eigen::VectorXd> lines;
  for (const StandLine &line : s.model.lines) {
    lines.push_back(line.rows * shape);
    largest = std::max(largest, lines.back().cwiseAbs().maxCoeff());
  }
  Json mode{
      {"frequency",      number(s.modes.frequency[i])                                                         },
      {"error_estimate", s.modes.error_estimate.size() > i ? number(s.modes.error_estimate[i]) : Json(nullptr)},
      {"in_chain",       in_chain.size() > i ? number(in_chain[i]) : Json(nullptr)                            },
      {"points",         list(points / largest)                                                               },
      {"kinetic",        list(s.modes.kinetic.col(i))                                                         },
      {"strain",         list(s.modes.strain.col(i))                                                          },
      {"lines",          Json::array()                                                                        }
  };
  for (const Eigen::VectorXd &line : lines)
    mode["lines"].push_back(list(line / largest));
  return mode;
}

// Modes below the limit and one beyond it.
Eigen::Index shown_modes(const reduce::StandWithModes &s, const double limit)
{
  const auto below =
      std::upper_bound(s.modes.frequency.begin(), s.modes.frequency.end(), limit) - s.modes.frequency.begin();
  return std::min<Eigen::Index>(below + 1, s.modes.frequency.size());
}

Json model_json(const reduce::StandWithModes &s, const std::string &title, const std::string &source,
                const double limit, const Eigen::VectorXd &in_chain)
{
  Json model{
      {"name",     s.model.name        },
      {"title",    title               },
      {"unknowns", s.model.M.rows()    },
      {"source",   source              },
      {"points",   Json::array()       },
      {"parts",    names(s.model.parts)},
      {"springs",  Json::array()       },
      {"lines",    Json::array()       },
      {"modes",    Json::array()       }
  };
  for (const StandPoint &point : s.model.points)
    model["points"].push_back(point.name);
  for (const Connection &spring : s.model.connections)
    model["springs"].push_back(spring.name);
  for (const StandLine &line : s.model.lines)
    model["lines"].push_back({
        {"name", line.name   },
        {"z",    list(line.z)}
    });
  for (Eigen::Index i = 0; i < shown_modes(s, limit); ++i)
    model["modes"].push_back(mode_json(s, i, in_chain));
  return model;
}

Json partner(const reduce::StandWithModes &other, const reduce::ModePair &pair)
{
  if (pair.other < 0)
    return nullptr;
  return {
      {"mode",      pair.other + 1                           },
      {"frequency", number(other.modes.frequency[pair.other])},
      {"mac",       number(pair.mac)                         }
  };
}

Json pairs_json(const StandModels &m)
{
  const auto with = [&](const reduce::StandWithModes &detailed) {
    return reduce::pair_modes(reduce::mac_with_chain(detailed, m.chain), detailed.modes.frequency,
                              m.chain.modes.frequency);
  };
  const auto beam = with(m.beam), components = with(m.craig_bampton);
  Json pairs = Json::array();
  for (std::size_t i = 0; i < beam.size(); ++i)
    pairs.push_back({
        {"mode",                                         beam[i].mode + 1},
        {               "six_mass", number(m.chain.modes.frequency[beam[i].mode])                },
        {          "beam",                                      partner(m.beam,                                                      beam[i])},
        { "craig-bampton",                                partner(m.craig_bampton,                                                components[i])}
    });
  return pairs;
}

Json mac_json(const StandModels &m, const double limit)
{
  const Eigen::MatrixXd mac  = reduce::mac_between(m.craig_bampton, m.beam);
  const Eigen::Index rows    = std::min(shown_modes(m.craig_bampton, limit), mac.rows());
  const Eigen::Index columns = std::min(shown_modes(m.beam, limit), mac.cols());
  Json values                = Json::array();
  for (Eigen::Index i = 0; i < rows; ++i)
    values.push_back(list(mac.row(i).head(columns).transpose()));
  return {
      {"rows",             "craig-bampton"                                 },
      {"columns",          "beam"                                          },
      {"row_frequency",    list(m.craig_bampton.modes.frequency.head(rows))},
      {"column_frequency", list(m.beam.modes.frequency.head(columns))      },
      {"values",           values                                          }
  };
}

Json needed_json(const std::vector<reduce::MassesRow> &rows)
{
  Json out = Json::array();
  for (const auto &row : rows) {
    Json missing = Json::array();
    for (const double f : row.missing)
      missing.push_back(number(f));
    out.push_back({
        {"masses",            row.masses             },
        {"added",             row.added              },
        {"worst_error",       number(row.worst_error)},
        {"right",             row.right              },
        {"modes_below_limit", row.modes_below_limit  },
        {"missing",           missing                }
    });
  }
  return out;
}

Json kept_json(const KeptModes &kept)
{
  Json error = Json::array();
  for (Eigen::Index step = 0; step < kept.error.cols(); ++step)
    error.push_back(list(kept.error.col(step)));
  return {
      {"kept",      kept.kept           },
      {"frequency", list(kept.frequency)},
      {"error",     error               }
  };
}

Json breakdown_json(const std::vector<reduce::MassBreakdown> &all)
{
  Json out = Json::array();
  for (const auto &mass : all) {
    Json parts = Json::array();
    for (const auto &part : mass.parts)
      parts.push_back({
          {"name",       part.name              },
          {"mass",       number(part.mass)      },
          {"equivalent", number(part.equivalent)}
      });
    out.push_back({
        {"mass",  mass.mass },
        {"route", mass.route},
        {"parts", parts     }
    });
  }
  return out;
}

Json routes_json(const ModelsFile &file)
{
  Json out          = Json::array();
  const auto closed = reduce::chain_breakdown(file.stand, file.chain);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string name = "M" + std::to_string(i + 1);
    const bool roll        = i > 0 && i < 5;
    const auto published   = file.stand.published.find(name);
    const auto found =
        std::find_if(closed.begin(), closed.end(), [&](const auto &mass) { return mass.mass == name; });
    out.push_back({
        {"mass",        name                                                                                },
        {"chain",       found == closed.end() ? Json(nullptr) : number(found->value)                        },
        {"fe_integral", roll ? number(file.masses.integral[i - 1]) : Json(nullptr)                          },
        {"fe_solid",    roll ? number(file.masses.solid[i - 1]) : Json(nullptr)                             },
        {"published",
         published == file.stand.published.end() ? Json(nullptr) : number(published->second.parameter.value)}
    });
  }
  return out;
}
}  // namespace

std::string models_json(const ModelsFile &file)
{
  const StandModels &m = file.models;
  const double limit   = file.stand.dynamics.frequency_limit;
  Json json{
      {"frequency_limit", limit                    },
      {"at",              file.chain.model.at      },
      {"driven",          file.stand.dynamics.model},
      {"answer",          names(file.answer)       },
      {"models",          Json::array()            }
  };
  json["models"].push_back(model_json(m.chain, "six masses", "chain of six masses and seven springs", limit, {}));
  json["models"].push_back(model_json(m.beam, "beams", file.source_beam, limit, reduce::in_chain(m.beam)));
  json["models"].push_back(model_json(m.craig_bampton, "finite elements", file.source_components, limit,
                                      reduce::in_chain(m.craig_bampton)));
  json["pairs"]         = pairs_json(m);
  json["mac"]           = mac_json(m, limit);
  json["masses_needed"] = needed_json(file.masses_needed);
  json["kept_modes"]    = kept_json(file.kept);
  json["breakdown"]     = breakdown_json(file.breakdown);
  json["routes"]        = routes_json(file);
  return json.dump(1) + "\n";
}
}  // namespace mill
