#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "common/archive.hpp"

namespace priamos {

/// Describes a key of three numbers: x, y, z.
inline void Vector(Archive& a, std::string_view key, Eigen::Vector3d& value, const ValueSpec& spec) {
  std::vector<double> numbers(value.data(), value.data() + 3);
  a.Numbers(key, numbers, spec);
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

}  // namespace priamos
