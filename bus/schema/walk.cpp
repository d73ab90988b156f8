#include "bus/schema/walk.hpp"

#include <algorithm>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/schema.hpp"
#include "bus/schema/walk_plan.hpp"

namespace priamos::bus {
namespace {

/// Counts that are kept at one time, of all structs that are open.
constexpr std::size_t kMaxRegisters = 1024;

class Walker {
 public:
  Walker(const std::byte* begin, const std::byte* end) : at_(begin), end_(end) {}

  WalkError Body(const Struct& type) {
    const WalkPlan& plan = *type.walk_plan;
    if (depth_ >= kMaxWalkDepth || first_ + plan.counts > kMaxRegisters) return WalkError::kTooDeep;
    if ((empty_left_ -= plan.empty) < 0) return WalkError::kHugeCount;
    ++depth_;
    std::size_t next = first_;
    for (const WalkStep& step : plan.steps) {
      const WalkError error = step.op == WalkStep::Op::kSkip    ? Skip(step.size)
                              : step.op == WalkStep::Op::kCount ? Count(step.size, next++)
                                                                : Array(step, plan.counts);
      if (error != WalkError::kNone) return error;
    }
    --depth_;
    return WalkError::kNone;
  }

  const std::byte* at() const { return at_; }

 private:
  std::size_t Left() const { return static_cast<std::size_t>(end_ - at_); }

  WalkError Skip(std::size_t size) {
    if (size > Left()) return WalkError::kTruncated;
    at_ += size;
    return WalkError::kNone;
  }

  WalkError Count(std::size_t width, std::size_t to) {
    if (width > Left()) return WalkError::kTruncated;
    registers_[to] = ReadInteger(at_, width);
    if (registers_[to] < 0) return WalkError::kNegativeCount;
    at_ += width;
    return WalkError::kNone;
  }

  WalkError Array(const WalkStep& step, std::size_t registers_of_body) {
    std::int64_t elements = 1;
    if (!Elements(step, elements)) return WalkError::kHugeCount;
    if (step.op == WalkStep::Op::kFixed) {
      if (elements == 0 || step.size == 0) return WalkError::kNone;
      if (static_cast<std::size_t>(elements) > Left() / step.size) return WalkError::kHugeCount;
      return Skip(static_cast<std::size_t>(elements) * step.size);
    }
    if (step.op == WalkStep::Op::kStrings) {
      for (; elements > 0; --elements) {
        if (const WalkError error = Text(); error != WalkError::kNone) return error;
      }
      return WalkError::kNone;
    }
    first_ += registers_of_body;
    for (; elements > 0; --elements) {
      if (const WalkError error = Body(*step.type); error != WalkError::kNone) return error;
    }
    first_ -= registers_of_body;
    return WalkError::kNone;
  }

  /// The product of the dimensions. False when a row or an element would be made of nothing too often: what
  /// has no bytes in the message is memory all the same once it is decoded.
  bool Elements(const WalkStep& step, std::int64_t& elements) {
    const auto most = static_cast<std::int64_t>(Left()) + empty_left_;
    std::int64_t rows = 0;
    for (std::size_t i = 0; i < step.dims.size(); ++i) {
      const std::int64_t dim = step.dims[i];
      const std::int64_t n = dim >= 0 ? dim : registers_[first_ + static_cast<std::size_t>(-1 - dim)];
      if (i > 0) rows = std::max(rows, elements);
      if (__builtin_mul_overflow(elements, n, &elements) || elements > most) return false;
      if (elements == 0) break;
    }
    const bool empty = elements == 0 || (step.op == WalkStep::Op::kFixed && step.size == 0);
    if (empty) empty_left_ -= std::max(rows, elements);
    std::int64_t within = 0;
    if (__builtin_mul_overflow(elements, step.empty, &within)) return false;
    empty_left_ -= within;
    return empty_left_ >= 0;
  }

  WalkError Text() {
    if (Left() < 4) return WalkError::kTruncated;
    const auto length = ReadBigEndian<std::int32_t>(at_);
    if (length < 1 || static_cast<std::size_t>(length) > Left() - 4) return WalkError::kBadStringLength;
    at_ += 4 + length;
    return at_[-1] == std::byte{0} ? WalkError::kNone : WalkError::kUnterminated;
  }

  const std::byte* at_;
  const std::byte* end_;
  std::int64_t empty_left_ = kMaxEmptyElements;
  std::size_t first_ = 0;  // register of the open body
  int depth_ = 0;
  std::int64_t registers_[kMaxRegisters];  // not initialised: each is written before it is read
};

}  // namespace

std::string_view Sentence(WalkError error) {
  switch (error) {
    case WalkError::kNone:
      return "the message is well formed";
    case WalkError::kWrongFingerprint:
      return "the fingerprint is that of another type";
    case WalkError::kTruncated:
      return "the message ends within a field";
    case WalkError::kTrailing:
      return "there are bytes behind the last field";
    case WalkError::kNegativeCount:
      return "the count of an array is negative";
    case WalkError::kHugeCount:
      return "the count of an array is larger than the message";
    case WalkError::kBadStringLength:
      return "the length of a string is not above 0 or larger than the message";
    case WalkError::kUnterminated:
      return "a string does not end in a zero";
    case WalkError::kTooDeep:
      return "structs are nested too deeply";
  }
  return "unknown";
}

WalkResult Walk(const Struct& type, std::span<const std::byte> encoded) {
  if (encoded.size() < 8) return {WalkError::kTruncated, 0};
  if (FingerprintOf(encoded.data(), encoded.size()) != type.fingerprint)
    return {WalkError::kWrongFingerprint, 0};
  if (type.walk_plan->empty > kMaxEmptyElements) return {WalkError::kHugeCount, 8};
  if (const auto& fixed = type.walk_plan->fixed_size) {
    const std::size_t body = encoded.size() - 8;
    if (body < *fixed) return {WalkError::kTruncated, encoded.size()};
    if (body > *fixed) return {WalkError::kTrailing, 8 + *fixed};
    return {WalkError::kNone, encoded.size()};
  }
  Walker walker(encoded.data() + 8, encoded.data() + encoded.size());
  WalkError error = walker.Body(type);
  const auto offset = static_cast<std::size_t>(walker.at() - encoded.data());
  if (error == WalkError::kNone && offset != encoded.size()) error = WalkError::kTrailing;
  return {error, offset};
}

}  // namespace priamos::bus
