#pragma once

/// How many times longer than with the release build a test waits; 1 there, 10 with the thread sanitizer.
int slowness();
