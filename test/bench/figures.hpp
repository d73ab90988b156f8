#pragma once

#include <string_view>

namespace priamos::bench {

/// Collects figures and prints each with its bound.
class Figures {
 public:
  void AtMost(std::string_view what, double value, double bound, std::string_view unit);
  void AtLeast(std::string_view what, double value, double bound, std::string_view unit);
  /// A figure without bound, such as that of a rival.
  void Note(std::string_view what, double value, std::string_view unit);
  int missed() const { return missed_; }

 private:
  void Print(std::string_view what, double value, std::string_view unit, std::string_view relation,
             double bound, bool held);
  int missed_ = 0;
};

/// CPU time of this thread [s]: other work on the machine does not count.
double CpuSeconds();

}  // namespace priamos::bench
