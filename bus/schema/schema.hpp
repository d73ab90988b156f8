#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// All types known to a process: nested types resolved, LCM's fingerprints computed. The Structs it hands
/// out live as long as the Schema (also when it is moved), so it must outlive what was built from them.
class Schema {
 public:
  /// The text of one .lcm file and what to call it in messages.
  struct Source {
    std::string file;
    std::string text;
  };

  /// Reads all types of `sources`. Throws SchemaError for the first type that cannot be taken: unreadable,
  /// defined twice in different ways, or with a nested type that nobody defines.
  explicit Schema(const std::vector<Source>& sources);
  /// Reads the types of `sources` that can be taken; each refused type adds one sentence to `problems`, the
  /// cause before what follows from it.
  Schema(const std::vector<Source>& sources, std::vector<std::string>& problems);

  /// Schema from a range of elements with members `file` and `text`, such as priamos::EmbeddedTypes().
  template <class Texts>
  static Schema FromTexts(const Texts& texts) {
    std::vector<Source> sources;
    sources.reserve(std::size(texts));
    for (const auto& t : texts) sources.push_back({t.file, t.text});
    return Schema(sources);
  }

  /// The type with this fingerprint; of several equal ones the first by name. nullptr when unknown.
  const Struct* Find(std::uint64_t fingerprint) const;
  /// The type of this full name, "package.name", or of this name without package when only one has it.
  const Struct* Find(std::string_view name) const;
  /// Type of an encoded message, by the fingerprint it begins with; nullptr when unknown.
  const Struct* Of(std::span<const std::byte> bytes) const;
  /// All types, ordered by full name.
  std::vector<const Struct*> All() const;
  /// Whether a type of this name, full or without package, was read and refused.
  bool Refused(std::string_view name) const;

 private:
  using Types = std::map<std::string, std::unique_ptr<Struct>, std::less<>>;
  void Build(const std::vector<Source>& sources, std::vector<std::string>* problems);
  void Insert(Struct type, std::vector<std::string>* problems);
  void Refuse(const std::string& name, const std::string& sentence, std::vector<std::string>* problems);
  void RemoveIncomplete(std::vector<std::string>* problems);
  void ComputeFingerprints(std::vector<std::string>* problems);

  Types types_;
  std::set<std::string, std::less<>> refused_;  ///< full names
  std::set<std::string> ambiguous_;             ///< those defined in different ways
  std::unordered_map<std::uint64_t, const Struct*> by_fingerprint_;
};

/// Fingerprint of an encoded message, its first 8 bytes, big endian; 0 when there are fewer.
std::uint64_t FingerprintOf(const void* data, std::size_t size);

/// The largest encoding of `type` in bytes, fingerprint included, when every variable array and string keeps
/// its `@max` (or the `@range` of its count): nullopt when one of them has none, or the type contains itself.
std::optional<std::size_t> MaxEncodedSize(const Struct& type);

/// Largest count of dimension `index` of `field`: the size of a constant one; for a variable one `@max` of
/// the array or the upper end of the count's `@range`, the smaller one; nullopt when there is neither.
std::optional<std::int64_t> MaxCount(const Struct& type, const Field& field, std::size_t index);

/// Largest length of a string field in bytes, without LCM's terminating zero; nullopt without `@max`.
std::optional<std::int64_t> MaxTextLength(const Field& field);

}  // namespace priamos::bus
