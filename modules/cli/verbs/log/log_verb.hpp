#pragma once

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "bus/log/log_reader.hpp"
#include "bus/log/log_writer.hpp"
#include "cli/options/bus_options.hpp"
#include "cli/options/counted.hpp"
#include "cli/options/new_file.hpp"
#include "cli/options/verb_setup.hpp"

namespace priamos::cli {

/// Options that several verbs of `log` have.
struct LogOptions {
  BusOptions bus;  ///< only its types
  std::string log, out;
  bool json = false, force = false;
};

/// Name of a verb of `log`, one sentence of what it does, and a command line as an example.
struct LogVerb {
  const char* name;
  const char* help;
  const char* example;
};

/// A new verb of `log` with the log that it reads as its first argument.
inline CLI::App* AddLogVerb(CLI::App& log, const LogVerb& names, LogOptions& options) {
  auto* verb = AddVerb(log, names.name, names.help);
  verb->footer(std::string("Example: ") + names.example);
  verb->add_option("log", options.log, "LCM log")->required()->check(CLI::ExistingFile);
  return verb;
}

/// The options `--json` and `--force` of a verb that writes a file.
inline void AddOutputFlags(CLI::App& verb, LogOptions& options, const char* json_help = "machine-readable") {
  verb.add_flag("--json", options.json, json_help);
  verb.add_flag("--force", options.force, "replace an existing file");
}

/// What the first damage of a log is, and where, behind `before`; empty without damage.
inline std::string FirstDamage(const std::optional<bus::LogReader::Damage>& first, const char* before) {
  return first ? fmt::format("{}first {} at byte {}", before, first->what, first->offset) : "";
}

/// What of a log that was read to its end is not in the new file, and why.
inline std::string LeftOut(const bus::LogReader& reader) {
  return fmt::format("{} with {} left out{}", Counted(reader.damaged_places(), "damaged place"),
                     Counted(reader.skipped_bytes(), "byte"), FirstDamage(reader.first_damage(), ": "));
}

/// Ends the writing of a log, and puts it in its place. Throws std::runtime_error when not all of it could be
/// written.
inline void Finish(bus::LogWriter& writer, const std::string& file, NewFile& place) {
  writer.Flush();
  if (!writer.good()) throw std::runtime_error(file + ": cannot be written: is the disk full?");
  place.Keep();
}

}  // namespace priamos::cli
