#include "force_series.h"
#include "json_reader.h"
#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace mill::fmu {
std::size_t ForceSeries::before(const double t, const std::size_t hint) const
{
  const std::size_t n = time.size();
  if (hint <= n && (hint == 0 || time[hint - 1] <= t)) {  // most often here or one further
    if (hint == n || time[hint] > t)
      return hint;
    if (hint + 1 == n || time[hint + 1] > t)
      return hint + 1;
  }
  return std::size_t(std::upper_bound(time.begin(), time.end(), t) - time.begin());
}

double ForceSeries::at(const double t, const std::size_t n) const
{
  if (n == 0)
    return force.front();
  if (n == time.size())
    return force.back();
  return force[n - 1] + (force[n] - force[n - 1]) * ((t - time[n - 1]) / (time[n] - time[n - 1]));
}

ForceSeries read_series(const std::string &csv)
{
  ForceSeries series;
  const char *next = csv.data(), *end = csv.data() + csv.size();
  for (std::size_t line = 1; next < end; ++line) {
    const char *stop = static_cast<const char *>(std::memchr(next, '\n', std::size_t(end - next)));
    if (!stop)
      stop = end;
    const char *comma = static_cast<const char *>(std::memchr(next, ',', std::size_t(stop - next)));
    if (line > 1) {
      double t = 0, force = 0;
      if (!comma || !read_number(next, comma, t) || !read_number(comma + 1, stop, force) ||
          !(series.time.empty() || t > series.time.back()))
        throw std::runtime_error("line " + std::to_string(line) +
                                 " is not a sample, or its time does not increase");
      series.time.push_back(t);
      series.force.push_back(force);
    }
    next = stop + 1;
  }
  if (series.time.empty())
    throw std::runtime_error("there are no samples");
  return series;
}
}  // namespace mill::fmu
