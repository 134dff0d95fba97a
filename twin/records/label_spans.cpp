#include "twin/records/label_spans.h"
#include "core/base/valid_text.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill::twin {
void LabelCollector::add(const std::string_view text)
{
  if (n_ == 0 || text != last_) {
    last_ = std::string(text);
    ++changes_;
    if (spans_.size() < most_spans)
      spans_.push_back({"", valid_text(text), n_, n_});
  }
  if (std::size_t(changes_) == spans_.size())
    spans_.back().end = n_ + 1;
  ++n_;
}

void LabelCollector::finish(const std::string &column, RawRecord &record)
{
  spans_.erase(std::remove_if(spans_.begin(), spans_.end(), [](const LabelSpan &s) { return s.text.empty(); }),
               spans_.end());
  constexpr std::size_t most_named = 4;
  std::string examples;
  for (std::size_t i = 0; i < std::min(spans_.size(), most_named); ++i)
    examples += fmt::format("{}{} in samples {} to {}", i == 0 ? "" : ", ", spans_[i].text, spans_[i].begin + 1,
                            spans_[i].end);
  if (spans_.size() > most_named)
    examples += fmt::format(" and {} more", spans_.size() - most_named);
  record.notes.push_back(fmt::format("column '{}' holds texts and was kept as labels: {}", column, examples));
  if (changes_ > Eigen::Index(most_spans))
    record.notes.push_back(
        fmt::format("column '{}' changes {} times; the first {} labels were kept", column, changes_, most_spans));
  for (LabelSpan &span : spans_) {
    span.column = column;
    record.labels.push_back(std::move(span));
  }
}
}  // namespace mill::twin
