#pragma once
#include <cmath>
#include <map>
#include <string>

namespace mill::reduce {
/// Error of one number from those of its inputs, (4.17): given and computed inputs by their magnitudes; estimated
/// ones of one source move together, with their signs, and different sources by the root of their squares,
/// (34.12).
class ErrorSum {
public:
  /// @param source  of an estimated input; empty: not estimated
  void add(const double slope, const double error, const std::string &source)
  {
    if (source.empty())
      magnitudes += std::abs(slope) * error;
    else
      by_source[source] += slope * error;
  }
  double error() const
  {
    double squares = 0;
    for (const auto &entry : by_source)
      squares += entry.second * entry.second;
    return magnitudes + std::sqrt(squares);
  }

private:
  double magnitudes = 0;
  std::map<std::string, double> by_source;
};
}  // namespace mill::reduce
