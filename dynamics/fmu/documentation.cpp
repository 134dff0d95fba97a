#include "dynamics/fmu/description.h"
#include "dynamics/fmu/embedded.h"
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

std::string equations_of(const ExportedModel &model)
{
  if (model.data.kind == StandKind::chatter)
    return "M x'' + C x' + K x = b (F - F_steady + F_disturbance), F the force of the roll bite by Bland and "
           "Ford's theory at the present gap, gap rate, tensions and entry thickness; the stress of the strip "
           "before "
           "and after the bite grows with the difference of the speeds at its two ends. Slack strip has no "
           "tension, a "
           "strip thinner than the gap carries no force, and work and backup rolls may separate.";
  if (model.data.kind == StandKind::chain)
    return "M y'' + (2 zeta modal damping + C b b<sup>T</sup>) y' + K y = b (F - F_mean): masses M, springs K in "
           "a "
           "chain, b = +1 at the upper and -1 at the lower work roll.";
  if (model.data.kind == StandKind::curves)
    return "q'' + (2 zeta w + C b b<sup>T</sup>) q' + w<sup>2</sup> q = b (F - F_mean) - sum of r s "
           "rho(r<sup>T</sup> q) in the modes of the stand, y = P q at its points; rho(d) is the force of a "
           "contact or "
           "a bearing at a further compression d, less that of its tangent at rest. A spring whose compression "
           "reaches "
           "zero carries no force: its bodies separate.";
  return "q'' + (2 zeta w + C b b<sup>T</sup>) q' + w<sup>2</sup> q = b (F - F_mean) in the modes of the stand, "
         "y = P q at its points.";
}

std::string stored_force_text(const ExportedModel &model)
{
  return model.data.has_series
             ? " The recorded force of resources/force.csv is played, linear between its samples and held before "
               "and "
               "after, as long as the client has not set F_roll; from then on F_roll drives. A client that sets "
               "use_stored_force decides: true plays the record for any F_roll, false does not play it."
             : "";
}

// Signs, start, steps, changes between them.
std::string behaviour_of(const ExportedModel &model, const int fmi_version)
{
  const std::string slope =
      fmi_version == 2 ? "fmi2SetRealInputDerivatives, order 1"
                       : "by the intermediate update, for a client that lists the force among the required "
                         "intermediate variables: the force then runs along a straight line";
  if (model.data.kind == StandKind::chatter)
    return fmt::format(
        R"(<p>Displacements are positive away from the strip and count from the working point. The run begins with both
work rolls displaced by start_displacement, all else at rest.</p>
<h2>Steps and input</h2>
<p>Inside a communication step the equations are integrated with error control (relative 1e-8 per step of the
integrator), and every edge (slack strip, skidding, strip that loses contact with the rolls, rolls that separate) is located
to 1e-11 s; the result depends on the communication step only through the inputs: F_disturbance is held between the points
unless its first derivative is set ({0}), the other inputs are held over each step. A held input needs steps of at most
1/(20 f), f the highest frequency of interest; the step of the default experiment keeps this for every mode of the
stand.</p>
<p>Speed, thickness, tensions, reduction and lubrication may be changed between steps. The steady bite is solved again, once,
when it is needed; displacements and stresses count from the new working point, to which screws and neighbouring stands are
taken to have moved, and the vibration goes on. Without a steady bite, fmi{1}DoStep returns {3} and the instance stays where
it is until other values are set. A strip that tears and rolls that meet end the run: fmi{1}DoStep writes the reason into the
log, and {2}.</p>)",
        slope, fmi_version,
        fmi_version == 2
            ? "it returns Discard; fmi2GetRealStatus gives the moment, and fmi2GetBooleanStatus says that the "
              "run has ended"
            : "terminateSimulation is true and lastSuccessfulTime is the moment, so that a client keeps the "
              "rows before it",
        fmi_version == 2 ? "Error" : "Discard");
  if (model.data.kind == StandKind::curves)
    return fmt::format(
        R"(<p>Displacements are up positive and count from the state of rest under F_mean, which is that of the case and
cannot be changed, since the load of the springs at rest belongs to it; a positive F_roll pushes the work rolls apart. The
run begins at rest in the equilibrium under the first force.</p>
<h2>Steps and input</h2>
<p>A communication step is taken in implicit steps of equal length, none above {1:.4g} us. For the linear part of the stand
they are exact at any length, for the part that the curves add they are of second order; the result does not depend on the
communication step where that is a multiple of {1:.4g} us. The force is held at its last value unless its first derivative
is set ({0}). A held force needs steps of at most 1/(20 f), f the highest frequency of interest; the step of the
default experiment keeps this for every mode.</p>
<p>Damping may be changed between steps: displacements and velocities stay as they are. The curves are data
(resources/model.json) and cannot be tuned.{2}</p>)",
        slope, 1e6 * model.data.curves.longest_step, stored_force_text(model));
  const auto &last = model.data.frequency;
  const double f   = model.data.kind == StandKind::chain || last.empty() ? 0 : last.back();
  return fmt::format(
      R"(<p>Displacements are up positive and count from the state of rest under F_mean; a positive F_roll pushes the work rolls
apart. The run begins at rest in the equilibrium under the first force.</p>
<h2>Steps and input</h2>
<p>Between communication points the equations are solved exactly for the force received, so that no step size limits
stability or accuracy. What remains is the force between the points: held at its last value unless its first
derivative is set ({0}). A held force needs steps of at most 1/(20 f), f the highest frequency of interest{1}; the
step of the default experiment keeps this for every mode.</p>
<p>Stiffnesses and damping may be changed between steps: displacements and velocities stay as they are, the
equilibrium under F_mean stays the datum.{2}</p>)",
      slope, f > 0 ? fmt::format("; the highest mode here has {:.0f} Hz", f) : "", stored_force_text(model));
}
}  // namespace

