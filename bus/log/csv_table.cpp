#include "bus/log/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "bus/schema/fingerprint.hpp"
#include "bus/schema/json_text.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kMostColumns = 4096;

bool VariesInSize(const Field& field) {
  return std::any_of(field.dims.begin(), field.dims.end(), [](const Dimension& d) { return d.variable; }) ||
         (field.kind == Kind::kByte && !field.dims.empty()) ||
         (field.kind == Kind::kStruct && ReachesRecursion(*field.type));
}

void AddColumns(const Struct& type, const std::string& prefix, std::vector<std::string>& columns);

void AddElements(const Field& field, std::size_t level, const std::string& name,
                 std::vector<std::string>& columns) {
  if (level < field.dims.size()) {
    for (std::int64_t i = 0; i < field.dims[level].size && columns.size() <= kMostColumns; ++i)
      AddElements(field, level + 1, fmt::format("{}[{}]", name, i), columns);
  } else if (field.kind == Kind::kStruct) {
    AddColumns(*field.type, name + ".", columns);
  } else {
    columns.push_back(name);
  }
}

void AddColumns(const Struct& type, const std::string& prefix, std::vector<std::string>& columns) {
  for (const Field& field : type.fields) {
    if (VariesInSize(field)) {
      columns.push_back(prefix + field.name);
    } else {
      AddElements(field, 0, prefix + field.name, columns);
    }
  }
}

void WriteCell(std::ostream& out, const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    out << text;
    return;
  }
  out << QuotedCell(text);
}

std::string TextOf(const Json& value) {
  return value.is_string() ? value.get<std::string>() : JsonText(value);
}

/// Writes the cells in the order in which AddColumns named them.
class RowWriter {
 public:
  explicit RowWriter(std::ostream& out) : out_(out) {}

  void Body(const Struct& type, const Json& json) {
    for (const Field& field : type.fields) {
      const Json& value = json.at(field.name);
      VariesInSize(field) ? Cell(value) : Element(field, 0, value);
    }
  }

 private:
  void Element(const Field& field, std::size_t level, const Json& value) {
    if (level < field.dims.size()) {
      for (const Json& element : value) Element(field, level + 1, element);
    } else {
      field.kind == Kind::kStruct ? Body(*field.type, value) : Cell(value);
    }
  }
  void Cell(const Json& value) {
    out_ << ',';
    WriteCell(out_, TextOf(value));
  }
  std::ostream& out_;
};

}  // namespace

std::string QuotedCell(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

CsvTable::CsvTable(const Struct& type) : type_(&type) {
  AddColumns(type, "", columns_);
  if (columns_.size() > kMostColumns)
    throw SchemaError(fmt::format("{}:{}: {} has more than {} values, too many for columns of a table",
                                  type.file, type.line, type.full_name, kMostColumns));
}

void CsvTable::WriteHeader(std::ostream& out) const {
  out << "log_utime,log_number";
  for (const std::string& column : columns_) {
    out << ',';
    WriteCell(out, column);
  }
  out << "\r\n";
}

void CsvTable::WriteRow(std::ostream& out, const LogEvent& event) const {
  const Json json = ToJson(*type_, event.bytes);
  out << event.utime << ',' << event.number;
  RowWriter(out).Body(*type_, json);
  out << "\r\n";
}

}  // namespace priamos::bus
