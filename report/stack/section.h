#pragma once

namespace mill::report {
class Page;
struct Run;

/// Profile of the strip, line load of each contact, deflection of the rolls; nothing for a run of another kind.
void stack_section(Page &page, const Run &run);
}  // namespace mill::report
