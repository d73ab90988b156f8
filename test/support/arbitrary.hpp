#pragma once

#include <rapidcheck.h>

namespace priamos::test {

/// Any real number from `low` to `high`, in a millionth of the interval: only within a property.
inline double Real(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
}

}  // namespace priamos::test
