#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace priamos {

/// Where a section of a configuration was read, for errors that are found after the reading. Cheap to copy;
/// where something was read makes it no other configuration.
class SectionPlace {
 public:
  /// Place of each key, `file:line:section.key`.
  using Keys = std::map<std::string, std::string, std::less<>>;

  /// What was read from no file.
  SectionPlace() = default;
  /// `before`: what stands before a key that the section leaves out, `file:line:section.`. `begin`: see
  /// Begin().
  SectionPlace(std::string before, std::string begin, Keys keys)
      : read_(std::make_shared<const Read>(Read{std::move(before), std::move(begin), std::move(keys)})) {}

  /// `file:line:section.key`: where `key` stands, or the section begins that leaves it out. The key alone of
  /// what was read from no file.
  std::string Of(std::string_view key) const {
    if (!read_) return std::string(key);
    const auto at = read_->keys.find(key);
    return at != read_->keys.end() ? at->second : read_->before + std::string(key);
  }

  /// `file:line: ` of the line where the section begins; empty for what was read from no file.
  std::string Begin() const { return read_ ? read_->begin : ""; }

  friend bool operator==(const SectionPlace&, const SectionPlace&) { return true; }

 private:
  struct Read {
    std::string before, begin;
    Keys keys;
  };
  std::shared_ptr<const Read> read_;
};

/// An archive that reads a file.
class PlaceSource {
 public:
  virtual ~PlaceSource() = default;
  /// The section that is being read.
  virtual SectionPlace PlaceOfSection() const = 0;
};

/// Notes where the section that `archive` visits was read. One that reads no file, but prints or changes what
/// was read, leaves `place` as it is.
template <class Archive>
void NotePlace(const Archive& archive, SectionPlace& place) {
  if (const auto* source = dynamic_cast<const PlaceSource*>(&archive)) place = source->PlaceOfSection();
}

}  // namespace priamos
