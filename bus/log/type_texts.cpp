#include "bus/log/type_texts.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

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
  if (fingerprint == TypeTextType().fingerprint || !seen_.insert(fingerprint).second) return {};
  const Struct* type = find_(fingerprint);
  const auto parts = type == nullptr ? std::vector<std::string>() : PartsOf(FormatLcm(*type));
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
  if (!Walk(TypeTextType(), bytes) || open_.size() + texts_.size() >= kMostTypes) return true;
  const Json message = ToJson(TypeTextType(), bytes);
  const Key key(message["fingerprint"].get<std::int64_t>(), message["parts"].get<std::int64_t>());
  const auto part = message["part"].get<std::int64_t>();
  const bool known = Find(static_cast<std::uint64_t>(key.first)) != nullptr;
  if (known || part < 0 || part >= key.second || !message["text"].is_string()) return true;
  const auto& text = message["text"].get_ref<const std::string&>();
  if (text_bytes_ + text.size() > kMostTextBytes) return true;
  auto& parts = open_[key];
  text_bytes_ += parts.try_emplace(part, text).second ? text.size() : 0;
  if (std::cmp_less(parts.size(), key.second)) return true;
  std::string whole;
  for (const auto& [number, piece] : parts) whole += piece;
  open_.erase(key);
  Learn(whole);
  return true;
}

/// Whatever the message claims: a text defines the types that are in it.
void LogTypes::Learn(const std::string& text) {
  std::vector<std::string> problems;
  const Schema& schema = texts_.emplace_back(std::vector<Schema::Source>{{"the log", text}}, problems);
  ValueCount values;
  for (const Struct* type : schema.All())
    if (values.Of(*type) <= kMostValues) defined_.try_emplace(type->fingerprint, type);
}

const Struct* LogTypes::Find(std::uint64_t fingerprint) const {
  if (const Struct* type = given_ == nullptr ? nullptr : given_->Find(fingerprint)) return type;
  const auto at = defined_.find(fingerprint);
  return at == defined_.end() ? nullptr : at->second;
}

}  // namespace priamos::bus
