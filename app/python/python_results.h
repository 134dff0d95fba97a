#pragma once
#include "core/base/parameter.h"
#include "core/records/csv.h"
#include "core/records/results.h"
#include <map>
#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace mill::python {
/// A number of a run with its name and its proof.
struct NamedResult {
  std::string name;
  Parameter parameter;
};

/// A table as numpy sees it: row by row, so that a view of it is a structured array.
struct HeldTable {
  std::vector<std::string> names, units;  ///< of the columns
  std::vector<double> rows;               ///< (n columns) row after row, SI
};
using HeldTables = std::map<std::string, std::shared_ptr<const HeldTable>>;

std::shared_ptr<const HeldTable> held(const Table &table);

/// A structured view that owns a share of the table: no copy.  The units are in its dtype.metadata["units"].
pybind11::object view_of(const std::shared_ptr<const HeldTable> &table);

/// As pickles hold them.
pybind11::tuple state_of(const NamedResult &result);
NamedResult result_of(const pybind11::tuple &state);
pybind11::tuple state_of(const HeldTable &table);
std::shared_ptr<const HeldTable> table_of(const pybind11::tuple &state);

/// A KeyError with the nearest of the known names.
[[noreturn]] void refuse_name(const std::string &what, const std::string &name,
                              const std::vector<std::string> &known);

/// The classes Result and Check.
void add_results(pybind11::module_ &module);
}  // namespace mill::python
