#pragma once
#include "twin/live/engine/command_queue.h"
#include "twin/live/engine/engine.h"
#include "twin/live/queue/sample_queue.h"
#include <functional>

namespace mill::live {
/// Work between the blocks.
struct LoopHooks {
  std::function<bool()> stop;            ///< asked between two blocks
  std::function<void(double now)> tick;  ///< at least every 50 ms, s of a steady clock
};

/// Runs the engine in this thread until the source ends, or it is stopped: messages in their order, commands
/// between two blocks.  Rows wait for more only while more are there.
void run_engine(Engine &engine, SampleQueue &queue, CommandQueue &commands, const LoopHooks &hooks);
}  // namespace mill::live
