#include "app/live/live_stand.h"
#include "app/analysed_stand.h"
#include "app/run_setup.h"
#include "core/model/case.h"
#include "core/records/files.h"
#include "dynamics/response/modes.h"
#include <fmt/format.h>

namespace mill {
namespace {
const char *label_of(const std::string &key)
{
  static const std::map<std::string, const char *> labels{
      {"K1",      "upper frame"       },
      {"K2",      "upper backup roll" },
      {"K3",      "upper roll contact"},
      {"K4",      "roll bite"         },
      {"K5",      "lower roll contact"},
      {"K6",      "lower backup roll" },
      {"K7",      "lower frame"       },
      {"damping", "modal damping"     }
  };
  return labels.at(key);
}

void add_roll_sizes(live::PageStand &stand, const std::string &roll, const double diameter, const double length)
{
  for (live::StandPlace &place : stand.places)
    if (place.place.size() > roll.size() && place.place.find(roll) != std::string::npos) {
      place.diameter = diameter;
      place.length   = length;
    }
}
}  // namespace

live::TwinModel live_model(const Case &the_case)
{
  AnalysedChain chain = analysed_chain(the_case, "live");
  return {the_case.name, std::move(chain.source), std::move(chain.model), std::move(chain.dynamics),
          hash_of(the_case.resolved)};
}

live::PageStand page_stand(const Case &the_case, const live::TwinModel &model)
{
  const auto chain = live::tuned(model, {});
  const auto modes = dynamics::modes(chain);
  live::PageStand stand;
  stand.name        = model.name;
  stand.source      = model.source;
  stand.version     = version();
  const auto places = live::places_of(chain);
  for (std::size_t i = 0; i < places.size(); ++i) {
    live::StandPlace place;
    place.place = places[i];
    place.label = chain.labels[i];
    place.mass  = chain.M[Eigen::Index(i)];
    stand.places.push_back(place);
  }
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec)) {
    add_roll_sizes(stand, "work_roll", four->work_roll.barrel_diameter, four->work_roll.barrel_length);
    add_roll_sizes(stand, "backup_roll", four->backup_roll.barrel_diameter, four->backup_roll.barrel_length);
  }
  for (const dynamics::Spring &spring : chain.springs) {
    stand.springs.push_back({spring.name, spring.stiffness, spring.from, spring.to});
    if (spring.stiffness > 0)
      stand.sliders.push_back({spring.name, label_of(spring.name), "N/m", spring.stiffness});
  }
  stand.sliders.push_back({"damping", label_of("damping"), "-", model.dynamics.modal_damping});
  for (const double frequency : modes.frequency)
    stand.modes.push_back({frequency, model.dynamics.modal_damping, ""});
  return stand;
}

live::PageParameters page_parameters(const live::TwinModel &model, const live::Tuning &tuning,
                                     const std::string &origin, const std::string &place)
{
  live::PageParameters now;
  now.origin = origin;
  now.place  = place;
  for (const std::string &key : live::slider_keys())
    now.sliders.push_back({key, live::factor_of(tuning, key)});
  const auto modes = dynamics::modes(live::tuned(model, tuning));
  now.frequencies.assign(modes.frequency.begin(), modes.frequency.end());
  return now;
}
}  // namespace mill
