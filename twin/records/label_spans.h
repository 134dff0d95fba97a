#pragma once
#include "twin/records/raw_record.h"
#include <string>
#include <string_view>
#include <vector>

namespace mill::twin {
/// Collects the spans of samples in which a column of texts says the same.
class LabelCollector {
public:
  void add(std::string_view text);  ///< of the next sample; empty: no label there
  /// Puts the spans into the record and a sentence about them into its notes.
  void finish(const std::string &column, RawRecord &record);

private:
  static constexpr std::size_t most_spans = 500;  // a text that changes with each sample is not a label
  std::vector<LabelSpan> spans_;
  Eigen::Index n_ = 0, changes_ = 0;
  std::string last_;
};
}  // namespace mill::twin
