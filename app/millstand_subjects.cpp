#include "app/command/linked_subjects.h"

// millstand and the manual: runs of one stand and of its parts alone.
namespace mill {
const LinkedSubjects linked_subjects;
}  // namespace mill
