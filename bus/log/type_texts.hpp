#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

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
  /// Finds the type of a fingerprint; nullptr when it is unknown, and then nothing is written.
  using Finder = std::function<const Struct*(std::uint64_t fingerprint)>;

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
class LogTypes {
 public:
  static constexpr std::size_t kMostTypes = 4096;          ///< that one log defines
  static constexpr std::size_t kMostTextBytes = 16 << 20;  ///< of one log

  /// `given` must outlive it; null: only those of the log.
  explicit LogTypes(const Schema* given) : given_(given) {}

  /// Learns from a message of the log. False when it defines no type.
  bool Take(std::span<const std::byte> bytes);
  /// Type with this fingerprint; nullptr while it is unknown. The Struct lives as long as this object.
  const Struct* Find(std::uint64_t fingerprint) const;
  /// Type of an encoded message.
  const Struct* Of(std::span<const std::byte> bytes) const {
    return Find(FingerprintOf(bytes.data(), bytes.size()));
  }

 private:
  using Key = std::pair<std::int64_t, std::int64_t>;  ///< fingerprint and number of parts
  void Learn(const std::string& text);

  const Schema* given_;
  std::map<Key, std::map<std::int64_t, std::string>> open_;  ///< texts of which not all parts have come
  std::vector<Schema> texts_;
  std::unordered_map<std::uint64_t, const Struct*> defined_;  ///< the types of texts_
  std::size_t text_bytes_ = 0;
};

}  // namespace priamos::bus
