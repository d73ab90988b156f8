#include "head/calibration_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "common/geometry.hpp"
#include "head/core/calibration/resection/camera_parameters.hpp"

namespace priamos::head {
namespace {

const cv::Scalar kWhite(255, 255, 255), kBlack(30, 30, 30), kGrey(200, 200, 200), kRed(40, 40, 210);
const std::array<cv::Scalar, 6> kColours{cv::Scalar(180, 90, 20), cv::Scalar(30, 130, 240),
                                         cv::Scalar(60, 150, 40), cv::Scalar(160, 60, 150),
                                         cv::Scalar(60, 60, 200), cv::Scalar(130, 130, 20)};
constexpr double kArrowScale = 1000;  // picture pixels per pixel of residual

void Write(cv::Mat& picture, const std::string& text, int x, int y, double size = 0.45) {
  cv::putText(picture, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, kBlack, 1, cv::LINE_AA);
}

cv::Point At(double x, double y) {
  return {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))};
}

void Save(const std::string& folder, const std::string& name, const cv::Mat& picture) {
  const std::string path = folder + "/" + name;
  if (!cv::imwrite(path, picture)) throw std::runtime_error(path + ": cannot be written");
}

/// Every centroid where it was measured, with its residual against the calibrated head.
cv::Mat DrawResiduals(const std::vector<HeadView>& views, const std::vector<Eigen::Vector2d>& residuals) {
  constexpr double kScale = 0.65;
  constexpr int kWidth = 500, kHeight = 375, kGap = 30;
  cv::Mat picture(kHeight + 2 * kGap, kCameras * (kWidth + kGap), CV_8UC3, kWhite);
  for (int c = 0; c < kCameras; ++c) {
    const int x = c * (kWidth + kGap) + kGap / 2;
    cv::rectangle(picture, {x, kGap}, {x + kWidth, kGap + kHeight}, kGrey);
    Write(picture, fmt::format("{} camera", kCameraNames[c]), x, kGap - 8);
  }
  std::size_t i = 0;
  for (const HeadView& view : views) {
    // No line leaves the frame of its camera.
    cv::Mat frame(picture, cv::Rect(view.camera * (kWidth + kGap) + kGap / 2, kGap, kWidth, kHeight));
    for (const DiscObservation& o : view.discs) {
      const cv::Point at = At(kScale * o.centroid_px.x(), kScale * o.centroid_px.y());
      const Eigen::Vector2d tip = kArrowScale * residuals[i++];
      cv::circle(frame, at, 1, kColours[0], -1, cv::LINE_AA);
      cv::line(frame, at, at + At(tip.x(), tip.y()), kRed, 1, cv::LINE_AA);
    }
  }
  Write(picture,
        fmt::format("lines: measured minus computed, 10 picture pixels are {:.2f} px", 10 / kArrowScale),
        kGap / 2, kHeight + 2 * kGap - 10);
  return picture;
}

/// F of every node: worst camera picture at it.
std::map<std::array<int, 2>, double> NodeErrors(const std::vector<HeadView>& views,
                                                const std::vector<double>& errors, int camera) {
  std::map<std::array<int, 2>, double> worst;
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (views[k].camera != camera) continue;
    const HeadSetting& s = views[k].setting;
    double& value = worst[{s.zoom_step[camera % 2], s.focus_step[camera % 2]}];
    value = std::max(value, errors[k]);
  }
  return worst;
}

cv::Mat DrawErrors(const std::vector<HeadView>& views, const HeadCalibration& result) {
  constexpr int kCell = 62, kRow = 36, kLeftEdge = 70, kTop = 60;
  const auto& zooms = result.model.lenses[kLeft].zoom_steps();
  const auto& focuses = result.model.lenses[kLeft].focus_steps();
  // Wide enough for the title of a small table.
  const int width = std::max(430, kLeftEdge + kCell * static_cast<int>(zooms.size()) + 20);
  cv::Mat picture(kTop + kRow * static_cast<int>(focuses.size()) + 40, 2 * width, CV_8UC3, kWhite);
  for (const int camera : {kLeft, kRight}) {
    const auto errors = NodeErrors(views, result.view_error_px, camera);
    const int left = camera * width + kLeftEdge;
    Write(picture, fmt::format("{} camera: F [px], worst picture of a node", kCameraNames[camera]), left, 20);
    for (std::size_t i = 0; i < zooms.size(); ++i) {
      const int x = left + kCell * static_cast<int>(i);
      Write(picture, fmt::format("z {}", zooms[i]), x + 4, kTop - 10);
      for (std::size_t j = 0; j < focuses.size(); ++j) {
        const int y = kTop + kRow * static_cast<int>(j);
        if (i == 0) Write(picture, fmt::format("f {}", focuses[j]), left - 60, y + 22);
        const auto error = errors.find({zooms[i], focuses[j]});
        if (error == errors.end()) continue;
        const double shade = std::clamp(error->second / 0.1, 0.0, 1.0);  // 0.1 px is full red
        cv::rectangle(picture, cv::Rect(x, y, kCell - 2, kRow - 2),
                      cv::Scalar(235 - 150 * shade, 245 - 160 * shade, 225 + 30 * shade), -1);
        Write(picture, fmt::format("{:.3f}", error->second), x + 8, y + 22);
      }
    }
  }
  return picture;
}

