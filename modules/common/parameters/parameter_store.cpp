#include "common/parameters/parameter_store.hpp"

#include <map>

#include "common/parameters/described_numbers.hpp"

namespace priamos {
namespace {

class Reading : public DescribedNumbers {
 public:
  std::map<std::string, double> values;

 protected:
  void OnNumber(const std::string& name, double& value, const ValueSpec&) override { values[name] = value; }
};

class Writing : public DescribedNumbers {
 public:
  Writing(std::string name, double value) : name_(std::move(name)), value_(value) {}

 protected:
  void OnNumber(const std::string& name, double& value, const ValueSpec&) override {
    if (name == name_) value = value_;
  }

 private:
  std::string name_;
  double value_;
};

/// Finds what the configuration refuses beyond the ranges.
class Checking : public DescribedNumbers {
 public:
  bool refused = false;
  void Refuse(std::string_view, std::string_view) override { refused = true; }

 protected:
  void OnNumber(const std::string&, double&, const ValueSpec&) override {}
};

bool IsLessCareful(LiveChange change, double value, double of_file) {
  return (change == LiveChange::kOnlyLower && value > of_file) ||
         (change == LiveChange::kOnlyHigher && value < of_file);
}

}  // namespace

std::string_view Text(ChangeVerdict verdict) {
  switch (verdict) {
    case ChangeVerdict::kDone:
      return "in force";
    case ChangeVerdict::kUnknownKey:
      return "no key that can be changed while the process runs; it takes effect at the next start";
    case ChangeVerdict::kOutOfRange:
      return "out of its range";
    case ChangeVerdict::kLessCareful:
      return "less careful than the file, which only a change of the file allows";
    case ChangeVerdict::kContradicts:
      return "another key does not allow it";
  }
  return "";
}

ParameterStore::ParameterStore(Description describe) : describe_(std::move(describe)), table_(describe_) {
  file_ = Values();
}

ChangeVerdict ParameterStore::Set(int number, double value) {
  const Parameter* parameter = table_.Find(number);
  if (parameter == nullptr) return ChangeVerdict::kUnknownKey;
  // Written so that NaN is refused.
  if (!(value >= parameter->min && value <= parameter->max)) return ChangeVerdict::kOutOfRange;
  if (IsLessCareful(parameter->change, value, FileValueOf(number))) return ChangeVerdict::kLessCareful;
  const double before = ValueOf(number);
  Write(parameter->name, value);
  if (!Contradicts()) return ChangeVerdict::kDone;
  Write(parameter->name, before);
  return ChangeVerdict::kContradicts;
}

void ParameterStore::Reset() {
  for (int number = NextChanged(0); number != 0; number = NextChanged(number))
    Write(table_.Find(number)->name, FileValueOf(number));
}

std::vector<double> ParameterStore::Values() const {
  Reading reading;
  describe_(reading);
  std::vector<double> values;
  for (const Parameter& parameter : table_.all()) values.push_back(reading.values.at(parameter.name));
  return values;
}

double ParameterStore::ValueOf(int number) const {
  return Values()[static_cast<std::size_t>(number - 1)];
}

int ParameterStore::NextChanged(int number) const {
  const auto values = Values();
  for (auto next = static_cast<std::size_t>(number); next < values.size(); ++next)
    if (values[next] != file_[next]) return static_cast<int>(next) + 1;
  return 0;
}

std::vector<std::pair<std::string, double>> ParameterStore::Changed() const {
  std::vector<std::pair<std::string, double>> changed;
  for (int number = NextChanged(0); number != 0; number = NextChanged(number))
    changed.emplace_back(table_.Find(number)->name, ValueOf(number));
  return changed;
}

void ParameterStore::Write(const std::string& name, double value) {
  Writing writing(name, value);
  describe_(writing);
}

bool ParameterStore::Contradicts() const {
  Checking checking;
  describe_(checking);
  return checking.refused;
}

}  // namespace priamos
