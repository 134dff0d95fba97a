#pragma once
#include "core/records/chatter_record.h"
#include "core/records/csv.h"
#include "report/page/run.h"
#include <optional>
#include <string>
#include <vector>

// What a run stored about chatter: curves/chatter-*.json and the names of the tables next to them.
namespace mill::report {
struct ChatterData {
  std::vector<ChatterCondition> conditions;
  std::optional<ChatterTandem> tandem;
  std::vector<std::string> problems;  ///< files that are there and cannot be used, one sentence each

  bool empty() const;  ///< nothing about chatter is stored
};

/// Reads curves/chatter-*.json and looks which tables lie next to them; a condition without its JSON is one that
/// has tables only.  Conditions come in the order of the results chatter.<condition>.*, the others after them by
/// name. Never throws.
ChatterData read_chatter(const Run &run);

}  // namespace mill::report
