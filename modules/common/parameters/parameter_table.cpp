#include "common/parameters/parameter_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "common/parameters/described_numbers.hpp"
#include "common/text/text_hash.hpp"

namespace priamos {
namespace {

class Marks : public DescribedNumbers {
 public:
  std::vector<Parameter> parameters;

  void Live(std::string_view key, LiveChange change) override {
    const auto spec = specs_.find(std::string(key));
    if (spec == specs_.end()) throw std::logic_error(fmt::format("{}: live, and no number", key));
    const auto& [unit, min, max, doc] = spec->second;
    if (!(min >= -ParameterTable::kFarthest && max <= ParameterTable::kFarthest))
      throw std::logic_error(fmt::format("{}: live, and beyond {}", key, ParameterTable::kFarthest));
    parameters.push_back({std::string(key), std::string(unit), std::string(doc), min, max, change});
  }

 protected:
  void OnNumber(const std::string& name, double&, const ValueSpec& spec) override {
    specs_.insert_or_assign(name, spec);
  }

 private:
  std::map<std::string, ValueSpec> specs_;
};

}  // namespace

ParameterTable::ParameterTable(const Description& describe) {
  Marks marks;
  describe(marks);
  parameters_ = std::move(marks.parameters);
  if (parameters_.size() > kMost) throw std::logic_error(fmt::format("more than {} live keys", kMost));
}

const Parameter* ParameterTable::Find(int number) const {
  const bool known = number >= 1 && static_cast<std::size_t>(number) <= parameters_.size();
  return known ? &parameters_[static_cast<std::size_t>(number - 1)] : nullptr;
}

int ParameterTable::NumberOf(std::string_view name) const {
  const auto at = std::find_if(parameters_.begin(), parameters_.end(),
                               [&](const Parameter& parameter) { return parameter.name == name; });
  return at == parameters_.end() ? 0 : static_cast<int>(at - parameters_.begin()) + 1;
}

int ParameterTable::Fingerprint() const {
  std::string text;
  for (const Parameter& p : parameters_)
    text += fmt::format("{} [{}] {} to {}; {}\n", p.name, p.unit, p.min, p.max, LiveText(p.change));
  return static_cast<int>(TextHash32(text) % 65535) + 1;
}

}  // namespace priamos
