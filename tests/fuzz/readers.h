#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

/// A reader of foreign text as libFuzzer calls it.
struct Reader {
  const char *name;  ///< of its target and of its folder in corpus/
  int (*read)(const std::uint8_t *data, std::size_t size);
};

/// Every target of this folder (targets.cmake).
const std::vector<Reader> &all_readers();
