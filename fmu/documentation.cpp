#include "fmu/description.h"
#include "fmu/embedded.h"
#include <fmt/format.h>

namespace mill::fmu {
namespace {
std::string range_of(const Variable &v)
{
  return v.bounded() ? fmt::format("{:g} .. {:g}", v.low, v.high) : "";
}

std::string table_of(const std::vector<DescribedVariable> &variables)
{
  std::string rows;
  for (const DescribedVariable &described : variables) {
    const Variable &v = described.variable;
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{} {}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        escaped(v.name), described.reference, name_of(v.variability), name_of(v.causality),
                        escaped(v.unit), range_of(v), escaped(described.text));
  }
  return rows;
}
}  // namespace

std::string documentation_page(const ExportedModel &model, const int fmi_version)
{
  const bool chain    = model.data.kind == "chain";
  const auto &last    = model.data.frequency;
  const double f      = chain || last.empty() ? 0 : last.back();
  std::string windows = named_file("win64").empty()
                            ? "It was exported without a library for Windows: build the files of sources/ there "
                              "(C++17, no other library; sources/buildDescription.xml)."
                            : "The library for Windows was compiled with mingw-w64.";
  return fmt::format(
      R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{0}</title>
<style>body {{ font-family: sans-serif; max-width: 70em; margin: 2em }} td, th {{ border-bottom: 1px solid #ccc; padding: 0.2em 0.6em; text-align: left }}</style>
</head><body>
<h1>{0}</h1>
<p>{1}; {2}. Co-simulation by FMI {3}.0, written by {4}.</p>
<h2>Equations</h2>
<p>{5}</p>
<p>Displacements are up positive and count from the state of rest under F_mean; a positive F_roll pushes the work rolls
apart. The run begins at rest in the equilibrium under the first force.</p>
<h2>Steps and input</h2>
<p>Between communication points the equations are solved exactly for the force received, so that no step size limits
stability or accuracy. What remains is the force between the points: held at its last value unless its first
derivative is set ({6}). A held force asks for steps of at most 1/(20 f), f the highest frequency of interest{7}.</p>
<p>Stiffnesses and damping may be changed between steps: displacements and velocities stay as they are, the
equilibrium under F_mean stays the datum.{8}</p>
<h2>Variables</h2>
<table><tr><th>name</th><th>reference</th><th>kind</th><th>unit</th><th>range</th><th>meaning</th></tr>
{9}</table>
<h2>Platforms</h2>
<p>{10} {11}</p>
</body></html>
)",
      escaped(model.title), escaped(model.method), escaped(model.origin), fmi_version, escaped(model.program),
      chain ? "M y'' + (2 zeta modal damping + C b b<sup>T</sup>) y' + K y = b (F - F_mean): masses M, springs K "
              "in a "
              "chain, b = +1 at the upper and -1 at the lower work roll."
            : "q'' + (2 zeta w + C b b<sup>T</sup>) q' + w<sup>2</sup> q = b (F - F_mean) in the modes of the "
              "stand, "
              "y = P q at its points.",
      fmi_version == 2 ? "fmi2SetRealInputDerivatives, order 1"
                       : "by the intermediate update, for a client that lists F_roll among the required "
                         "intermediate variables: the force then runs along a straight line",
      f > 0 ? fmt::format("; the highest mode here has {:.0f} Hz", f) : "",
      model.data.has_series ? " With use_stored_force the recorded force of resources/force.csv is played, linear "
                              "between its samples and held before and after; F_roll is then not used."
                            : "",
      table_of(described_variables(model, fmi_version)),
      "The library for Linux (x86-64) needs glibc " + named_file("glibc") + " or newer and nothing else.",
      windows);
}

std::string external_dependencies()
{
  return "binaries for Linux, x86-64: libc and libm of glibc, symbols up to " + named_file("glibc") +
         "\nbinaries for Windows, 64 bit (where present): KERNEL32 and msvcrt, parts of the system\n";
}
}  // namespace mill::fmu
