#pragma once

namespace priamos {

constexpr double Square(double x) {
  return x * x;
}

}  // namespace priamos
