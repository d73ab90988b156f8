#pragma once

#include <memory>
#include <string>

#include "common/input/section_place.hpp"
#include "radio/file_store.hpp"

namespace priamos::radio {

/// The files in which one end of a link keeps its memory, as configured.
struct StateFiles {
  std::string file;
  std::string fast_file;  ///< empty: none
  std::string key_file;   ///< of the link; empty: none
  SectionPlace place{};   ///< where they are named, for errors
  std::string end;        ///< side and address: another end's state is not this one's
};

/// Opens them. Saving replaces a file, so one that holds anything but a state is refused, and one that
/// another process uses. Throws ConfigError with the place of the key.
std::unique_ptr<FileStore> OpenStateFiles(const StateFiles& files);

}  // namespace priamos::radio
