#include "test/bench/vision/visp/visp_tracker.hpp"

#include <unistd.h>
#include <visp3/core/vpImageConvert.h>
#include <visp3/mbt/vpMbGenericTracker.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

constexpr const char* kNames[2] = {"Camera1", "Camera2"};

/// The lines in ViSP's format.
std::string WriteModel(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& lines) {
  const std::string name = "priamos-bench-" + std::to_string(getpid()) + ".cao";
  const std::string file = (std::filesystem::temp_directory_path() / name).string();
  std::ofstream out(file);
  out << "V1\n" << 2 * lines.size() << "\n";
  for (const auto& [from, to] : lines) out << from.transpose() << "\n" << to.transpose() << "\n";
  out << lines.size() << "\n";
  for (std::size_t i = 0; i < lines.size(); ++i) out << 2 * i << " " << 2 * i + 1 << "\n";
  out << "0\n0\n0\n0\n";
  return file;
}

vpHomogeneousMatrix ToVisp(const Eigen::Isometry3d& t) {
  vpHomogeneousMatrix m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) m[r][c] = t.matrix()(r, c);
  return m;
}

Eigen::Isometry3d FromVisp(const vpHomogeneousMatrix& m) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) t.matrix()(r, c) = m[r][c];
  return t;
}

/// Settings of the edge search: of those tried (thresholds 2000 and 10000; ranges 12, 25, 40, 60 and from
/// wide to narrow; 3 and 8 steps) those that found the door most often. Wider ranges follow the clutter.
vpMe Edges() {
  vpMe me;
  me.setMaskSize(5);
  me.setMaskNumber(180);
  me.setRange(12);
  me.setThreshold(2000);
  me.setMu1(0.5);
  me.setMu2(0.5);
  me.setSampleStep(4);
  return me;
}

}  // namespace

VispResult TrackWithVisp(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& lines,
                         const std::vector<VispView>& views) {
  std::map<std::string, vpImage<unsigned char>> images;
  std::map<std::string, const vpImage<unsigned char>*> pictures;
  std::map<std::string, vpHomogeneousMatrix> camera_from_model, from_reference;
  std::map<std::string, vpCameraParameters> intrinsics;
  std::map<std::string, std::string> models;
  const std::vector<std::string> names(kNames, kNames + views.size());
  const std::string model = WriteModel(lines);
  for (std::size_t c = 0; c < views.size(); ++c) {
    const VispView& view = views[c];
    vpImageConvert::convert(view.straight, images[kNames[c]]);
    pictures[kNames[c]] = &images[kNames[c]];
    camera_from_model[kNames[c]] = ToVisp(view.camera_from_model);
    from_reference[kNames[c]] = ToVisp(view.camera_from_model * views[0].camera_from_model.inverse());
    intrinsics[kNames[c]].initPersProjWithoutDistortion(view.focal_px, view.focal_px, view.centre_px.x(),
                                                        view.centre_px.y());
    models[kNames[c]] = model;
  }
  VispResult result;
  std::ostringstream chatter;
  std::streambuf* const out = std::cout.rdbuf(chatter.rdbuf());
  try {
    vpMbGenericTracker tracker(names, std::vector<int>(views.size(), vpMbGenericTracker::EDGE_TRACKER));
    tracker.setCameraParameters(intrinsics);
    tracker.setMovingEdge(Edges());
    tracker.loadModel(models);
    tracker.setCameraTransformationMatrix(from_reference);
    tracker.setGoodMovingEdgesRatioThreshold(0.2);
    tracker.initFromPose(pictures, camera_from_model);
    const double start = CpuSeconds();
    for (int i = 0; i < 8; ++i) tracker.track(pictures);
    result.seconds = CpuSeconds() - start;
    std::map<std::string, vpHomogeneousMatrix> found;
    tracker.getPose(found);
    result.camera_from_model = FromVisp(found[kNames[0]]);
    result.ok = true;
  } catch (const vpException&) {  // "tracking failed": it says so, which is honest
  }
  std::cout.rdbuf(out);
  std::filesystem::remove(model);
  return result;
}

}  // namespace priamos::bench
