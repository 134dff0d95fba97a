#pragma once
#include "core/model/stack.h"
#include "tests/support/reference.h"

/// The stack of one entry of tests/reference/stack.json, SI.
mill::Stack reference_stack(const Reference &entry);
