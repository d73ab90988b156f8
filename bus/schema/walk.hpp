#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// Why encoded bytes are no message of a type.
enum class WalkError : std::uint8_t {
  kNone,
  kWrongFingerprint,  ///< the first 8 bytes name another type (or other fields of the same name)
  kTruncated,         ///< a fixed field begins before the end and ends behind it
  kTrailing,          ///< bytes are left over
  kNegativeCount,     ///< a variable array counts less than 0 elements
  kHugeCount,         ///< more elements than the bytes left can hold
  kBadStringLength,   ///< below 1 (the terminator counts) or beyond the end
  kUnterminated,      ///< the last byte of a string is not zero
  kTooDeep            ///< types nest in themselves more than kMaxWalkDepth times
};

inline constexpr int kMaxWalkDepth = 64;
/// Elements of a message that need no bytes: empty structs, and rows of arrays whose other count is 0.
inline constexpr std::int64_t kMaxEmptyElements = 32768;

/// A sentence for a log or a person, such as "a count is negative".
std::string_view Sentence(WalkError error);

/// Whether bytes are a message of a type, and if not, what is wrong where.
struct WalkResult {
  WalkError error = WalkError::kNone;
  std::size_t offset =
      0;  ///< where in the bytes the fault was seen; the size of the message when there is none
  /// True when the bytes are a message of the type.
  explicit operator bool() const { return error == WalkError::kNone; }
};

/// Checks an encoded message, 8 bytes of fingerprint and the body, against a type of a Schema. What passes
/// can be given to any generated decoder: it will not read beyond the end, and what it allocates is in
/// proportion to the bytes (at most 24 bytes for each of kMaxEmptyElements on top). Allocates nothing and
/// throws nothing; runs of fixed-size fields cost one comparison.
///
/// Any boolean, any string content before the terminator and any floating point number pass, as they do
/// in LCM.
WalkResult Walk(const Struct& type, std::span<const std::byte> encoded);

}  // namespace priamos::bus
