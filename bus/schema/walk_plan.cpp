#include "bus/schema/walk_plan.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "bus/schema/fingerprint.hpp"

namespace priamos::bus {
namespace {

/// Largest size that is counted [bytes]; larger than any message. Sums and products stop here, and the
/// comparison with the bytes refuses it.
constexpr std::size_t kHugeWalk = std::numeric_limits<std::size_t>::max() / 4;

std::size_t Times(std::size_t a, std::size_t b) {
  std::size_t result = 0;
  return __builtin_mul_overflow(a, b, &result) ? kHugeWalk : std::min(result, kHugeWalk);
}

/// Most values that are counted: more than any message may hold.
constexpr std::int64_t kManyValues = std::int64_t{1} << 31;

/// Encoded sizes [bytes] of fields, values and types; nullopt for what contains a string or a variable array.
class FixedSizes {
 public:
  std::optional<std::size_t> OfField(const Field& field) {
    std::optional<std::size_t> size = OfValue(field);
    for (const Dimension& dimension : field.dims) {
      if (dimension.variable || !size) return std::nullopt;
      size = Times(*size, static_cast<std::size_t>(dimension.size));
    }
    return size;
  }

  std::optional<std::size_t> OfValue(const Field& field) {
    if (field.kind == Kind::kString) return std::nullopt;
    return field.kind == Kind::kStruct ? OfBody(*field.type) : std::optional(WireSize(field.kind));
  }

  std::optional<std::size_t> OfBody(const Struct& type) {
    if (const auto known = known_.find(&type); known != known_.end()) return known->second;
    known_[&type] = std::nullopt;  // what a type sees of itself while it is open: not fixed
    std::size_t sum = 0;
    for (const Field& field : type.fields) {
      const auto size = OfField(field);
      if (!size) return std::nullopt;
      sum = std::min(sum + *size, kHugeWalk);
    }
    return known_[&type] = sum;
  }

  /// Number of structs without bytes in a field of fixed size. A few lines of text can define billions.
  std::int64_t EmptyIn(const Field& field) {
    if (field.kind != Kind::kStruct) return 0;
    std::int64_t count = EmptyIn(*field.type) + (OfBody(*field.type) == 0U ? 1 : 0);
    for (const Dimension& dimension : field.dims)
      if (__builtin_mul_overflow(count, dimension.size, &count)) count = kManyValues;
    return std::min(count, kManyValues);
  }
  std::int64_t EmptyIn(const Struct& type) {
    if (const auto known = empty_.find(&type); known != empty_.end()) return known->second;
    std::int64_t count = 0;
    for (const Field& field : type.fields) count = std::min(count + EmptyIn(field), kManyValues);
    return empty_[&type] = count;
  }

 private:
  std::map<const Struct*, std::optional<std::size_t>> known_;
  std::map<const Struct*, std::int64_t> empty_;
};

class WalkPlanner {
 public:
  explicit WalkPlanner(const Struct& type) : type_(type), registers_(type.fields.size(), -1) {
    for (const Field& field : type.fields) {
      for (const Dimension& dimension : field.dims) {
        if (dimension.variable) registers_[dimension.count_field] = 0;
      }
    }
  }

  WalkPlan Run() {
    for (std::size_t i = 0; i < type_.fields.size(); ++i) Plan(i);
    plan_.fixed_size = sizes_.OfBody(type_);
    return std::move(plan_);
  }

 private:
  void Plan(std::size_t index) {
    const Field& field = type_.fields[index];
    if (registers_[index] >= 0) {
      registers_[index] = static_cast<std::int64_t>(plan_.counts++);
      plan_.steps.push_back({WalkStep::Op::kCount, WireSize(field.kind), nullptr, {}});
      return;
    }
    if (const auto size = sizes_.OfField(field)) {
      if (plan_.steps.empty() || plan_.steps.back().op != WalkStep::Op::kSkip) plan_.steps.emplace_back();
      plan_.steps.back().size = std::min(plan_.steps.back().size + *size, kHugeWalk);
      plan_.empty = std::min(plan_.empty + sizes_.EmptyIn(field), kManyValues);
      return;
    }
    const auto element = sizes_.OfValue(field);
    const auto op = element                       ? WalkStep::Op::kFixed
                    : field.kind == Kind::kString ? WalkStep::Op::kStrings
                                                  : WalkStep::Op::kStructs;
    WalkStep step{op, element.value_or(0), field.type, {}};
    if (element && field.type != nullptr) step.empty = sizes_.EmptyIn(*field.type);
    for (const Dimension& dimension : field.dims) {
      step.dims.push_back(dimension.variable ? -1 - registers_[dimension.count_field] : dimension.size);
    }
    plan_.steps.push_back(std::move(step));
  }

  const Struct& type_;
  std::vector<std::int64_t> registers_;  // per field: -1 when it counts nothing
  FixedSizes sizes_;
  WalkPlan plan_;
};

}  // namespace

WalkPlan MakeWalkPlan(const Struct& type) {
  return WalkPlanner(type).Run();
}

}  // namespace priamos::bus
