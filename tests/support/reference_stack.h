#pragma once
#include "core/model/stack.h"
#include "support/reference.h"

/// The stack of one entry of tests/reference/stack.json, SI.
mill::Stack reference_stack(const Reference &entry);
