#include "app/command/command_line.h"
#include "app/command/common_options.h"
#include "app/command/verb_declarations.h"
#include <CLI/CLI.hpp>

namespace mill {
namespace {
void add_marks(CLI::App &app, CommandLine &c)
{
  auto *marks =
      app.add_subcommand("marks", "marks at equal distances: the rolls, bearings and modes that may cause them");
  marks->add_option("CASE", c.target, "case file")->required();
  marks->add_option("--spacing", c.marks.spacing, "distance of the marks along the strip, \"2 mm\"");
  marks->add_option("--frequency", c.marks.frequency,
                    "of a vibration that would leave the marks, \"315 Hz\", instead of --spacing");
  marks->add_option("--speed", c.marks.speed, "speed of the strip behind the stand, \"500 m/min\"")->required();
  marks->add_option("--forward-slip", c.marks.forward_slip,
                    "forward slip of the strip over the rolls (default 0 %)");
  marks->add_option("--accuracy", c.marks.accuracy,
                    "uncertainty of spacing and diameters together (default 1 %), within which a number of marks "
                    "is taken as whole");
  marks->add_option("--side-bands", c.marks.side_bands, "distance of side bands in a spectrum, \"49 Hz\"");
  marks->add_option("--run", c.marks.run, "folder of a run whose modes are taken (default out/<case name>)");
  add_output(marks, c, "folder of the results (default out/<case name>-marks)");
  add_overwrite(marks, c);
  marks->add_flag("-q,--quiet", c.quiet, "no table");
  add_sets(marks, c);
}

void add_analyse(CLI::App &app, CommandLine &c)
{
  auto *analyse = app.add_subcommand(
      "analyse", "records of a mill: spectra, modes, what follows the speed, source of each peak");
  analyse->add_option("RECORD", c.names, "CSV, .npy with .json, .npz, .uff, .mat, .wav or .lvm")->required();
  analyse->add_option("--case", c.case_file, "stand of the record, kind four-high or lumped");
  add_model(analyse, c, {"six-mass", "beam"}, "of a case of kind four-high: six-mass or beam (default)");
  add_record_options(analyse, c);
  analyse->add_option("--speed", c.speed, "surface speed of the rolls, if it was not recorded, \"4 m/s\"");
  analyse->add_option("--limit", c.limit, "vibration limit of this mill, 0-peak, \"2 g\"");
  add_repeatable(analyse, "--severity", c.severity,
                 "upper end of a zone, \"2.3 mm/s\", repeatable; none is built in");
  analyse->add_flag("--align", c.align, "take the delay between the clocks of force and vibrations out of H1");
  add_repeatable(analyse, "--baseline", c.baseline,
                 "folder of an earlier analysis, for changes and bearings, repeatable");
  add_folder(analyse, c, "folder of the results (default out/<record>-analysis)", "no progress, no table");
}

void add_calibrate(CLI::App &app, CommandLine &c)
{
  auto *verb =
      app.add_subcommand("calibrate", "springs, masses and damping of a stand from records, with their intervals");
  CalibrateOptions &o = c.calibrate;
  verb->add_option("CASE", c.target, "stand, kind four-high or lumped")->required();
  verb->add_option("--measured", o.measured, "folder of the records, with records.toml where they have roles");
  verb->add_option(
      "--free", o.free,
      "unknowns of the fit, \"K1, M2/M5, frame, zeta\": names, groups with one factor, or frame, springs, "
      "masses, ratios (default: all springs, masses with a stated error, zeta)");
  add_model(verb, c, {"six-mass", "beam", "craig-bampton"},
            "of a case of kind four-high (default: dynamics.model of the case, else the model that leads a run)");
  verb->add_option("--model-error", o.model_error,
                   "error that the model may have in each third octave, of its level (default \"5 %\")");
  verb->add_flag("--plan", o.plan, "which unknowns a record would identify, before anyone measures");
  verb->add_flag("--accept", o.accept, "write calibrated.toml although it is refused, and say so in it");
  verb->add_flag("--align", o.align, "force and vibration have two clocks: fit their delay");
  verb->add_option("--sensors", o.sensors,
                   "with --plan: places of the sensors (default: upper_work_roll,lower_work_roll)");
  verb->add_option("--duration", o.duration, "with --plan: duration of the record (default \"20 s\")");
  verb->add_option("--noise", o.noise, "with --plan: noise of a sensor, per root Hz (default \"0.005 m/s2\")");
  verb->add_option("--force-rms", o.force, "with --plan: rms of the force (default \"1 kN\")");
  verb->add_option("--force-up-to", o.highest,
                   "with --plan: highest frequency of the force (default \"1500 Hz\")");
  verb->add_flag("--without-force", o.without_force, "with --plan: the force is not recorded");
  add_record_options(verb, c);
  add_folder(verb, c, "folder of the results (default out/<case name>-calibration)", "no progress, no table");
}

void add_advise(CLI::App &app, CommandLine &c)
{
  auto *advise = app.add_subcommand(
      "advise", "actions that would lower the vibration: each recomputed, ranked, with its cost");
  advise
      ->add_option("CASE", c.target,
                   "case file of kind four-high or lumped (level of a place) or chatter "
                   "(critical speed); [advice] says what may be tried")
      ->required();
  advise->add_option("--measured", c.measured, "folder of records with the rolling force that shakes the stand");
  add_record_options(advise, c);
  add_cache(advise, c);
  add_folder(advise, c, "folder of the results (default out/<case name>-advice)", "no table");
}

void add_live(CLI::App &app, CommandLine &c)
{
  auto *live =
      app.add_subcommand("live", "the model of a stand, driven by the measured rolling force while the mill runs");
  LiveOptions &o = c.live;
  live->add_option("CASE", c.target, "case file of kind four-high, chatter or lumped")->required();
  add_model(live, c, {"six-mass", "beam"}, "of a case of kind four-high: six-mass or beam (default)");
  live->add_option(
      "--input", o.input,
      "FILE.csv (played), tail:FILE.csv (growing), - (lines on standard input), tcp:ADDR:PORT (default "
      "tcp:127.0.0.1:8461) or mqtt:HOST:PORT/STAND");
  live->add_option("--listen", o.listen, "address of the page, ADDR:PORT (default 127.0.0.1:8460), or none");
  live->add_option("--record", o.record, "folder for recordings and the state for a restart");
  live->add_option("--keep", o.keep, "how much of the recordings is kept: 24h, 7d, 50GB (default: all)");
  live->add_option("--speed", o.speed, "speed at which a record is played: times real time, or max (default 1)");
  live->add_option("--limit", c.limit,
                   "vibration limit of this mill in a band, 0-peak, \"2 g\" (default monitoring.limit)");
  live->add_option("--token-file", o.token_file,
                   "file with the token of page and data port; needed for addresses that are not loopback");
  live->add_option("--host", o.host, "host name that a reverse proxy uses for the page");
  live->add_option("--response", o.response, "write the accelerations of the twin into this file (CSV)");
  add_record_options(live, c);
  add_sets(live, c);
  live->add_flag("--fresh", c.fresh, "start without the state of an earlier program");
  live->add_flag("--force-overwrite", c.force_overwrite, "replace an existing --response file");
  live->add_flag("-q,--quiet", c.quiet, "no lines on the console");
}
}  // namespace

void add_record_verbs(CLI::App &app, CommandLine &c)
{
  add_marks(app, c);
  add_analyse(app, c);
  add_calibrate(app, c);
  add_advise(app, c);
  add_live(app, c);
}
}  // namespace mill
