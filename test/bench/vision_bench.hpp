#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace priamos::bench {

/// What a run of the bench is asked to do.
struct VisionOptions {
  bool quick = false;               ///< a tenth of the samples
  std::vector<std::string> photos;  ///< for times; scaled to 768 x 576
};

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

/// Time, accuracy and completeness of the edge operator, beside OpenCV's LSD and EdgeDrawing.
void BenchEdges(const VisionOptions& options, Figures& figures);

/// Wrong matches of edges with three cameras against two.
void BenchStereo(const VisionOptions& options, Figures& figures);

}  // namespace priamos::bench
