#include "bus/schema/stamps.hpp"

#include <limits>
#include <vector>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

std::int64_t AddSaturated(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  if (!__builtin_add_overflow(a, b, &sum)) return sum;
  return b > 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
}

/// Goes through a message that passed Walk, so nothing here can run over its end.
class Shifter {
 public:
  Shifter(std::byte* body, std::int64_t by_us) : at_(body), by_us_(by_us) {}

  void Body(const Struct& type) {
    std::vector<std::int64_t> counts(type.fields.size(), 0);
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      const Field& field = type.fields[i];
      if (IsInteger(field.kind) && field.dims.empty()) counts[i] = ReadInteger(at_, WireSize(field.kind));
      Level(field, 0, counts);
    }
  }

 private:
  void Level(const Field& field, std::size_t level, const std::vector<std::int64_t>& counts) {
    if (level == field.dims.size()) return Value(field);
    const Dimension& dimension = field.dims[level];
    const std::int64_t n = dimension.variable ? counts[dimension.count_field] : dimension.size;
    for (std::int64_t i = 0; i < n; ++i) Level(field, level + 1, counts);
  }

  void Value(const Field& field) {
    if (field.kind == Kind::kStruct) return Body(*field.type);
    if (field.kind == Kind::kString) {
      at_ += 4 + ReadBigEndian<std::int32_t>(at_);
      return;
    }
    if (field.kind == Kind::kInt64 && field.annotation.age_us) Shift();
    at_ += WireSize(field.kind);
  }

  void Shift() const {
    const auto utime = ReadBigEndian<std::int64_t>(at_);
    if (utime != 0) WriteBigEndian(at_, AddSaturated(utime, by_us_));
  }

  std::byte* at_;
  std::int64_t by_us_;
};

}  // namespace

bool ShiftStamps(const Struct& type, std::span<std::byte> encoded, std::int64_t by_us) {
  if (!Walk(type, encoded)) return false;
  Shifter(encoded.data() + sizeof(std::uint64_t), by_us).Body(type);
  return true;
}

}  // namespace priamos::bus
