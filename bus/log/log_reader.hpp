#pragma once

#include <memory>
#include <optional>
#include <span>

#include "bus/log/log_event.hpp"

namespace priamos::bus {

/// Reads LCM's log format. Damage does not end the reading: the reader goes on at the next credible event
/// and counts what it skipped. What a message carries is never taken for an event of the log, also when the
/// event around it is torn, as far as its length reaches. Only where the numbers of the recorder say that a
/// damaged length has swallowed the next events, they are taken out. A file is mapped, and what has been read
/// is given back: a log may be larger than the memory, and reading it takes 30 MB at most, and twice its
/// largest message.
class LogReader {
 public:
  /// The first place with damaged bytes, and what is there in words for `got ...`.
  struct Damage {
    std::size_t offset = 0;
    std::string_view what;
  };

  /// Opens the log file `path`. Throws std::runtime_error when it cannot be read, is no regular file, or one
  /// that the kernel makes up.
  explicit LogReader(const std::string& path);
  /// Reads from `bytes`, which must outlive the reader.
  explicit LogReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// The next whole event, or nullopt at the end.
  std::optional<LogEvent> Next();
  /// Number of bytes so far that belong to no whole event.
  std::uint64_t skipped_bytes() const { return skipped_; }
  /// Number of places so far with damaged bytes between whole events.
  std::uint64_t damaged_places() const { return damaged_places_; }
  /// nullopt: none so far.
  const std::optional<Damage>& first_damage() const { return first_damage_; }
  std::size_t size() const { return bytes_.size(); }
  /// Number of places so far that were looked at for the begin of an event: at most 3 per byte, whatever the
  /// log holds.
  std::uint64_t looked_at() const { return looked_at_; }
  /// Continues reading at LogEvent::offset of an event read before; what was skipped stays counted.
  void Seek(std::size_t offset);

 private:
  /// What is at an offset: a whole event or none, and where the reading goes on.
  struct Place {
    bool event = false;
    std::size_t next = 0;
    std::size_t looked_at = 0;  ///< number of places, to know that
  };
  struct Search {
    std::optional<std::size_t> found;
    std::size_t looked_at = 0;
  };
  Place PlaceAt(std::size_t offset) const;
  LogEvent EventAt(std::size_t offset) const;
  bool MagicAt(std::size_t offset) const;
  std::int64_t NumberAt(std::size_t offset) const;
  /// End of the event at `offset` by its header, perhaps beyond the file; nullopt if the header is not
  /// plausible.
  std::optional<std::size_t> EndOfEvent(std::size_t offset) const;
  /// What keeps the bytes at `offset` from being an event; empty: the header is plausible.
  std::string_view ProblemAt(std::size_t offset) const;
  std::string_view WhyNoEvent(std::size_t offset) const;
  std::size_t FindFollower(std::size_t begin, std::size_t end, std::int64_t number) const;
  Search FindSwallowed(std::size_t offset, std::size_t end) const;
  void GiveBack();

  std::shared_ptr<const void> mapping_;  ///< keeps the mapped file
  std::span<const std::byte> bytes_;
  std::size_t offset_ = 0;
  std::size_t given_back_ = 0;  ///< up to here the mapped file is not in memory
  std::uint64_t skipped_ = 0;
  std::uint64_t damaged_places_ = 0;
  std::uint64_t looked_at_ = 0;
  std::optional<Damage> first_damage_;
};

}  // namespace priamos::bus
