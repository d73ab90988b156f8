#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// One thing to do while walking a body.
struct WalkStep {
  /// Kind of the step.
  enum class Op : std::uint8_t {
    kSkip,     ///< `size` bytes of fixed fields
    kCount,    ///< an integer of `size` bytes that is the count of a later array: kept in the next register
    kFixed,    ///< elements of `size` bytes each
    kStrings,  ///< strings
    kStructs   ///< structs of variable size
  };
  Op op = Op::kSkip;
  std::size_t size = 0;
  const Struct* type = nullptr;    ///< type of the elements of kStructs
  std::vector<std::int64_t> dims;  ///< >= 0: constant; < 0: the count in register -1 - dim
  std::int64_t empty = 0;          ///< values without bytes within each element of kFixed
};

/// The steps of one type, without fingerprint.
struct WalkPlan {
  std::vector<WalkStep> steps;
  std::size_t counts = 0;                 ///< registers needed
  std::int64_t empty = 0;                 ///< values without bytes within the fields of kSkip
  std::optional<std::size_t> fixed_size;  ///< bytes of the body, if all messages of the type have the same
};

/// Plans the walk of a type whose nested types are resolved.
WalkPlan MakeWalkPlan(const Struct& type);

}  // namespace priamos::bus
