#include "test/support/readme_material.hpp"

#include <fmt/format.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "head/see/see_landmark.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"

namespace priamos::support {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 640, kHeight = 480, kScale = 4;  // drawn larger, for edges between pixels
constexpr double kFocal = 500;

void Save(cv::Mat drawing, const fs::path& file) {
  cv::resize(drawing, drawing, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(drawing, drawing, {}, 0.7);
  cv::imwrite(file, drawing);
}

cv::Point Drawn(double x, double y, double z) {
  return {static_cast<int>(kScale * (kWidth / 2.0 + 0.5 + kFocal * x / z)),
          static_cast<int>(kScale * (kHeight / 2.0 + 0.5 + kFocal * y / z))};
}

/// Rectified, `baseline_m` to the right of the first one.
void WriteCamera(const fs::path& file, double baseline_m) {
  std::ofstream(file) << fmt::format(
      "%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\nprojection_matrix:\n   rows: 3\n   cols: 4\n"
      "   data: [ {}., 0., {}., {}, 0., {}., {}., 0., 0., 0., 1., 0. ]\n",
      kWidth, kHeight, kFocal, kWidth / 2, -kFocal * baseline_m, kFocal, kHeight / 2);
}

/// The reference object's discs as points and as photographs, from `azimuth_rad`.
void WriteReferenceObject(const fs::path& folder, const std::string& side, double azimuth_rad) {
  const ReferenceObject object = ShippedReferenceObject();
  CameraView view;
  view.azimuth_rad = azimuth_rad;
  const head::CameraModel camera = MakeCamera(view);
  Rng rng(4);
  DiscRenderer scene(768, 576, 25, 2);
  std::ofstream points(folder / (side + ".txt"));
  for (const ReferenceDisc& disc : object.discs) {
    scene.AddDisc(camera, disc, 180);
    const Eigen::Vector3d& p = disc.centre_m;
    const Eigen::Vector2d px = camera.Project(p);
    points << fmt::format("{:.6f} {:.6f} {:.6f} {:.4f} {:.4f}\n", p.x(), p.y(), p.z(),
                          px.x() + rng.Normal(0.1), px.y() + rng.Normal(0.1));
  }
  GreyImage image = scene.Expose({}, rng);
  cv::imwrite(folder / (side + ".png"), cv::Mat(image.height, image.width, CV_8UC1, image.pixels.data()));
}

/// A framed door 3 m before a camera 1.2 m above the floor, which stands `right_m` to the right of its
/// middle.
void WriteDoor(const fs::path& file, double right_m) {
  cv::Mat drawing(kScale * kHeight, kScale * kWidth, CV_8UC1, cv::Scalar(180));
  const auto box = [&](double half, double top, double bottom, int grey) {
    cv::rectangle(drawing, Drawn(-half - right_m, 1.2 - top, 3), Drawn(half - right_m, 1.2 - bottom, 3),
                  cv::Scalar(grey), cv::FILLED);
  };
  box(10, 0, -1, 100);
  box(0.51, 2.06, 0, 90);
  box(0.45, 2.0, 0, 140);
  Save(drawing, file);
}

/// A box as ViSP writes it, and its photograph where modules/head/README.md looks for it.
void WriteBody(const fs::path& folder) {
  const Eigen::Vector3d half(0.12, 0.09, 0.07);
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const Eigen::Isometry3d pose = head::PoseFromSix({0.05, 0.1, 0.6, 115, 0, 0});
  std::vector<Eigen::Vector3d> corners;
  std::ofstream cao(folder / "body.cao");
  cao << "V1\n8\n";
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner =
        half.cwiseProduct(Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    cao << corner.transpose() << "\n";
    corners.push_back(pose * corner);
  }
  cao << "0\n0\n6\n";
  cv::Mat drawing(kScale * kHeight, kScale * kWidth, CV_8UC1, cv::Scalar(60));
  int grey = 90;
  for (const auto& face : faces) {
    cao << fmt::format("4 {}\n", fmt::join(face, " "));
    const Eigen::Vector3d a = corners[face[0]], b = corners[face[1]], c = corners[face[2]];
    grey += 25;
    if ((b - a).cross(c - b).dot(a) >= 0) continue;  // turned away
    std::vector<cv::Point> outline;
    for (const int i : face) outline.push_back(Drawn(corners[i].x(), corners[i].y(), corners[i].z()));
    cv::fillConvexPoly(drawing, outline, cv::Scalar(grey));
  }
  cao << "0\n0\n";
  Save(drawing, folder / "photo.png");
}

void Copy(const fs::path& from, const fs::path& to) {
  if (fs::exists(from)) fs::copy_file(from, to);
}

}  // namespace

void WriteReadmeMaterial(const fs::path& folder) {
  for (const std::string side : {"onboard", "offboard"})
    Copy(PRIAMOS_SOURCE_DIR "/logs/recorded/door-" + side + ".lcmlog", folder / (side + ".lcmlog"));
  WriteReferenceObject(folder, "left", -0.1);
  WriteReferenceObject(folder, "right", 0.1);
  Copy(PRIAMOS_SOURCE_DIR "/config/sim/reference_object.toml", folder / "reference_object.toml");
  WriteDoor(folder / "left.jpg", 0);
  WriteDoor(folder / "right.jpg", 0.2);
  WriteDoor(folder / "photo.jpg", 0.1);
  WriteCamera(folder / "left.yaml", 0);
  WriteCamera(folder / "right.yaml", 0.2);
  WriteCamera(folder / "camera.yaml", 0);
  WriteBody(folder);
  const fs::path grids = "/usr/share/visp-images-data/ViSP-images/calibration";
  const fs::path boards = "/usr/share/doc/opencv-doc/examples/data";
  for (int i = 1; i <= 4; ++i)
    Copy(grids / fmt::format("grid36-{:02}.pgm", i), folder / fmt::format("grid-{}.pgm", i));
  for (int i = 1; i <= 9; ++i)
    Copy(boards / fmt::format("left{:02}.jpg", i), folder / fmt::format("board-{}.jpg", i));
}

}  // namespace priamos::support
