#pragma once
#include "dynamics/marks/marks.h"

// What turns in each kind of case: its rolls, what happens in a turn of their bearings and of the drive.
namespace mill {
struct BiteCase;
struct ChatterCase;
struct FourHigh;
struct Lumped;

dynamics::MarkSources mark_sources(const FourHigh &stand);
dynamics::MarkSources mark_sources(const Lumped &lumped);
dynamics::MarkSources mark_sources(const BiteCase &spec);
dynamics::MarkSources mark_sources(const ChatterCase &spec);
}  // namespace mill