std::string documentation_page(const ExportedModel &model, const int fmi_version)
{
  std::string windows = named_file("win64").empty()
                            ? "This unit has no library for Windows: build the files of sources/ there "
                              "(C++17, no other library; sources/buildDescription.xml)."
                            : "The library for Windows was compiled with mingw-w64.";
  return fmt::format(
      R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{0}</title>
<style>body {{ font-family: sans-serif; max-width: 70em; margin: 2em }} td, th {{ border-bottom: 1px solid #ccc; padding: 0.2em 0.6em; text-align: left }}</style>
</head><body>
<h1>{0}</h1>
<p>{1}; {2}. Co-simulation by FMI {3}.0, version {10} of this model, written by {4}.</p>
<h2>Equations</h2>
<p>{5}</p>
{6}
<h2>Variables</h2>
<table><tr><th>name</th><th>reference</th><th>kind</th><th>unit</th><th>range</th><th>meaning</th></tr>
{7}</table>
<h2>Platforms</h2>
<p>{8} {9}</p>
</body></html>
)",
      escaped(model.title), escaped(model.method), escaped(model.origin), fmi_version, escaped(model.program),
      equations_of(model), behaviour_of(model, fmi_version), table_of(described_variables(model, fmi_version)),
      "The library for Linux (x86-64) needs " + named_file("glibc") + " or newer and no other library.", windows,
      version_of(model));
}

std::string static_linking(const ExportedModel &model)
{
  return fmt::format(
      "The sources are C++17 and need no other library. Compile every file that sources/buildDescription.xml "
      "lists.\n\n"
      "As they are, all functions have the prefix {0}_ ({0}_fmi2Instantiate, {0}_fmi3DoStep), and all other names "
      "are in\n"
      "the namespace {0}_mill: several units can be linked into one program.\n\n"
      "For a shared library, whose functions have plain names, define FMI2_OVERRIDE_FUNCTION_PREFIX and\n"
      "FMI3_OVERRIDE_FUNCTION_PREFIX:\n\n"
      "  g++ -std=c++17 -O2 -shared -fPIC -DFMI2_OVERRIDE_FUNCTION_PREFIX -DFMI3_OVERRIDE_FUNCTION_PREFIX \\\n"
      "      -o {0}.so sources/*.cpp\n",
      model.identifier);
}

std::string external_dependencies()
{
  return "binaries for Linux, x86-64: libc and libm of glibc, symbols up to " + named_file("glibc") +
         "\nbinaries for Windows, 64 bit (where present): KERNEL32 and msvcrt, parts of the system\n";
}
}  // namespace mill::fmu
