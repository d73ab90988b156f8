#pragma once

#include <deque>
#include <string>

#include "common/web/web_request.hpp"
#include "console/parameter_sheets.hpp"

namespace priamos::bus {
class Schema;
}

namespace priamos::console {

/// What the station serves: the page; the JSON schema of every type, as /types/NAME.json, from which a view
/// takes units and meanings; and once they are known the parameters of every process, as
/// /parameters/NAME.toml, those that may be changed while it runs as /parameters/NAME.json, and the names of
/// the processes in /parameters/index.json.
class StationFiles {
 public:
  explicit StationFiles(const bus::Schema& schema);
  StationFiles(const StationFiles&) = delete;
  StationFiles& operator=(const StationFiles&) = delete;

  void AddParameters(const ParameterSheets& sheets);
  const WebFiles& files() const { return files_; }

 private:
  void Add(const std::string& target, std::string_view type, std::string text);

  WebFiles files_;
  std::deque<std::string> texts_;  ///< of files that were not compiled in; they stay where they are
};

}  // namespace priamos::console
