#include "bus/log/type_texts.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/json.hpp"
#include "bus/schema/lcm_format.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kPartBytes = 1200;
constexpr std::size_t kMostParts = 32767;
/// Most values of one message that need no byte of it: structs without fields, in arrays and nested.
constexpr std::uint64_t kMostValues = 100'000;

/// lcmtypes/type_text_t.lcm without its comments: a reader of logs needs no other type of ours.
const Struct& TypeTextType() {
  static const Schema schema({Schema::Source{"type_text_t.lcm", R"(package priamos;
    struct type_text_t {
      int64_t utime;
      int64_t fingerprint;
      int16_t part;
      int16_t parts;
      string text;
    })"}});
  static const Struct& type = *schema.All().front();
  return type;
}

/// A message of type_text_t.
struct TypeTextPart {
  std::uint64_t fingerprint;
  std::int64_t part, parts;
  std::string text;  ///< bytes: the comments of old files may be in Latin-1
};

/// Reads a message that obeys Walk.
TypeTextPart ReadTypeText(std::span<const std::byte> bytes) {
  constexpr std::size_t kFingerprint = 16, kPart = 24, kParts = 26, kText = 32, kEnd = 1;
  return {ReadBigEndian<std::uint64_t>(bytes.data() + kFingerprint),
          ReadBigEndian<std::int16_t>(bytes.data() + kPart),
          ReadBigEndian<std::int16_t>(bytes.data() + kParts),
          std::string(reinterpret_cast<const char*>(bytes.data()) + kText, bytes.size() - kText - kEnd)};
}

/// Where a part ends that begins at `begin`: not within a character of UTF-8.
std::size_t EndOfPart(const std::string& text, std::size_t begin) {
  std::size_t end = std::min(text.size(), begin + kPartBytes);
  const auto continues = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
  };
  for (std::size_t at = end; at < text.size() && at > begin && end - at < 4; --at)
    if (!continues(at)) return at;
  return end;
}

std::vector<std::string> PartsOf(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = EndOfPart(text, at);
    parts.push_back(text.substr(at, end - at));
    at = end;
  }
  return parts;
}

/// Number of values in every message of a type, its arrays of variable size left out; a few hundred bytes of
/// text may define structs that hold billions of empty ones.
class ValueCount {
 public:
  /// At most a little more than kMostValues.
  std::uint64_t Of(const Struct& type) {
    const auto [at, added] = known_.try_emplace(&type, 1);
    if (!added) return at->second;
    std::uint64_t count = 1;
    for (const Field& field : type.fields) {
      std::uint64_t elements = field.type == nullptr ? 1 : Of(*field.type);
      for (const Dimension& dimension : field.dims)
        if (!dimension.variable)
          elements = std::min(kMostValues + 1, elements * static_cast<std::uint64_t>(dimension.size));
      count = std::min(kMostValues + 1, count + elements);
    }
    return known_[&type] = count;
  }

 private:
  std::map<const Struct*, std::uint64_t> known_;
};

}  // namespace

bool IsTypeText(std::span<const std::byte> bytes) {
  return FingerprintOf(bytes.data(), bytes.size()) == TypeTextType().fingerprint;
}

std::vector<std::vector<std::byte>> TypeScribe::TextsBefore(std::span<const std::byte> bytes,
                                                            std::int64_t utime) {
  const std::uint64_t fingerprint = FingerprintOf(bytes.data(), bytes.size());
  if (fingerprint == TypeTextType().fingerprint || seen_.contains(fingerprint)) return {};
  const Struct* type = find_(bytes);
  if (type == nullptr) return {};
  seen_.insert(fingerprint);
  const auto parts = PartsOf(FormatLcm(*type));
  if (parts.size() > kMostParts) return {};
  std::vector<std::vector<std::byte>> messages;
  for (std::size_t i = 0; i < parts.size(); ++i)
    messages.push_back(FromJson(TypeTextType(), Json{{"utime", utime},
                                                     {"fingerprint", static_cast<std::int64_t>(fingerprint)},
                                                     {"part", i},
                                                     {"parts", parts.size()},
                                                     {"text", parts[i]}}));
  return messages;
}

bool LogTypes::Take(std::span<const std::byte> bytes) {
  if (!IsTypeText(bytes)) return false;
  if (!Walk(TypeTextType(), bytes)) return true;
  TypeTextPart message = ReadTypeText(bytes);
  if (Known(message.fingerprint) != nullptr || message.part < 0 || message.part >= message.parts) return true;
  const auto [at, added] = claimed_.try_emplace(message.fingerprint);
  if (added) order_.push_back(message.fingerprint);
  text_bytes_ -= at->second.bytes();
  at->second.Add(message.part, message.parts, std::move(message.text));
  text_bytes_ += at->second.bytes();
  while (text_bytes_ > kMostTextBytes || claimed_.size() > kMostTypes) Forget(order_.front());
  return true;
}

const Struct* LogTypes::Of(std::span<const std::byte> bytes) {
  const std::uint64_t fingerprint = FingerprintOf(bytes.data(), bytes.size());
  if (const Struct* type = Known(fingerprint)) return type;
  const auto claimed = claimed_.find(fingerprint);
  if (claimed == claimed_.end() || chosen_.size() >= kMostTypes) return nullptr;
  const Struct* type = Choose(claimed->second, bytes);
  if (type != nullptr) chosen_[fingerprint] = type;
  Forget(fingerprint);
  return type;
}

const Struct* LogTypes::Known(std::uint64_t fingerprint) const {
  if (const Struct* type = given_ == nullptr ? nullptr : given_->Find(fingerprint)) return type;
  const auto at = chosen_.find(fingerprint);
  return at == chosen_.end() ? nullptr : at->second;
}

const Struct* LogTypes::Choose(const ClaimedTexts& claimed, std::span<const std::byte> bytes) {
  std::optional<Schema> best;
  const auto obeyed = [&](const std::string& text) {
    std::vector<std::string> problems;
    Schema schema({{"the log", text}}, problems);
    const Struct* type = schema.Find(FingerprintOf(bytes.data(), bytes.size()));
    if (type == nullptr || ValueCount().Of(*type) > kMostValues) return false;
    const bool obeys{Walk(*type, bytes)};
    if (obeys || !best) best = std::move(schema);
    return obeys;
  };
  claimed.AnyText(obeyed);
  if (!best) return nullptr;
  schemas_.push_back(std::move(*best));
  return schemas_.back().Find(FingerprintOf(bytes.data(), bytes.size()));
}

void LogTypes::Forget(std::uint64_t fingerprint) {
  text_bytes_ -= claimed_.at(fingerprint).bytes();
  claimed_.erase(fingerprint);
  order_.erase(std::find(order_.begin(), order_.end(), fingerprint));
}

}  // namespace priamos::bus
