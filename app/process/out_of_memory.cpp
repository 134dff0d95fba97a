#include "app/process/out_of_memory.h"
#include "core/process/memory.h"
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
    return;  // nobody listens
}

bool meant = false, refused = false;

// libgomp exits where it can start no thread or has no memory for one, and says so itself.
void end_of_a_library()
{
  if (meant)
    return;
  say("a library ended the program: it had no memory or could start no thread\n  change        fewer threads "
      "(--threads), or higher limits\n");
  ::_exit(3);
}

[[noreturn]] void end_here()
{
  if (refused)
    ::_exit(3);  // the sentence is said; what a library does behind it is no news
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
    say("millstand failed on its own account: ");
    say(e.what());
    say("\n");
  } catch (...) {
    say("millstand failed on its own account\n");
  }
  ::_exit(1);
}
}  // namespace

SolverError out_of_memory(const std::string &stage)
{
  refused = true;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const MemoryLeft left = memory_left();
  return SolverError({stage.empty() ? "out of memory" : "out of memory in the stage " + stage,
                      megabytes(1024. * double(usage.ru_maxrss)) + " were in use; the end is set by " + left.end,
                      "a finer mesh or a longer record than this machine or this limit can hold",
                      "a coarser mesh (contact.*.elements_per_half_width, dynamics.elements_per_radius), fewer "
                      "threads (--threads), or a higher limit",
                      ""});
}

void end_with_a_sentence()
{
  std::set_terminate(end_here);
  std::atexit(end_of_a_library);
}

void end_as_meant()
{
  meant = true;
}
}  // namespace mill
