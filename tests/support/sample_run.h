#pragma once
#include <string>

/// What a sample run directory holds.
struct SampleRun {
  std::string kind  = "four-high";  ///< four-high | lumped | two-cylinders | bearing
  std::string title = "1400 four-high, demo stand";
  int samples       = 4001;  ///< of each response, 20 kHz
  bool warnings     = true;
};

/// Writes results.json, run.json, curves/ and response/ as a run leaves them, with numbers made here from closed
/// forms: Hertz and its relatives for the contacts, a power law for the bearings, the eigenvalue problem of the
/// six-mass chain, its response to band-limited noise.  Nothing of it is read from or compared with the product.
/// @return path of a new directory below the system's temporary folder, removed when the process ends
std::string write_sample_run(const SampleRun &sample = {});

/// Sample k of the spike that every response has: one sample of +9.5 g of the upper work roll.
int sample_spike(const SampleRun &sample);
