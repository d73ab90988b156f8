#pragma once

#include <stdexcept>

namespace priamos::bus {

/// A bus that cannot be opened or used; what() names it and the next step.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace priamos::bus
