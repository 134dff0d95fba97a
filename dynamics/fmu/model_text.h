#pragma once
#include "dynamics/fmu/exported_model.h"
#include <string>

namespace mill::fmu {
/// resources/model.json.
std::string model_json(const ModelData &model);

/// resources/force.csv: s and N with 17 digits.
std::string series_csv(const ForceRecord &force);

/// A number as XML and JSON take it: 17 significant digits at most, as few as give it back, a decimal point.
std::string exact_number(double value);

/// "{8-4-4-4-12}" hexadecimal digits from all that decides what the unit computes and how it is called: model,
/// variables, force, version of the runtime.  128 bits of FNV-1a; the same model has the same identity.
std::string identity_of(const ExportedModel &model);
}  // namespace mill::fmu
