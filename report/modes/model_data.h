#pragma once
#include "core/records/models_record.h"
#include <string>

namespace mill::report {
/// curves/models.json as this run stored it.  A number that was not stored is NaN, a list that was not is empty.
struct ModelData : ModelsRecord {
  bool stored = false;
  std::string problem;  ///< why a file that is there cannot be used; empty: nothing wrong

  const ComparedModel *find(const std::string &name) const;  ///< nullptr when absent
  std::string title(const std::string &name) const;          ///< of a model, else the name itself
  /// The model that the six masses are judged by: the last one that has other modes than theirs; nullptr: none.
  const ComparedModel *detailed() const;
};

/// Reads curves/models.json of a run directory.  Never throws: without the file `stored` is false, `problem` says
/// when it is not such a JSON.  Lists of a mode whose length does not fit its model are filled up with NaN.
ModelData read_models(const std::string &run_directory);
}  // namespace mill::report