/// One parameter over zoom, a line per focus and camera.
void DrawCurve(cv::Mat& picture, const cv::Rect& box, const std::string& title, const HeadModel& head,
               const std::function<double(const LensState&)>& value) {
  double low = 1e300, high = -1e300, first = 1e300, last = -1e300;
  for (const int camera : {kLeft, kRight}) {
    for (const LensState& node : head.lenses[camera].nodes()) {
      low = std::min(low, value(node));
      high = std::max(high, value(node));
    }
    for (const int zoom : head.lenses[camera].zoom_steps()) {
      first = std::min<double>(first, zoom);
      last = std::max<double>(last, zoom);
    }
  }
  if (!(high > low)) high = low + 1;
  if (!(last > first)) last = first + 1;
  cv::rectangle(picture, box, kGrey);
  Write(picture, title, box.x, box.y - 8);
  Write(picture, fmt::format("{:.5g}", high), box.x + 4, box.y + 14, 0.4);
  Write(picture, fmt::format("{:.5g}", low), box.x + 4, box.y + box.height - 5, 0.4);
  Write(picture, fmt::format("zoom {:.0f} to {:.0f}", first, last), box.x + box.width - 120,
        box.y + box.height + 16, 0.4);
  const auto place = [&](double zoom, double v) {
    return At(box.x + box.width * (zoom - first) / (last - first),
              box.y + box.height * (0.94 - 0.88 * (v - low) / (high - low)));
  };
  for (const int camera : {kLeft, kRight}) {
    const LensTable& lens = head.lenses[camera];
    for (std::size_t j = 0; j < lens.focus_steps().size(); ++j) {
      std::vector<cv::Point> line;
      for (double zoom = first; zoom <= last; zoom += (last - first) / 60) {
        const auto state = lens.At(zoom, lens.focus_steps()[j]);
        if (state) line.push_back(place(zoom, value(*state)));
      }
      cv::polylines(picture, line, false, kColours[camera], 1, cv::LINE_AA);
      for (std::size_t i = 0; i < lens.zoom_steps().size(); ++i) {
        const double v = value(lens.nodes()[i * lens.focus_steps().size() + j]);
        cv::circle(picture, place(lens.zoom_steps()[i], v), 3, kColours[camera], -1, cv::LINE_AA);
      }
    }
  }
}

cv::Mat DrawCurves(const HeadModel& head) {
  constexpr int kWidth = 380, kHeight = 220;
  cv::Mat picture(2 * (kHeight + 60) + 20, 3 * (kWidth + 30), CV_8UC3, kWhite);
  const auto box = [&](int i) {
    return cv::Rect(15 + (i % 3) * (kWidth + 30), 30 + (i / 3) * (kHeight + 60), kWidth, kHeight);
  };
  DrawCurve(picture, box(0), "focal length [px]", head, [](const LensState& s) { return s.focal_px; });
  DrawCurve(picture, box(1), "principal point u [px]", head,
            [](const LensState& s) { return s.centre_px.x(); });
  DrawCurve(picture, box(2), "principal point v [px]", head,
            [](const LensState& s) { return s.centre_px.y(); });
  DrawCurve(picture, box(3), "k1", head, [](const LensState& s) { return s.k1; });
  DrawCurve(picture, box(4), "k2", head, [](const LensState& s) { return s.k2; });
  DrawCurve(picture, box(5), "entrance pupil [mm]", head, [](const LensState& s) { return 1e3 * s.pupil_m; });
  Write(picture, "blue: left camera, orange: right camera; a line per focus, dots are the nodes", 15,
        picture.rows - 6);
  return picture;
}

