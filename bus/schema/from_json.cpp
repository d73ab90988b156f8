#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/json.hpp"
#include "bus/schema/text_codec.hpp"
#include "bus/schema/walk.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::bus {
namespace {

std::string Shortened(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > 40) text.resize(40);
  return text;
}

class Writer {
 public:
  explicit Writer(const Struct& type) : path_(type.full_name) { Put(type.fingerprint); }

  void Body(const Struct& type, const Json& json) {
    if (!json.is_object()) Refuse("an object", json);
    if (++depth_ > kMaxWalkDepth) throw MessageError(path_ + ": structs are nested too deeply");
    RefuseUnknownKeys(type, json);
    std::vector<std::int64_t> counts(type.fields.size(), 0);
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      const Field& field = type.fields[i];
      const Scope scope(path_, "." + field.name);
      const Json value = FieldValue(type, i, json);
      if (IsInteger(field.kind) && field.dims.empty()) counts[i] = Integer(field.kind, value);
      Level(type, field, 0, counts, value);
    }
    --depth_;
  }

  std::vector<std::byte> Finish() { return std::move(bytes_); }

 private:
  /// Where in the message we are, for error sentences; "type.a[2].b".
  class Scope {
   public:
    Scope(std::string& path, const std::string& part) : path_(path), size_(path.size()) { path_ += part; }
    ~Scope() { path_.resize(size_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    std::string& path_;
    std::size_t size_;
  };

  void RefuseUnknownKeys(const Struct& type, const Json& json) const {
    for (const auto& [key, value] : json.items()) {
      const auto same = [&key = key](const Field& field) { return field.name == key; };
      if (std::none_of(type.fields.begin(), type.fields.end(), same)) {
        std::vector<std::string> known;
        for (const Field& field : type.fields) known.push_back(field.name);
        throw MessageError(
            fmt::format("{}.{}: there is no such field{}", path_, key, NearestText(key, known)));
      }
    }
  }

  /// What the object has for field `index`, or the length of the arrays it counts.
  Json FieldValue(const Struct& type, std::size_t index, const Json& json) const {
    const auto given = json.find(type.fields[index].name);
    if (given != json.end()) return *given;
    for (const Field& field : type.fields) {
      for (std::size_t level = 0; level < field.dims.size(); ++level) {
        const Dimension& dimension = field.dims[level];
        const auto array = json.find(field.name);
        if (dimension.variable && dimension.count_field == index && array != json.end()) {
          return Extent(*array, level);
        }
      }
    }
    throw MessageError(path_ + ": the field is missing");
  }

  static std::size_t Extent(const Json& array, std::size_t level) {
    if (array.is_array()) {
      if (level == 0) return array.size();
      return array.empty() ? 0 : Extent(array.front(), level - 1);
    }
    if (!array.is_string() || level > 0) return 0;
    const auto bytes = FromBase64(array.get_ref<const std::string&>());
    return bytes ? bytes->size() : 0;
  }

  void Level(const Struct& type, const Field& field, std::size_t level,
             const std::vector<std::int64_t>& counts, const Json& json) {
    if (level == field.dims.size()) return Value(field, json);
    const Dimension& dimension = field.dims[level];
    const std::int64_t n = dimension.variable ? counts[dimension.count_field] : dimension.size;
    const auto expected = [&] {
      return dimension.variable
                 ? fmt::format("{} elements, as {} says", n, type.fields[dimension.count_field].name)
                 : fmt::format("{} elements", n);
    };
    if (field.kind == Kind::kByte && level + 1 == field.dims.size()) {
      const auto raw = json.is_string() ? FromBase64(json.get_ref<const std::string&>()) : std::nullopt;
      if (!raw) Refuse("base64", json);
      if (std::cmp_not_equal(raw->size(), n)) Refuse(expected(), json);
      bytes_.insert(bytes_.end(), raw->begin(), raw->end());
      return;
    }
    if (!json.is_array()) Refuse("an array", json);
    if (std::cmp_not_equal(json.size(), n)) Refuse(expected(), json);
    for (std::size_t i = 0; i < json.size(); ++i) {
      const Scope scope(path_, fmt::format("[{}]", i));
      Level(type, field, level + 1, counts, json[i]);
    }
  }

  void Value(const Field& field, const Json& json) {
    switch (field.kind) {
      case Kind::kStruct:
        return Body(*field.type, json);
      case Kind::kString:
        return Text(json);
      case Kind::kFloat:
        return PutFloat(json);
      case Kind::kDouble:
        return Put(Real(json));
      case Kind::kByte:
        return Put(static_cast<std::uint8_t>(Between(json, 0, 255)));
      case Kind::kBoolean:
        return Put(static_cast<std::int8_t>(json.is_boolean() ? json.get<bool>() : Between(json, -128, 127)));
      default:
        break;
    }
    std::byte word[8];
    const std::size_t size = WireSize(field.kind);
    WriteInteger(word, Integer(field.kind, json), size);
    bytes_.insert(bytes_.end(), word, word + size);
  }

  std::int64_t Integer(Kind kind, const Json& json) const {
    const int bits = static_cast<int>(8 * WireSize(kind));
    const std::int64_t most = std::numeric_limits<std::int64_t>::max() >> (64 - bits);
    return Between(json, -most - 1, most);
  }

  std::int64_t Between(const Json& json, std::int64_t low, std::int64_t high) const {
    const auto wanted = [&] { return fmt::format("a whole number from {} to {}", low, high); };
    if (json.is_number_float()) {
      const double value = json.get<double>();
      // Doubles of 2^63 and above are no int64_t; below, the conversion is exact.
      if (std::trunc(value) != value || !(std::abs(value) < 0x1p63)) Refuse(wanted(), json);
      return InRange(static_cast<std::int64_t>(value), low, high, json);
    }
    if (!json.is_number_integer()) Refuse(wanted(), json);
    if (json.is_number_unsigned() && json.get<std::uint64_t>() > static_cast<std::uint64_t>(high))
      Refuse(wanted(), json);
    return InRange(json.get<std::int64_t>(), low, high, json);
  }

  std::int64_t InRange(std::int64_t value, std::int64_t low, std::int64_t high, const Json& json) const {
    if (value < low || value > high) Refuse(fmt::format("a whole number from {} to {}", low, high), json);
    return value;
  }

  double Real(const Json& json) const {
    if (json.is_number()) return json.get<double>();
    if (json == "NaN") return std::numeric_limits<double>::quiet_NaN();
    if (json == "Infinity") return std::numeric_limits<double>::infinity();
    if (json == "-Infinity") return -std::numeric_limits<double>::infinity();
    Refuse("a number", json);
  }

  void PutFloat(const Json& json) {
    // Half a step above the largest float: what is written with eight digits may lie above it and rounds to
    // it.
    constexpr double kTooLarge = 0x1.ffffffp127;
    const double value = Real(json);
    if (std::isfinite(value) && std::abs(value) >= kTooLarge) Refuse("a number that fits into a float", json);
    constexpr double kMost = std::numeric_limits<float>::max();
    Put(static_cast<float>(std::isfinite(value) ? std::clamp(value, -kMost, kMost) : value));
  }

  void Text(const Json& json) {
    if (json.is_string()) return PutText(std::as_bytes(std::span(json.get_ref<const std::string&>())));
    if (json.is_object() && json.size() == 1 && json.contains("base64") && json["base64"].is_string()) {
      if (const auto raw = FromBase64(json["base64"].get_ref<const std::string&>())) return PutText(*raw);
    }
    Refuse("a string", json);
  }

  void PutText(std::span<const std::byte> text) {
    if (text.size() >= std::numeric_limits<std::int32_t>::max())
      throw MessageError(path_ + ": the text is too long");
    Put(static_cast<std::int32_t>(text.size() + 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(std::byte{0});
  }

  template <class T>
  void Put(T value) {
    bytes_.resize(bytes_.size() + sizeof(T));
    WriteBigEndian(bytes_.data() + bytes_.size() - sizeof(T), value);
  }

  [[noreturn]] void Refuse(std::string_view expected, const Json& json) const {
    throw MessageError(fmt::format("{}: expected {}, got {}", path_, expected, Shortened(json)));
  }

  std::string path_;
  std::vector<std::byte> bytes_;
  int depth_ = 0;
};

}  // namespace

std::vector<std::byte> FromJson(const Struct& type, const Json& json) {
  Writer writer(type);
  writer.Body(type, json);
  std::vector<std::byte> bytes = writer.Finish();
  if (const WalkResult result = Walk(type, bytes); !result) {
    throw MessageError(fmt::format("{}: {}", type.full_name, Sentence(result.error)));
  }
  return bytes;
}

}  // namespace priamos::bus
