#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "bus/log/log_event.hpp"
#include "bus/schema/json.hpp"

namespace priamos::bus {

/// A text as a cell of a table in CSV (RFC 4180), always in quotes: a quote inside is doubled.
std::string QuotedCell(const std::string& text);

/// Messages of one type as a table (RFC 4180): a column per value. Fields of nested structs and elements of
/// fixed arrays get columns of their own (`pose.x_m`, `range_m[3]`); what varies in size, an array of
/// variable length or a type that contains itself, is one column of JSON. The first two columns are the log's
/// `log_utime` and `log_number`.
class CsvTable {
 public:
  /// Table of messages of `type`, which must outlive it.
  explicit CsvTable(const Struct& type);

  void WriteHeader(std::ostream& out) const;
  /// Writes one message as a line of the table. Throws MessageError when the event's bytes are no message of
  /// the type.
  void WriteRow(std::ostream& out, const LogEvent& event) const;

 private:
  const Struct* type_;
  std::vector<std::string> columns_;
};

}  // namespace priamos::bus
