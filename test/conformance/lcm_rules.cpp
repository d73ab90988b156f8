#include "lcm_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bus/schema/packing.hpp"

namespace priamos::bus {
namespace {

/// Units and the end of the names of their fields.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kUnits{{{"m", "_m"},
                                                                                {"m/s", "_m_s"},
                                                                                {"rad", "_rad"},
                                                                                {"rad/s", "_rad_s"},
                                                                                {"step/s", "_step_s"},
                                                                                {"s", "_s"},
                                                                                {"Hz", "_hz"},
                                                                                {"px", "_px"},
                                                                                {"step", "_step"},
                                                                                {"tick", "_ticks"},
                                                                                {"us", "_us"},
                                                                                {"V", "_v"},
                                                                                {"A", "_a"}}};

/// The unit whose suffix the name has; of several the longest ("_rad_s" ends in "_s" too).
std::string_view UnitToldBy(std::string_view name) {
  std::pair<std::string_view, std::string_view> best;
  for (const auto& row : kUnits) {
    if (name.ends_with(row.second) && row.second.size() > best.second.size()) best = row;
  }
  return best.first;
}

bool NameTellsUnit(const Field& field) {
  const std::string& unit = field.annotation.unit;
  if (field.kind == Kind::kString) return unit == "ascii" || unit == "utf8";
  if (unit == "us" && field.name.starts_with("utime")) return true;
  if (unit == "byte") return field.name.find("bytes") != std::string::npos;
  return UnitToldBy(field.name) == (unit == "-" ? "" : unit);
}

bool IsLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool IsCoordinate(std::string_view name) {
  for (const std::string_view axis : {"x", "y", "z", "yaw"}) {
    if (!name.starts_with(axis)) continue;
    std::string_view rest = name.substr(axis.size());
    while (!rest.empty() && rest.front() >= '0' && rest.front() <= '9') rest.remove_prefix(1);
    if (rest == "_m" || rest == "_rad") return true;
  }
  return false;
}

bool HasBound(const Field& field) {
  const Annotation& a = field.annotation;
  const bool variable =
      std::any_of(field.dims.begin(), field.dims.end(), [](const Dimension& d) { return d.variable; });
  if (variable && a.sizes.empty()) return false;
  switch (field.kind) {
    case Kind::kStruct:
    case Kind::kBoolean:
      return true;
    case Kind::kString:
      return !a.sizes.empty();
    default:
      return (a.min || a.age_us) && a.step;
  }
}

class Checker {
 public:
  std::vector<std::string> Run(const Schema& schema) {
    for (const Struct* type : schema.All()) CheckType(*type);
    return std::move(found_);
  }

 private:
  void CheckType(const Struct& type) {
    const auto report = [&](std::string_view sentence) {
      found_.push_back(fmt::format("{}:{}: {}: {}", type.file, type.line, type.full_name, sentence));
    };
    if (type.doc.empty()) report("has no comment before it");
    for (const Field& field : type.fields) CheckField(type, field);
    const auto size = MaxEncodedSize(type);
    if (!size) report("its size has no bound");
    if (size && *size > kMaxMessageBytes)
      report(fmt::format("may have {} bytes, {} are allowed", *size, kMaxMessageBytes));
    try {
      const Packer packer(type);
    } catch (const SchemaError& error) {
      found_.emplace_back(error.what());
    }
  }

  void CheckField(const Struct& type, const Field& field) {
    const Annotation& a = field.annotation;
    const auto report = [&](std::string_view sentence) {
      found_.push_back(type.Where(field) + std::string(sentence));
    };
    if (!a.problem.empty()) return report(a.problem);
    if (a.unit.empty()) return report("no unit in brackets");
    if (!HasBound(field)) report("no bound: @range and @step, @age and @step, or @max");
    if (!NameTellsUnit(field)) report(fmt::format("the name does not tell the unit [{}]", a.unit));
    if (IsCoordinate(field.name) && a.frame.empty()) report("a coordinate needs @frame");
    if (std::count_if(a.meaning.begin(), a.meaning.end(), IsLetter) < 3) report("no meaning after the colon");
  }

  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> Violations(const Schema& schema) {
  return Checker().Run(schema);
}

}  // namespace priamos::bus
