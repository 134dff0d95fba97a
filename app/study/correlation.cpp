#include "app/study/correlation.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include <cmath>

namespace mill {
std::vector<KeyCorrelation> correlations_of(const Study &study)
{
  std::vector<KeyCorrelation> all;
  for (const std::string &written : study.correlations) {
    const auto comma = written.find(','), equals = written.rfind('=');
    double value = 0;
    if (comma == std::string::npos || equals == std::string::npos || equals < comma ||
        !parse_number(written.substr(equals + 1), value) || !(std::abs(value) < 1))
      throw InputError("--correlate " + written +
                       " is not of the form KEY1,KEY2=0.5 with a number between -1 and 1");
    const auto place = [&](const std::string &name) {
      for (std::size_t k = 0; k < study.keys.size(); ++k)
        if (study.keys[k].key.name == name)
          return k;
      throw InputError("--correlate " + written + ": " + name + " is not one of the varied keys");
    };
    const std::size_t a = place(written.substr(0, comma)),
                      b = place(written.substr(comma + 1, equals - comma - 1));
    if (a == b)
      throw InputError("--correlate " + written + " names one key twice");
    all.push_back({a, b, value});
  }
  return all;
}
}  // namespace mill
