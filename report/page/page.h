#pragma once
#include "report/page/run.h"
#include <string>
#include <utility>
#include <vector>

namespace mill::report {
/// For whom a section is open when the page is set to a depth; every deeper depth opens it as well.
enum class Depth { manager, engineer, expert };
const char *name_of(Depth depth);  ///< "engineer", in the page and in page.js

/// The page while it is written: numbers its figures and tables, collects its sections for the contents.
class Page {
public:
  explicit Page(const Run &run);

  /// Begins a section, which ends where the next one begins.  It folds: open in the page as it is stored when
  /// its depth is that of the engineer or above.
  void section(const std::string &id, const std::string &title, Depth depth = Depth::engineer);
  void heading(const std::string &title);  ///< inside a section

  /// Anything that is HTML already.
  void html(const std::string &text);
  void paragraph(const std::string &html);

  /// One figure of one or more drawings side by side.  The caption (HTML) says what to see in its first sentence,
  /// others fold behind it; case name and run id are added, so that a copied figure still shows where it came
  /// from.  Drawings that are empty are left out, and a figure without any.
  void figure(const std::vector<std::string> &drawings, const std::string &caption);

  /// A table with its caption (HTML) above; nothing where it is empty.
  void table(const std::string &table, const std::string &caption);

  /// Says in a sentence that a stored file is not there, instead of its figure.
  void absent(const std::string &what, const std::string &file);

  std::string contents() const;  ///< list of links to the sections
  std::string body() const;

private:
  std::string stamp_;
  std::string body_;
  struct Heading {
    std::string id, title;
    Depth depth;
  };
  std::vector<Heading> sections_;
  int figures_ = 0;
  int tables_  = 0;
};
}  // namespace mill::report
