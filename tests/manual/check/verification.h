#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

// The verification manual: problems with a known answer, run by name.
namespace mill::verify {
/// How a result is judged against its reference.
enum class Judged {
  relative,  ///< |result - reference| <= tolerance |reference|
  absolute,  ///< |result - reference| <= tolerance
  at_least,  ///< result >= reference
  at_most,   ///< result <= reference
  reported   ///< printed next to the reference, not judged
};

/// A check that was asked for, does not hold, and stays in the manual with its asked reference.
struct KnownDeviation {
  double result;       ///< when the deviation was recorded
  double spread;       ///< how far a later result may be from it, in the unit of the check
  std::string cause;   ///< why the asked reference is not reached
  std::string remedy;  ///< what would reach it
};

struct Check {
  std::string quantity;  ///< "peak pressure"
  std::string unit;      ///< as printed: "MPa", "um", "-"
  double result, reference, tolerance;
  Judged judged                       = Judged::relative;
  std::optional<KnownDeviation> known = std::nullopt;
};

enum class Verdict {
  pass,             ///< within its bound
  fail,             ///< outside it; not a number; or a known deviation that moved or is gone
  known_deviation,  ///< outside its bound by what was recorded
  reported          ///< not judged
};
Verdict verdict(const Check &check);

/// Verdict is not fail.
bool passes(const Check &check);

/// How many checks of each verdict.
struct Tally {
  std::size_t passed   = 0;
  std::size_t failed   = 0;
  std::size_t known    = 0;  ///< known deviations
  std::size_t reported = 0;  ///< not judged

  std::size_t judged() const
  {
    return passed + failed;
  }
};
Tally tally(const std::vector<Check> &checks);

/// How far two results of one check may be apart, in its unit, before a written one is out of date: the tolerance;
/// the spread of a known deviation; 1 % of a reported value; of a bound 10 % of it or 1 % of the result (a
/// residual far below its bound is round-off, which differs from machine to machine).
double allowed_change(const Check &check);

Check relative(const std::string &quantity, const std::string &unit, double result, double reference,
               double tolerance);
/// Within `tolerance` of the reference, in the unit of the quantity.
Check absolute(const std::string &quantity, const std::string &unit, double result, double reference,
               double tolerance);
/// Between two bounds, without unit.
Check within(const std::string &quantity, double result, double low, double high);
Check at_most(const std::string &quantity, const std::string &unit, double result, double limit);
Check reported(const std::string &quantity, const std::string &unit, double result, double reference);

/// The check as asked, with the deviation that is known of it.
Check known_deviation(Check asked, const KnownDeviation &known);

/// One page of the manual.
struct Case {
  std::string name;              ///< "cgs1-small"
  std::string kind;              ///< "unit", "verification", "benchmark", "regression": see kinds()
  std::string problem;           ///< what is solved, with which method and how many unknowns; one or two sentences
  std::string source;            ///< of the reference
  std::string tolerance_reason;  ///< why this tolerance and no other
  std::function<std::vector<Check>()> run;
  std::string family                    = "";       ///< "contact": a name for all its cases; set by cases_of
  std::function<std::string()> ran_with = nullptr;  ///< of a peer: program, version, date of the run, for the page
  bool long_form                        = false;    ///< names_of_long_form(); set by cases_of
};

/// Thrown by Case::run when what the case needs is not on this machine; says what and how to get it.
struct Skipped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A kind of case and what its reference is.
struct Kind {
  std::string name, meaning;
};
const std::vector<Kind> &kinds();
}  // namespace mill::verify
