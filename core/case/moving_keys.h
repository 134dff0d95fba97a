#pragma once
#include "core/case/case_rows.h"
#include "core/case/kinds.h"
#include "core/records/key_list.h"
#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace mill {
/// Rows of one pass.  @param rows  pass_rows() or bite_pass_rows()
void add_pass_rows(CaseRows &all, std::size_t p, const std::vector<Field<PassInput>> &rows, Pass &pass);

/// A copy of a case whose rows are changed one by one to see which of them move the inputs of a stage.  Lists that
/// were made are remembered; any number of threads may ask.  Of the kinds cluster and stack, whose stages list
/// their keys themselves, it knows no rows.
class MovingKeys {
public:
  explicit MovingKeys(CaseSpec of_case);
  MovingKeys(const MovingKeys &)            = delete;
  MovingKeys &operator=(const MovingKeys &) = delete;

  /// Inputs of a stage as text (record_text), of any case of this kind.
  using Text = std::function<std::string(const CaseSpec &)>;

  /// Keys whose change moves the text, in the order of the case.
  /// @param what  the name under which the list is remembered
  /// Cost: some 300 texts when it is made, one thread at a time.  The text asks for no other list.
  const KeyList &of(const std::string &what, const Text &text);

  /// The case itself.
  const CaseSpec &spec() const
  {
    return kept;
  }
  /// All keys that it can change.
  KeyList all() const
  {
    return rows.keys();
  }

private:
  const CaseSpec kept;
  CaseSpec changed;  // what the rows refer to; as the other one between two calls
  CaseRows rows;
  std::mutex making;
  std::map<std::string, KeyList> known;
};
}  // namespace mill
