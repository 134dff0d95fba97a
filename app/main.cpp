#include "app/command/command_line.h"
#include "app/process/address_space.h"
#include "app/process/console.h"
#include "app/process/out_of_memory.h"
#include "app/verbs/commands.h"
#include "core/base/visible_text.h"
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

namespace {
using namespace mill;

__attribute__((section(".preinit_array"), used)) void (*const before_all)(int, char **,
                                                                          char **) = &check_address_space;

// Who gives --force-overwrite wants to know what an error has left of the earlier results.  A verb writes them
// after all of its input was understood; live, which writes while it reads, says it itself.
void say_what_stays(const std::optional<CommandLine> &command)
{
  if (!command || !command->force_overwrite || command->verb == Verb::live)
    return;
  std::error_code ignored;
  if (command->output.empty())
    console::say("nothing was written; earlier results are unchanged\n");
  else if (std::filesystem::exists(command->output, ignored))
    console::say("nothing was written; " + visible(command->output, true) + " is unchanged\n");
}

int carry_out_command(int argc, char **argv)
{
  std::optional<CommandLine> command;
  try {
    int exit_code = 0;
    command       = parse_command_line(argc, argv, exit_code);
    if (command)
      exit_code = carry_out(*command);
    console::flush();
    return exit_code;
  } catch (const SystemError &e) {
    console::show(e);
    return 3;
  } catch (const InputError &e) {
    console::show(e);
    say_what_stays(command);
    return 2;
  } catch (const SolverError &e) {
    console::show(e);
    return 3;
  } catch (const console::OutputError &e) {
    console::show(e);
    return 3;
  } catch (const std::filesystem::filesystem_error &e) {  // a disk or a permission
    console::say("error: " + e.path1().string() + ": " + e.code().message() + "\n");
    return 3;
  } catch (const std::bad_alloc &) {
    console::show(out_of_memory(stage_in_progress()));
    return 3;
  } catch (const std::string &message) {  // what Gmsh throws
    console::show_bug(std::runtime_error("Gmsh: " + message), current_manifest());
    return 1;
  } catch (const std::exception &e) {
    console::show_bug(e, current_manifest());
    return 1;
  }
}
}  // namespace

int main(int argc, char **argv)
{
  console::open_standard_files();
  end_with_a_sentence();
  const int exit_code = carry_out_command(argc, argv);
  begin_normal_exit();
  return exit_code;
}
