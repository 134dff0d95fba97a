#pragma once
#include "app/command/command_line.h"

namespace mill {
/// millstand study work DIR --shard I/N: computes the rows of one shard that no file of this shard has yet.
/// Started attempts are on the disk before their rows are computed, results at the latest half a second after
/// them; a row that ended the program twice is marked as failed and passed over.  Rows of closed forms are
/// computed by all threads, the rows of a run one after the other.
/// @return 0; 128 and the number of the signal that asked for an end, with the command that continues
/// @throws InputError  no study, another case or version, a shard that does not exist; SystemError  a full disk
int study_work(const CommandLine &command);
}  // namespace mill
