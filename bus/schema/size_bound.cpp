#include <algorithm>
#include <limits>
#include <map>

#include "bus/schema/fingerprint.hpp"
#include "bus/schema/schema.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kHuge = std::numeric_limits<std::size_t>::max();

std::size_t SaturatingProduct(std::size_t a, std::size_t b) {
  std::size_t result = 0;
  return __builtin_mul_overflow(a, b, &result) ? kHuge : result;
}

std::size_t SaturatingSum(std::size_t a, std::size_t b) {
  return a > kHuge - b ? kHuge : a + b;
}

/// Upper bounds of bodies, each nested type computed once.
class Bound {
 public:
  std::optional<std::size_t> OfBody(const Struct& type) {
    if (const auto known = known_.find(&type); known != known_.end()) return known->second;
    if (IsRecursive(type)) return std::nullopt;
    std::optional<std::size_t> sum = 0;
    for (const Field& field : type.fields) {
      const auto size = OfField(type, field);
      sum = sum && size ? std::optional(SaturatingSum(*sum, *size)) : std::nullopt;
    }
    return known_[&type] = sum;
  }

 private:
  std::optional<std::size_t> OfField(const Struct& type, const Field& field) {
    std::optional<std::size_t> size = OfValue(field);
    for (std::size_t i = 0; size && i < field.dims.size(); ++i) {
      const auto count = MaxCount(type, field, i);
      size = count ? std::optional(SaturatingProduct(*size, static_cast<std::size_t>(*count))) : std::nullopt;
    }
    return size;
  }

  std::optional<std::size_t> OfValue(const Field& field) {
    if (field.kind == Kind::kStruct) return OfBody(*field.type);
    if (field.kind != Kind::kString) return WireSize(field.kind);
    const auto length = MaxTextLength(field);
    if (!length) return std::nullopt;
    return static_cast<std::size_t>(*length) + 5;  // int32_t length before it, zero behind it
  }

  std::map<const Struct*, std::optional<std::size_t>> known_;
};

std::size_t VariableDimensions(const Field& field) {
  return static_cast<std::size_t>(
      std::count_if(field.dims.begin(), field.dims.end(), [](const Dimension& d) { return d.variable; }));
}

}  // namespace

std::optional<std::size_t> MaxEncodedSize(const Struct& type) {
  const auto body = Bound().OfBody(type);
  if (!body || *body > kHuge - 8) return std::nullopt;
  return *body + 8;
}

std::optional<std::int64_t> MaxCount(const Struct& type, const Field& field, std::size_t index) {
  const Dimension& dimension = field.dims[index];
  if (!dimension.variable) return dimension.size;
  std::optional<std::int64_t> bound;
  const std::optional<Number>& range_end = type.fields[dimension.count_field].annotation.max;
  if (range_end && range_end->integer && *range_end->integer >= 0) bound = range_end->integer;
  // With text in it, a single number is the length of the text.
  const std::vector<std::int64_t>& sizes = field.annotation.sizes;
  const std::size_t variable = VariableDimensions(field);
  if (sizes.size() == variable + (field.kind == Kind::kString ? 1 : 0)) {
    const auto before =
        std::count_if(field.dims.begin(), field.dims.begin() + static_cast<std::ptrdiff_t>(index),
                      [](const Dimension& d) { return d.variable; });
    const std::int64_t size = sizes[static_cast<std::size_t>(before)];
    bound = bound ? std::min(*bound, size) : size;
  }
  return bound;
}

std::optional<std::int64_t> MaxTextLength(const Field& field) {
  const std::vector<std::int64_t>& sizes = field.annotation.sizes;
  const bool complete = sizes.size() == 1 || sizes.size() == VariableDimensions(field) + 1;
  if (field.kind != Kind::kString || !complete) return std::nullopt;
  return sizes.back();
}

}  // namespace priamos::bus
