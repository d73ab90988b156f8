#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bus/log/claimed_texts.hpp"
#include "bus/schema/schema.hpp"

namespace priamos::bus {

/// Channel of a log on which its types are defined, as messages of type_text_t. Readers go by the type of the
/// message: a channel may have been renamed.
inline constexpr std::string_view kTypeText = "TYPE_TEXT";

/// Whether a message defines a type.
bool IsTypeText(std::span<const std::byte> bytes);

/// What a recorder writes into a log before the first message of each type: the type's definition.
class TypeScribe {
 public:
  /// Finds the type of a message; nullptr when it is unknown, and then nothing is written.
  using Finder = std::function<const Struct*(std::span<const std::byte> bytes)>;

  explicit TypeScribe(Finder find) : find_(std::move(find)) {}

  /// The messages that define the type of the message `bytes`, recorded at `utime`: none but the first time.
  std::vector<std::vector<std::byte>> TextsBefore(std::span<const std::byte> bytes, std::int64_t utime);
  /// Begins anew, for another file.
  void Restart() { seen_.clear(); }

 private:
  Finder find_;
  std::set<std::uint64_t> seen_;
};

/// The types of a log: those that are given, and those that it defines itself, in whatever version. They
/// become known as the log is read.
///
/// A log may hold definitions that are damaged or forged, on a live bus by anybody. A recorder writes the
/// genuine one directly before the first message of the type: so the choice is made at that message, the
/// newest text goes first, it has to define a type of that message's fingerprint, and better one that the
/// message obeys. What comes later changes nothing. Of texts that many others follow before the message, as
/// in a log that another recorder wrote, one that defines its fingerprint is kept.
class LogTypes {
 public:
  static constexpr std::size_t kMostTypes = 4096;  ///< that one log defines
  /// Kept of texts whose messages have not come; and of those whose messages have.
  static constexpr std::size_t kMostTextBytes = 16 << 20;
  static constexpr std::size_t kMostTypesOfText = 256;  ///< in one text: a type with all types in it
  static constexpr std::size_t kMostBytesOfText = 1 << 18;

  /// `given` must outlive it; null: only those of the log.
  explicit LogTypes(const Schema* given) : given_(given) {}

  /// Learns from a message of the log. False when it defines no type.
  bool Take(std::span<const std::byte> bytes);
  /// Type of an encoded message; nullptr while it is unknown. The Struct lives as long as this object.
  const Struct* Of(std::span<const std::byte> bytes);

 private:
  const Struct* Known(std::uint64_t fingerprint) const;
  static std::shared_ptr<const Schema> ReadText(const std::string& text);
  std::shared_ptr<const Schema> SchemaOf(const std::string& text);
  const Struct* Choose(const ClaimedTexts& claimed, std::span<const std::byte> bytes);
  void Prove(std::uint64_t fingerprint, ClaimedTexts& claimed);
  void Forget(std::uint64_t fingerprint);

  const Schema* given_;
  std::unordered_map<std::uint64_t, ClaimedTexts> claimed_;  ///< texts whose messages have not come
  std::deque<std::uint64_t> order_;                          ///< of claimed_: the oldest first
  static constexpr std::size_t kMostReadTexts = 64;
  std::map<std::string, std::shared_ptr<const Schema>> read_;  ///< texts of late; null: not to be used
  std::vector<std::shared_ptr<const Schema>> schemas_;         ///< of the types in chosen_
  std::unordered_map<std::uint64_t, const Struct*> chosen_;
  std::size_t text_bytes_ = 0, chosen_bytes_ = 0;
  std::size_t proof_bytes_ = 0;  ///< of texts that were read for proofs, kMostTextBytes at most
};

}  // namespace priamos::bus
