#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/json.hpp"
#include "bus/schema/text_codec.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

Json FloatToJson(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  return value;
}

/// The shortest decimal that reads back as this float: 1.14, not 1.1399999856948853.
Json ShortFloat(float value) {
  return FloatToJson(std::isfinite(value) ? std::strtod(fmt::format("{}", value).c_str(), nullptr) : value);
}

/// Reads a message that passed Walk, so nothing here can run over its end.
class Printer {
 public:
  explicit Printer(const std::byte* body) : at_(body) {}

  Json Body(const Struct& type) {
    Json object = Json::object();
    std::vector<std::int64_t> counts(type.fields.size(), 0);
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      const Field& field = type.fields[i];
      if (IsInteger(field.kind) && field.dims.empty()) counts[i] = ReadInteger(at_, WireSize(field.kind));
      object[field.name] = Level(field, 0, counts);
    }
    return object;
  }

 private:
  Json Level(const Field& field, std::size_t level, const std::vector<std::int64_t>& counts) {
    if (level == field.dims.size()) return Value(field);
    const Dimension& dimension = field.dims[level];
    const std::int64_t n = dimension.variable ? counts[dimension.count_field] : dimension.size;
    if (field.kind == Kind::kByte && level + 1 == field.dims.size())
      return ToBase64(Take(static_cast<std::size_t>(n)));
    Json array = Json::array();
    for (std::int64_t i = 0; i < n; ++i) array.push_back(Level(field, level + 1, counts));
    return array;
  }

  Json Value(const Field& field) {
    const std::size_t size = WireSize(field.kind);
    switch (field.kind) {
      case Kind::kStruct:
        return Body(*field.type);
      case Kind::kString:
        return Text();
      case Kind::kFloat:
        return ShortFloat(ReadBigEndian<float>(Take(size).data()));
      case Kind::kDouble:
        return FloatToJson(ReadBigEndian<double>(Take(size).data()));
      case Kind::kByte:
        return ReadBigEndian<std::uint8_t>(Take(size).data());
      case Kind::kBoolean: {
        const auto value = ReadBigEndian<std::int8_t>(Take(size).data());
        return value == 0 || value == 1 ? Json(value == 1) : Json(value);
      }
      default:
        return ReadInteger(Take(size).data(), size);
    }
  }

  Json Text() {
    const auto length = static_cast<std::size_t>(ReadBigEndian<std::int32_t>(Take(4).data()));
    const std::span<const std::byte> bytes = Take(length).first(length - 1);
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (IsUtf8(text)) return text;
    return Json{{"base64", ToBase64(bytes)}};
  }

  std::span<const std::byte> Take(std::size_t size) {
    at_ += size;
    return {at_ - size, size};
  }

  const std::byte* at_;
};

}  // namespace

Json ToJson(const Struct& type, std::span<const std::byte> encoded) {
  const WalkResult result = Walk(type, encoded);
  if (!result) {
    throw MessageError(fmt::format("{}: byte {} of {}: {}", type.full_name, result.offset, encoded.size(),
                                   Sentence(result.error)));
  }
  return Printer(encoded.data() + 8).Body(type);
}

}  // namespace priamos::bus
