#include "test/bench/vision/timed_doors.hpp"

#include "test/bench/figures.hpp"

namespace priamos::bench {

std::vector<head::DetectedDoor> DetectTimed(const std::array<cv::Mat, 2>& images,
                                            const std::array<head::CameraModel, 2>& cameras,
                                            head::EdgeOperator& edge_operator, double& seconds) {
  const double start = CpuSeconds();
  std::array<head::EdgeImage, 2> edges;
  for (int c = 0; c < 2; ++c) edge_operator.Extract(images[c], edges[c]);
  auto doors =
      head::DetectDoors(head::MakeView(cameras[0], edges[0]), head::MakeView(cameras[1], edges[1]), {});
  seconds += CpuSeconds() - start;
  return doors;
}

}  // namespace priamos::bench
