#pragma once
#include "tests/support/web_driver.h"
#include <cstdlib>
#include <string>

// What can be read off the picture of the page of the live twin.

/// Row of pixels at which the line through a mass stands: the brightest of a column that crosses nothing else
/// bright.  For the dark page.
/// @param beside  m from the middle of the stand;  @param from, to  m above the pass line
inline double line_of_mass(Browser &browser, const double beside, const double from, const double to)
{
  const std::string script =
      "const c = document.getElementById('stand'), d = c.dataset, s = +d.scale;"
      "const x = Math.round(+d.middle + " +
      std::to_string(beside) + " * s), top = Math.round(+d.line - " + std::to_string(to) +
      " * s), n = Math.round(" + std::to_string(to - from) +
      " * s);"
      "const p = c.getContext('2d').getImageData(x, top, 1, n).data; let sum = 0, moment = 0;"
      "for (let i = 0; i < n; ++i) { const bright = Math.max(0, Math.min(p[4 * i], p[4 * i + 1], p[4 * i + 2]) - "
      "165);"
      " sum += bright; moment += bright * (top + i + 0.5); } return sum ? moment / sum : -1;";
  return browser.run(script).get<double>();
}

/// A number that a canvas says of itself once it is drawn: "amplification", "scale", "peakSimulated".
inline double number_of_canvas(Browser &browser, const std::string &canvas, const std::string &name)
{
  const std::string value = "return document.getElementById('" + canvas + "').dataset." + name;
  return browser.wait_for(value) ? std::atof(browser.run(value).get<std::string>().c_str()) : -1;
}

/// True in the page when the highest resonance of the twin is within one line of the spectrum of a frequency, Hz.
inline std::string peak_of_twin_is_at(const double frequency)
{
  return "const d = document.getElementById('spectrum').dataset; return +d.df > 0 && Math.abs(d.peakSimulated - " +
         std::to_string(frequency) + ") < +d.df";
}
