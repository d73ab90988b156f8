#include "radio/state_files.hpp"

#include <fmt/format.h>

#include <string_view>

#include "common/config.hpp"
#include "common/input/quoted.hpp"
#include "common/input/regular_file.hpp"
#include "radio/key_file.hpp"

namespace priamos::radio {
namespace {

void RequireState(const std::string& path, const std::string& place) {
  const RegularFile file(path);
  if (file.missing()) return;
  if (!file.open())
    throw ConfigError(fmt::format("{}: expected a file, or the name of none yet, got {}, {}", place,
                                  file.problem(), Quoted(path)));
  const auto content = file.Read(kMostStateBytes);
  if (!content)
    throw ConfigError(fmt::format(
        "{}: expected the radio's state, a file of at most {} bytes, got a longer one, or one that cannot be "
        "read, {}",
        place, kMostStateBytes, Quoted(path)));
  if (!IsStateFile(*content))
    throw ConfigError(fmt::format(
        "{}: expected a state of the radio, or the name of no file yet, got a file that holds something "
        "else, {}: name another one; it is left as it is",
        place, Quoted(path)));
}

void RequireOther(const std::string& path, const std::string& other, std::string_view what,
                  const std::string& place) {
  if (!other.empty() && FileOf(path) == FileOf(other))
    throw ConfigError(
        fmt::format("{}: expected a file of its own, got that of {}, {}", place, what, Quoted(path)));
}

}  // namespace

std::unique_ptr<FileStore> OpenStateFiles(const StateFiles& files) {
  const std::string place = files.place.Of("state_file"), fast_place = files.place.Of("fast_state_file");
  RequireOther(files.file, files.key_file, "key_file", place);
  if (!files.key_file.empty()) RequireOther(files.file, NextKeyFile(files.key_file), "the next key", place);
  RequireState(files.file, place);
  if (!files.fast_file.empty()) {
    RequireOther(files.fast_file, files.file, "state_file", fast_place);
    RequireState(files.fast_file, fast_place);
  }
  const std::string boot = BootId();
  auto store =
      std::make_unique<FileStore>(files.file, files.fast_file, boot.empty() ? boot : boot + ":" + files.end);
  if (const std::string used = store->in_use(); !used.empty())
    throw ConfigError(
        fmt::format("{}: expected a file of its own, got one that another end of a link uses, {}",
                    used == files.file ? place : fast_place, Quoted(used)));
  return store;
}

}  // namespace priamos::radio
