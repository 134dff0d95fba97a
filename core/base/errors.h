#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace mill {
/// Where something stands in a text file.  Lines and columns count from 1; line 0 means "no place in a file"
/// (an override given with --set has file = "--set section.key=value").
struct Place {
  std::string file;
  int line   = 0;
  int column = 0;
};
bool operator<(const Place &a, const Place &b);

/// One mistake of the user, ready to be shown.
struct Problem {
  Place place;
  std::string message;         ///< one sentence: key, value with unit, what is allowed, what to change
  std::vector<Place> related;  ///< the other places of a contradiction
};

/// A mistake of the user: exit code 2.  Holds every problem of a case, sorted by place.
class InputError : public std::runtime_error {
public:
  explicit InputError(std::vector<Problem> problems);
  InputError(Place place, std::string message);
  explicit InputError(std::string message);  ///< no place in a file: a command-line mistake
  std::vector<Problem> problems;
};

/// What a function asks of its caller's numbers.
/// @throws InputError  with `what`
void require_input(bool holds, const char *what);
/// Disk, permission or a limit of the system refuses what was rightly asked for: exit code 3.  Shown as an
/// InputError, and caught as one where the work goes on without the file (an entry of the cache).
class SystemError : public InputError {
public:
  using InputError::InputError;
};

/// Does an error number (errno) of a file operation mean a refusal of the system, and not a wrong name?
bool is_refused_by_system(int error);
/// @throws SystemError or InputError, by the error number of the file operation that failed
[[noreturn]] void refuse_file(int error, const Place &place, const std::string &message);
[[noreturn]] void refuse_file(int error, const std::string &message);

/// A numerical failure: exit code 3.  What converged before is kept and named.
class SolverError : public std::runtime_error {
public:
  struct Report {
    std::string what;    ///< "contact upper: no convergence at load step 7 of 12 (F = 569.5 kN)"
    std::string where;   ///< how it stood when it stopped
    std::string cause;   ///< usual cause, with the numbers
    std::string remedy;  ///< what to change, with key and place
    std::string kept;    ///< files or results that are good
  };
  explicit SolverError(Report report);
  Report report;
};

/// A problem as text: "file:line:column: error: message", the line with its neighbour above, and a caret.
/// The lines are read from the file again; without a readable file only the first line is given.
std::string render(const Problem &problem, const std::string &severity = "error");
}  // namespace mill
