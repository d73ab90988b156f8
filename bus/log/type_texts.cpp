#include "bus/log/type_texts.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/json.hpp"
#include "bus/schema/lcm_format.hpp"
#include "bus/schema/lcm_parser.hpp"
#include "bus/schema/walk.hpp"
#include "common/input/utf8.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kPartBytes = 1200;

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

std::vector<std::string> PartsOf(std::string_view text) {
  std::vector<std::string> parts;
  for (; !text.empty(); text.remove_prefix(parts.back().size()))
    parts.emplace_back(CutUtf8(text, kPartBytes));
  return parts;
}

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
  const std::string text = FormatLcm(*type);
  if (text.size() > LogTypes::kMostBytesOfText) return {};  // no reader would take it
  const auto parts = PartsOf(text);
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
  if (at->second.NeedsProof()) Prove(message.fingerprint, at->second);
  at->second.Add(message.part, message.parts, std::move(message.text));
  text_bytes_ += at->second.bytes();
  while (text_bytes_ > kMostTextBytes || claimed_.size() > kMostTypes) Forget(order_.front());
  return true;
}

const Struct* LogTypes::Of(std::span<const std::byte> bytes) {
  const std::uint64_t fingerprint = FingerprintOf(bytes.data(), bytes.size());
  if (const Struct* type = Known(fingerprint)) return type;
  const auto claimed = claimed_.find(fingerprint);
  if (claimed == claimed_.end() || chosen_.size() >= kMostTypes || chosen_bytes_ > kMostTextBytes)
    return nullptr;
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

/// Null when it defines nothing, or more than a recorder would write.
std::shared_ptr<const Schema> LogTypes::ReadText(const std::string& text) {
  if (text.size() > kMostBytesOfText) return nullptr;
  std::vector<TypeProblem> unreadable;
  const std::size_t types = ParseLcm("the log", text, unreadable).size();
  if (types == 0 || types > kMostTypesOfText) return nullptr;
  std::vector<std::string> problems;
  return std::make_shared<const Schema>(std::vector<Schema::Source>{{"the log", text}}, problems);
}

/// Each text is read once, also when it is claimed to define many types.
std::shared_ptr<const Schema> LogTypes::SchemaOf(const std::string& text) {
  const auto known = read_.find(text);
  if (known != read_.end()) return known->second;
  if (read_.size() == kMostReadTexts) read_.clear();
  return read_[text] = ReadText(text);
}

const Struct* LogTypes::Choose(const ClaimedTexts& claimed, std::span<const std::byte> bytes) {
  std::shared_ptr<const Schema> best;
  const auto obeyed = [&](const std::string& text) {
    auto schema = SchemaOf(text);
    const Struct* type = schema ? schema->Of(bytes) : nullptr;
    if (type == nullptr) return false;
    const bool obeys{Walk(*type, bytes)};
    if (obeys || !best) best = std::move(schema);
    return obeys;
  };
  claimed.AnyText(obeyed);
  if (!best) return nullptr;
  chosen_bytes_ += claimed.bytes();
  schemas_.push_back(best);
  return best->Of(bytes);
}

void LogTypes::Prove(std::uint64_t fingerprint, ClaimedTexts& claimed) {
  claimed.Keep([&](const std::string& text) {
    if (proof_bytes_ + text.size() > kMostTextBytes) return false;
    proof_bytes_ += text.size();
    const auto schema = SchemaOf(text);
    return schema != nullptr && schema->Find(fingerprint) != nullptr;
  });
}

void LogTypes::Forget(std::uint64_t fingerprint) {
  text_bytes_ -= claimed_.at(fingerprint).bytes();
  claimed_.erase(fingerprint);
  order_.erase(std::find(order_.begin(), order_.end(), fingerprint));
}

}  // namespace priamos::bus
