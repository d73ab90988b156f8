#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/archive.hpp"

namespace priamos {

/// One key of a configuration, as a manual lists it.
struct ConfigKey {
  std::string name;     ///< with its sections: `drive.max_speed_m_s`, `process[].module` in a list
  std::string value;    ///< default, as TOML; empty for a section or a list
  std::string meaning;  ///< unit, what it is, what it may be
};

/// Visits a configuration struct and keeps its keys in the order of its Describe; of every list one item.
std::unique_ptr<Archive> MakeKeyList(std::vector<ConfigKey>& keys);

template <class T>
std::vector<ConfigKey> KeysOf() {
  std::vector<ConfigKey> keys;
  T{}.Describe(*MakeKeyList(keys));
  return keys;
}

}  // namespace priamos
