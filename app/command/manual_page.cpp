#include "app/command/described_verbs.h"
#include <cctype>
#include <fmt/format.h>

namespace mill {
namespace {
// Text of a page of the manual: a backslash, a dash of an option and a point at the start of a line have a meaning
// there.
std::string as_troff(const std::string &text)
{
  std::string troff;
  for (const char c : text)
    troff += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  if (!troff.empty() && (troff[0] == '.' || troff[0] == '\''))
    troff.insert(0, "\\&");
  return troff;
}

std::string heading_of(const DescribedOption &option)
{
  std::string names;
  for (const std::string &name : option.names)
    names += (names.empty() ? "" : ", ") + name;
  return names + (option.named && option.takes ? " VALUE" : "");
}

std::string verb_as_troff(const DescribedVerb &verb)
{
  std::string words;
  for (const DescribedOption &option : verb.options)
    if (!option.named)
      words += " " + (option.needed ? option.names[0] : "[" + option.names[0] + "]");
  std::string page =
      fmt::format(".SS {}{} [options]\n{}\n", verb.name, as_troff(words), as_troff(verb.meaning + "."));
  for (const DescribedOption &option : verb.options)
    page += fmt::format(".TP\n.B {}\n{}\n", as_troff(heading_of(option)), as_troff(option.meaning));
  return page;
}
}  // namespace

std::string manual_page(const std::vector<DescribedVerb> &verbs, const std::string &summary,
                        const std::string &version)
{
  std::string page = fmt::format(".TH MILLSTAND 1 \"\" \"millstand {}\" \"User Commands\"\n"
                                 ".SH NAME\nmillstand \\- vibration of rolling\\-mill stands from their drawings\n"
                                 ".SH SYNOPSIS\n.B millstand\nVERB [options]\n.SH DESCRIPTION\n{}\n"
                                 ".SH VERBS\n",
                                 version, as_troff(summary));
  for (const DescribedVerb &verb : verbs)
    page += verb_as_troff(verb);
  return page + ".SH EXIT STATUS\n"
                ".TP\n.B 0\nthe command did what it was asked to do\n"
                ".TP\n.B 1\nan error of the program itself, or a failed case of the verification manual\n"
                ".TP\n.B 2\nan error of the input; the message names place, value and remedy\n"
                ".TP\n.B 3\na calculation or the machine failed (no convergence, disk, memory)\n"
                ".SH FILES\n"
                ".TP\n.I /usr/share/millstand/cases\ncases that run\n"
                ".TP\n.I /usr/share/doc/millstand/html/index.html\ntutorial, how\\-to pages, reference, theory\n"
                ".TP\n.I ~/.cache/millstand\ncondensed rolls, reused by later runs\n"
                ".SH SEE ALSO\n"
                ".B millstand help\nlists the topics that the program explains.\n";
}
}  // namespace mill
