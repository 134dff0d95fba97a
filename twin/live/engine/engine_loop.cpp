#include "twin/live/engine/engine_loop.h"
#include "twin/live/steady_clock.h"

namespace mill::live {
void run_engine(Engine &engine, SampleQueue &queue, CommandQueue &commands, const LoopHooks &hooks)
{
  constexpr double longest_wait = 0.05;  // s
  double ticked                 = steady_now();
  bool more                     = false;
  while (!engine.ended() && !(hooks.stop && hooks.stop())) {
    auto message = queue.pop(more ? 0 : longest_wait);
    more         = message.has_value();
    if (message)
      engine.take(std::move(*message));
    else
      engine.flush();
    for (const PageCommand &command : commands.take())
      engine.apply(command);
    const double now = steady_now();
    if (hooks.tick && (!more || now - ticked > longest_wait)) {
      ticked = now;
      hooks.tick(now);
    }
  }
  engine.flush();
}
}  // namespace mill::live
