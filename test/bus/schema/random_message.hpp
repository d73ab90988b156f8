#pragma once

#include "bus/schema/schema.hpp"
#include "common/random.hpp"
#include "encoding.hpp"

namespace priamos::bus {

/// What RandomMessage puts into the fields.
enum class Values : std::uint8_t {
  kAny,      ///< anything the type can encode, special floating point numbers included
  kInRange,  ///< what the annotations promise: within @range and @age, now and then @invalid
};

/// A well-formed message of `type`. Arrays and strings keep their @max, or are short when there is none.
/// Time stamps of kInRange are in the past of `now_us`.
Bytes RandomMessage(const Struct& type, Values values, Rng& rng, std::int64_t now_us = 0);

}  // namespace priamos::bus