std::string Mechanics(const HeadGeometry& g) {
  std::string text = fmt::format(
      "pan axis at ({:.4f}, {:.4f}) m, tilt axis at height {:.4f} m; pan axis leans {:+.3f} deg (roll), "
      "{:+.3f} deg "
      "(pitch), pan zero {:+.3f} deg\ntilt axis {:+.2f} mm before the pan axis, {:+.3f} deg from square\n",
      g.x_m, g.y_m, g.z_m, Degrees(g.roll_rad), Degrees(g.pitch_rad), Degrees(g.yaw_rad),
      1e3 * g.tilt_axis_x_m, Degrees(g.tilt_axis_roll_rad));
  for (int c = 0; c < kCameras; ++c) {
    const CameraMount& m = g.cameras[c];
    text += fmt::format(
        "{} camera: vergence axis at ({:+.2f}, {:+.2f}, {:+.2f}) mm; roll {:+.3f}, pitch {:+.3f}, yaw "
        "{:+.3f} deg\n",
        kCameraNames[c], 1e3 * m.x_m, 1e3 * m.y_m, 1e3 * m.z_m, Degrees(m.roll_rad), Degrees(m.pitch_rad),
        Degrees(m.yaw_rad));
  }
  return text;
}

std::string Html(const std::vector<HeadView>& views, const HeadCalibration& result,
                 const ReportedErrors& errors, const HeadSetting& at) {
  std::string html = fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><title>Calibration of KASTOR</title>\n"
      "<style>body{{font:15px sans-serif;max-width:1650px;margin:2em auto}}img{{max-width:100%}}"
      "pre{{background:#f4f4f4;padding:1em}}</style>\n<h1>Calibration of KASTOR</h1>\n"
      "<p>{} pictures, {} discs, F (equation 7) {:.4f} px, worst picture {:.4f} px.</p>\n",
      views.size(), result.residuals_px.size(), result.mean_error_px,
      result.view_error_px.empty()
          ? 0
          : *std::max_element(result.view_error_px.begin(), result.view_error_px.end()));
  html += "<p>" + errors.ToText() + ".</p>\n";
  html +=
      "<h2>Where discs were seen</h2>\n<img src=\"residuals.png\">\n"
      "<h2>F over the table</h2>\n<img src=\"errors.png\">\n"
      "<h2>Lenses</h2>\n<img src=\"curves.png\">\n<h2>Mechanics</h2>\n<pre>" +
      Mechanics(result.model.geometry) + "</pre>\n";
  html += fmt::format("<h2>The 11 physical parameters at pan 0, zoom {}, focus {}</h2>\n", at.zoom_step[0],
                      at.focus_step[0]);
  for (int c = 0; c < kCameras; ++c)
    html += fmt::format("<h3>{} camera</h3>\n<pre>{}</pre>\n", kCameraNames[c],
                        PhysicalParameters(result.model, at, c));
  return html;
}

}  // namespace

std::string ReportedErrors::ToText() const {
  const std::string predicted = held_out
                                    ? fmt::format("F of {} settings that took no part {:.4f} px",
                                                  held_out->exposures, held_out->mean_px)
                                    : "F of settings that took no part unknown (" + held_out.reason() + ")";
  return predicted + fmt::format("; {} discs reconstructed by stereo, RMS {:.2f} mm, worst {:.2f} mm",
                                 stereo.points, 1e3 * stereo.rms_m, 1e3 * stereo.max_m);
}

std::string PhysicalParameters(const HeadModel& head, const HeadSetting& at, int camera) {
  const auto model = head.CameraAt(at, camera);
  if (!model) return model.reason();
  const auto parameters = ExtractParameters(model->image_from_base);
  return parameters ? parameters->ToText() : parameters.reason();
}

void WriteCalibrationReport(const std::string& folder, const std::vector<HeadView>& views,
                            const HeadCalibration& result, const ReportedErrors& errors,
                            const HeadSetting& at) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(fmt::format("{}: {}", folder, error.message()));
  Save(folder, "residuals.png", DrawResiduals(views, result.residuals_px));
  Save(folder, "errors.png", DrawErrors(views, result));
  Save(folder, "curves.png", DrawCurves(result.model));
  const std::string path = folder + "/index.html";
  std::ofstream file(path, std::ios::trunc);
  file << Html(views, result, errors, at);
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace priamos::head
