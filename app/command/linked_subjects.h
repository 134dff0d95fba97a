#pragma once
#include "app/command/command_line.h"
#include "core/model/pass.h"
#include "reduce/stand/lumped_stand.h"
#include <string>
#include <vector>

// What a program carries out in addition to runs of one stand and of its parts.  millstand is linked without these
// subjects, since who runs a stand does not need them and waits for less to be compiled; millstand-all, with all
// of them, takes over (app/process/hand_over).
namespace mill {
struct Case;
struct FourHigh;
struct MovingPass;
struct RunContext;
struct RunKind;
struct StackInput;
struct StandModels;

/// Each is nullptr where it is not linked.
struct LinkedSubjects {
  const RunKind &(*chatter)() = nullptr;  ///< kind = "chatter"
  const RunKind &(*cluster)() = nullptr;  ///< kind = "cluster"
  /// The verb chatter of a four-high stand: app/chatter/chatter_stage.
  void (*stand_chatter)(RunContext &run, const FourHigh &stand, const Pass &pass, const reduce::LumpedStand &chain,
                        const StandModels &models) = nullptr;
  /// The verb chatter of a roll stack: app/chatter/stack_chatter.
  void (*stack_chatter)(RunContext &run, const StackInput &input, const std::vector<MovingPass> &passes) = nullptr;
  /// What is_of_subjects() names.  Returns the exit code.
  int (*command)(const CommandLine &command) = nullptr;
};

/// Of this program; each defines it once (app/millstand_subjects.cpp, app/all/all_subjects.cpp).
extern const LinkedSubjects linked_subjects;

/// Whether a folder holds an analysis, a calibration, advice or a sweep, and no run.
bool is_folder_of_records(const std::string &directory);

/// Force records of more bytes than this are streamed without being asked.
constexpr long long longest_in_memory = 256LL << 20;

/// Is this a simulate whose force is read in blocks: --stream, or a file of --force beyond longest_in_memory?
bool is_streamed(const CommandLine &command);

/// analyse, calibrate, advise, live, export, sweep, study, studio, a streamed simulate, and report of a folder of
/// records.
bool is_of_subjects(const CommandLine &command);

/// Carries out a command for which is_of_subjects() holds, here or by millstand-all.  Returns the exit code.
/// @throws InputError, SolverError  of the verb; InputError  millstand-all is needed and not there
int carry_out_subject(const CommandLine &command);

/// Hands the whole command over where this program has no chatter or not the kind of the case; else nothing.
/// @throws InputError  millstand-all is not there
void require_linked(const Case &the_case, const CommandLine &command);
}  // namespace mill
