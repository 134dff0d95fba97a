#include "report/results/names.h"
#include "core/records/open_rows.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_stand.h"

// The results of a run of kind "bite" in the order in which one asks for them.
namespace mill::report {
namespace {
bool is_of_spring(const ResultId &id)
{
  return id.is_of(row::bite_spring::all) || id.is_of(row::open::bite_spring) ||
         (id.is_of(row::chain::K4) && id.place("pass").empty());
}

bool is_of_fit(const ResultId &id)
{
  return id.is_of(row::bite_fit::all) || id.is_of(row::open::bite_fit);
}

bool is_of_a_model(const ResultId &id)
{
  return id.is_of(row::bite_model::all) || id.is_of(row::bite_slope::all) || id.is_of(row::open::bite_model);
}
}  // namespace

bool is_of_one_model(const std::string &name)
{
  const auto id = result_id_or_open(name);
  return id && is_of_a_model(*id);
}

std::vector<Group> bite_groups(const Run &run)
{
  std::vector<Group> groups{{"Stiffness between the work rolls", {}}};
  for (const Result &result : run.results) {
    const auto id = result_id_or_open(result.name);
    if (!id)
      continue;
    if (is_of_spring(*id))
      groups.front().results.push_back(&result);
    const bool fit = is_of_fit(*id);
    if (!fit && !id->is_of(row::bite::all) && !id->is_of(row::open::bite) &&
        !id->is_of(row::open::below_bite_model))
      continue;
    const std::string title = fit ? "Fit to measured values" : "Bite of " + id->place("pass");
    if (groups.back().title != title)
      groups.push_back({title, {}});
    groups.back().results.push_back(&result);
  }
  return groups;
}
}  // namespace mill::report
