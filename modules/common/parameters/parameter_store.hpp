#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/parameters/parameter_table.hpp"

namespace priamos {

/// What became of a change. Less careful: on the wrong side of the file's value. Contradicts: another key of
/// the configuration does not allow it.
enum class ChangeVerdict { kDone, kUnknownKey, kOutOfRange, kLessCareful, kContradicts };

/// Why a change was refused, as a person reads it.
std::string_view Text(ChangeVerdict verdict);

/// The parameters of a running process: what its file says of them, and what is in force. Pure; the values
/// are in the configuration itself, which `describe` shows.
class ParameterStore {
 public:
  /// The values of now are the file's.
  explicit ParameterStore(Description describe);

  const ParameterTable& table() const { return table_; }
  /// Changes a parameter; NaN and whatever its range, its mark or its configuration refuses changes nothing.
  ChangeVerdict Set(int number, double value);
  /// Puts the file's values in force again.
  void Reset();

  /// Value in force. `number` is that of a parameter.
  double ValueOf(int number) const;
  double FileValueOf(int number) const { return file_[static_cast<std::size_t>(number - 1)]; }
  /// The first parameter behind `number`, which is not negative, that differs from the file; 0: none.
  int NextChanged(int number) const;
  /// Name and value of all that differ from the file, in the order of their numbers.
  std::vector<std::pair<std::string, double>> Changed() const;

 private:
  std::vector<double> Values() const;
  void Write(const std::string& name, double value);
  bool Contradicts() const;

  Description describe_;
  ParameterTable table_;
  std::vector<double> file_;
};

}  // namespace priamos
