#pragma once
#include "app/command/calibrate_options.h"
#include "app/command/described_verbs.h"
#include "app/command/live_options.h"
#include "app/command/marks_options.h"
#include "app/command/stack_options.h"
#include "app/command/studio_options.h"
#include "app/command/study_options.h"
#include "app/command/sweep_options.h"
#include "app/command/verb.h"
#include <optional>
#include <string>
#include <vector>

namespace mill {
/// What the user asked for.
struct CommandLine {
  char **arguments = nullptr;  ///< of main(), to start the program again
  Verb verb        = Verb::run;
  std::string target;              ///< case file, kind (new) or folder (report)
  std::string output;              ///< -o; empty: default
  std::string force;               ///< simulate --force
  std::string as_kind;             ///< --as: kind that a case of another kind is taken as; empty: its own
  std::string text;                ///< run, export --text: content of the case in place of that of its file
  int progress_step = 10;          ///< --progress-step: per cent between two lines of progress
  StudioOptions studio;            ///< studio
  std::string from;                ///< new --from: sheet of keys and values
  std::string key;                 ///< trace: input that is followed
  std::string format;              ///< export: word of an ExportFormat
  std::string pass;                ///< export --pass, simulate --pass; empty: the first
  std::string model;               ///< export, analyse, calibrate, live --model; empty: the leading one
  int fmi = 2;                     ///< export --fmi: version of the standard
  std::string log;                 ///< --log
  std::string cache;               ///< --cache; empty: the user's cache folder
  std::vector<std::string> sets;   ///< --set section.key=value
  std::vector<std::string> names;  ///< verify: cases, empty: all; report: further folders; analyse: records
  std::string markdown;            ///< verify --markdown
  MarksOptions marks;              ///< marks
  CalibrateOptions calibrate;      ///< calibrate
  LiveOptions live;                ///< live
  SweepOptions sweep;              ///< sweep, study new
  StudyOptions study;              ///< study
  StackOptions stack;              ///< stack
  std::string case_file;           ///< analyse --case; empty: none
  std::string measured;            ///< advise --measured; empty: none
  std::string record_rate;         ///< analyse, calibrate, advise --rate
  std::string zone;                ///< analyse, calibrate, advise --zone
  std::string speed;               ///< analyse --speed
  std::string limit;               ///< analyse, live --limit
  std::vector<std::string> channels,
      channel_units;                  ///< analyse, calibrate, advise --channel, --unit: NAME=PLACE, NAME=UNIT
  std::vector<std::string> scales;    ///< analyse, calibrate, advise --scale: "50 mV/g", NAME=50 mV/g
  std::vector<std::string> severity;  ///< analyse --severity: upper ends of zones
  std::vector<std::string> baseline;  ///< analyse --baseline: folders of earlier analyses
  bool align = false;                 ///< analyse --align
  std::string summary;                ///< completion, help: what the program is, one sentence
  std::vector<DescribedVerb> verbs;   ///< completion, help: the command line itself
  bool manual_page     = false;       ///< help --manual-page
  bool list            = false;       ///< verify --list
  bool full            = false;       ///< trace --full
  bool stream          = false;       ///< simulate --stream
  bool force_overwrite = false, fresh = false, quiet = false, verbose = false;
  int threads = 0;     ///< 0: all
  std::string memory;  ///< --memory, "8 GB"; empty: what the machine and the system allow
};

/// Parses the command line.  Nothing is returned when it was --help or --version; `exit_code` is then what main
/// returns (2 for a wrong command line, whose message has been printed).
std::optional<CommandLine> parse_command_line(int argc, char **argv, int &exit_code);
}  // namespace mill
