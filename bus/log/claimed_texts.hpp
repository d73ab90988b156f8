#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace priamos::bus {

/// What a log claims to be the text of one type: parts of texts, of which some may be damaged or forged.
/// Pure.
class ClaimedTexts {
 public:
  static constexpr std::size_t kMostVersions = 8;  ///< that are kept of one part, the newest
  static constexpr std::size_t kMostTries = 64;    ///< whole texts that are put together

  /// Takes part `part` of `parts`, 0 <= part < parts.
  void Add(std::int64_t part, std::int64_t parts, std::string text);

  /// Whether the next part may push out one that no proof has seen: time for Keep.
  bool NeedsProof() const { return !proven_ && added_ - proof_at_ >= kMostVersions; }
  /// Keeps the first whole text that `proves` itself, whatever comes after it. Sees texts as AnyText does.
  void Keep(const std::function<bool(const std::string& text)>& proves);

  /// Calls `take` with whole texts until it returns true, those of the newest parts first, the one that was
  /// kept last; false when it never did. It sees at most kMostTries texts, and hardly more than eight times
  /// the bytes that are kept.
  bool AnyText(const std::function<bool(const std::string& text)>& take) const;

  /// Memory: bytes of all parts that are kept.
  std::size_t bytes() const { return bytes_; }

 private:
  using Versions = std::vector<std::string>;  ///< of one part, the newest last
  using Parts = std::map<std::int64_t, Versions>;
  struct Claim {
    Parts parts;
    std::uint64_t newest = 0;  ///< when its newest part came
  };
  struct Budget {
    std::size_t tries;
    std::size_t bytes;
  };
  static bool AnyTextOf(const Parts& parts, Budget budget,
                        const std::function<bool(const std::string& text)>& take);

  std::map<std::int64_t, Claim> by_count_;  ///< by the number of parts of the text
  std::uint64_t added_ = 0, proof_at_ = 0;
  std::optional<std::string> proven_;
  std::size_t bytes_ = 0;
};

}  // namespace priamos::bus
