#pragma once

// What a client finds in the library; everything else stays hidden.
#ifdef _WIN32
#define MILL_FMU_EXPORT __declspec(dllexport)
#else
#define MILL_FMU_EXPORT __attribute__((visibility("default")))
#endif
