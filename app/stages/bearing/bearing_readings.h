#pragma once
#include "app/run/run_context.h"
#include "core/records/csv.h"
#include <Eigen/Core>
#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace mill {
/// Tables and numbers that are read off a solved bearing, by name: the law of one roller, its tilt and pressure, a
/// turn of the cage, the stiffness across the load.  They need solutions of their own, so those of an earlier run
/// are taken.
class BearingReadings {
public:
  /// @param inputs  everything that the solved bearing depends on, as text; further inputs of a reading
  /// stands
  ///                in its name
  BearingReadings(RunContext &run, const std::string &inputs);

  Table table(const std::string &name, const std::function<Table()> &make);
  Eigen::VectorXd numbers(const std::string &name, const std::function<Eigen::VectorXd()> &make);

  /// Keeps them for the next run, where new ones were made.
  void keep(RunContext &run);

private:
  std::mutex access;
  std::string key, file;
  std::map<std::string, Table> known;
  bool grown = false;
};
}  // namespace mill
