#pragma once

#include <cstddef>

namespace priamos::bus {

/// What the calling thread took from operator new since the last Reset.
struct Allocations {
  std::size_t count = 0;
  std::size_t bytes = 0;
  std::size_t largest = 0;

  static void Reset();
  static Allocations SinceReset();
};

}  // namespace priamos::bus
