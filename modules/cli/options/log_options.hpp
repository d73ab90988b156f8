#pragma once

#include <fstream>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "bus/log/log_event.hpp"
#include "bus/log/log_selection.hpp"
#include "cli/options/bus_options.hpp"
#include "cli/options/new_file.hpp"

namespace priamos::cli {

/// --channels, --without, --rename, --from and --to as a person types them.
struct SelectionOptions {
  std::vector<std::string> only, without;
  std::vector<std::string> rename;  ///< A=B
  double from_s = 0, to_s = -1;     ///< since the log's first event; negative: to the end
};

void AddSelectionOptions(CLI::App& verb, SelectionOptions& options);

/// What the options select. `log` is read for the time at which it begins. A channel asked for by name that
/// `log` does not have is reported on standard error, with the nearest names that it has. Throws
/// std::runtime_error with a sentence for a --rename that cannot be read or does not fit the log.
bus::LogSelection SelectionOf(const SelectionOptions& options, const std::string& log);

/// Checks that `out` may be written as a new file. Throws std::runtime_error when it exists (unless `force`),
/// is the very file that is being read, is no regular file (nor /dev/null or the like, which no one waits
/// for), or is "-", which elsewhere means standard output.
void RequireNewFile(const std::string& out, const std::string& in, bool force);

/// Whether `log` has an event that is `wanted`.
bool HasEvent(const std::string& log, const std::function<bool(const bus::LogEvent& event)>& wanted);

/// Checks that it has one, before anything takes the place of `out`. Throws
/// std::runtime_error when it has none: `purpose` completes "expected events to ...".
void RequireEvents(const std::string& log, const std::string& out, const std::string& purpose,
                   const std::function<bool(const bus::LogEvent& event)>& wanted);

/// A new file, or standard output when `out` is empty or "-". A file that is not closed was never there.
class OutputFile {
 public:
  /// Opens the output. Throws std::runtime_error as RequireNewFile does, or when the file cannot be made.
  OutputFile(const std::string& out, const std::string& in, bool force);
  std::ostream& stream();
  /// Whether it is a file, not standard output.
  bool named() const { return !name_.empty(); }
  /// Writes what is left and closes the output; returns 0. Throws std::runtime_error when not all could be
  /// written.
  int Close();

 private:
  std::string name_;
  std::optional<NewFile> place_;
  std::ofstream file_;
};

/// "1/4", "2", "max" as a factor; 0 for max. Throws std::runtime_error for anything else or beyond
/// 1/64..1000.
double ParseSpeed(const std::string& text);

}  // namespace priamos::cli
