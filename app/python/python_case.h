#pragma once
#include "app/command/command_line.h"
#include "app/command/verb.h"
#include "app/python/python_results.h"
#include "app/run/scratch_folder.h"
#include "app/verbs/checked_case.h"
#include "core/model/case.h"
#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

namespace mill::python {
/// A case file with the values that were set on top of it; each goes through the rows of the case like --set.
class HeldCase {
public:
  /// A file of the user.  Read at once, so that a missing file is an error here; errors of its values are those of
  /// check().
  explicit HeldCase(const std::string &path);
  /// A text that has no file of the user's: `name` is that of the case.
  HeldCase(const std::string &name, const std::string &text);

  const std::string &path() const;        ///< absolute
  std::vector<std::string> sets() const;  ///< "backup_roll.crown=150 um"
  std::string text() const;               ///< of the file, without what was set
  /// @throws InputError  the key or the value is wrong; other errors of the case are left for check()
  void set(const std::string &key, const std::string &value);
  /// Reads the case where it was not read since the last change.  @throws InputError
  std::shared_ptr<const Case> read() const;
  /// As `millstand check` does, with its records.  @throws InputError
  std::shared_ptr<const CheckedCase> checked(Verb verb, const std::string &force = "") const;
  /// A command about this case.
  CommandLine command(Verb verb) const;

private:
  std::string file;
  std::shared_ptr<const ScratchFolder> scratch;
  std::vector<std::pair<std::string, std::string>> values;  ///< key and value, in the order of setting
  mutable std::shared_ptr<const Case> known;
};

/// The class Case, new() and load().
pybind11::class_<HeldCase> add_case(pybind11::module_ &module);
}  // namespace mill::python
