#pragma once

#include <string>

#include "bus/radio/link_state.hpp"

namespace priamos::radio {

/// Keeps an end's state in one file, which is replaced as a whole: a crash at any moment leaves the old or
/// the new state. Saving throws std::runtime_error when the disk is full or cannot be written: a link that
/// cannot remember its counters must not go on.
class FileStore : public bus::radio::StateStore {
 public:
  explicit FileStore(std::string path) : path_(std::move(path)) {}
  std::optional<std::vector<std::byte>> Load() override;
  void Save(std::span<const std::byte> state, bool durable) override;

 private:
  std::string path_;
};

}  // namespace priamos::radio
