#include "app/process/out_of_memory.h"
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <sys/resource.h>
#include <unistd.h>

namespace mill {
namespace {
void say(const char *text)
{
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0)
    return;  // the output is closed
}

bool exit_is_normal = false, refused = false;

// libgomp exits where it can start no thread or has no memory for one, and says so itself.
void end_of_a_library()
{
  if (exit_is_normal)
    return;
  say("a library ended the program: it had no memory or could start no thread\n  change        fewer threads "
      "(--threads), or higher limits\n");
  ::_exit(3);
}

[[noreturn]] void end_here()
{
  if (refused)
    ::_exit(3);  // the message is printed; what a library does afterwards is not reported
  try {
    if (const auto error = std::current_exception())
      std::rethrow_exception(error);
  } catch (const std::bad_alloc &) {
    say("out of memory in a thread of a library\n  change        a coarser mesh, fewer threads (--threads), or "
        "more "
        "memory\n");
    ::_exit(3);
  } catch (const std::exception &e) {
    if (std::strstr(e.what(), "pthread_create")) {
      say("a thread of a library could not be started\n  change        fewer threads (--threads), or higher "
          "limits "
          "(ulimit -u, -v)\n");
      ::_exit(3);
    }
    say("internal error of millstand: ");
    say(e.what());
    say("\n");
  } catch (...) {
    say("internal error of millstand\n");
  }
  ::_exit(1);
}
}  // namespace

OutOfMemory out_of_memory(const std::string &stage)
{
  refused = true;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const MemoryLeft left = memory_left();
  return OutOfMemory(
      {stage.empty() ? "out of memory" : "out of memory in the stage " + stage,
       megabytes(1024. * double(usage.ru_maxrss)) + " were in use; the limit is set by " + left.end,
       "a finer mesh or a longer record than this machine or this limit can hold",
       memory_remedy("a coarser mesh (contact.*.elements_per_half_width, dynamics.elements_per_radius)"), ""});
}

void end_with_a_sentence()
{
  std::set_terminate(end_here);
  std::atexit(end_of_a_library);
}

void begin_normal_exit()
{
  exit_is_normal = true;
}
}  // namespace mill
