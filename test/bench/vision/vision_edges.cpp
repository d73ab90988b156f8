#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/edge_drawing.hpp>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/edges/scale_edges.hpp"
#include "test/bench/vision/vision_bench.hpp"
#include "test/support/line_scene.hpp"

namespace priamos::bench {
namespace {

using head::EdgeSegment;
/// An operator and, told apart because only it is timed, what it has found.
struct Rival {
  std::string name;
  std::function<void(const cv::Mat&)> detect;
  std::function<std::vector<EdgeSegment>()> segments;
};

std::vector<EdgeSegment> FromLines(const std::vector<cv::Vec4f>& lines, double shift_px) {
  std::vector<EdgeSegment> segments(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    segments[i].begin = {lines[i][0] + shift_px, lines[i][1] + shift_px};
    segments[i].end = {lines[i][2] + shift_px, lines[i][3] + shift_px};
    segments[i].sigma_normal_px = 1;  // none is given
  }
  return segments;
}

Rival Ours() {
  auto op = std::make_shared<head::EdgeOperator>();
  auto edges = std::make_shared<head::EdgeImage>();
  return {"ours", [op, edges](const cv::Mat& image) { op->Extract(image, *edges); },
          [edges] { return edges->segments; }};
}

Rival OverScales() {
  auto op = std::make_shared<head::ScaleEdgeOperator>();
  auto found = std::make_shared<head::BlurredEdges>();
  return {"over scales", [op, found](const cv::Mat& image) { op->Extract(image, *found); },
          [found] { return found->edges.segments; }};
}

Rival Lsd(bool repaired) {
  // At its default scale of 0.8 it shifts every segment by an eighth of a pixel.
  auto lsd = cv::createLineSegmentDetector(cv::LSD_REFINE_STD);
  auto lines = std::make_shared<std::vector<cv::Vec4f>>();
  return {repaired ? "LSD, shift repaired" : "LSD",
          [lsd, lines](const cv::Mat& image) { lsd->detect(image, *lines); },
          [lines, repaired] { return FromLines(*lines, repaired ? 0.125 : 0); }};
}

Rival EdgeDrawing() {
  auto drawing = cv::ximgproc::createEdgeDrawing();
  auto lines = std::make_shared<std::vector<cv::Vec4f>>();
  return {"EdgeDrawing",
          [drawing, lines](const cv::Mat& image) {
            drawing->detectEdges(image);
            drawing->detectLines(*lines);
          },
          [lines] { return FromLines(*lines, 0); }};
}

std::vector<Rival> AllRivals() {
  return {Ours(), Lsd(false), Lsd(true), EdgeDrawing()};
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Median time of each operator, taken in turns.
void Times(const std::string& photo, const VisionOptions& options, Figures& figures) {
  cv::Mat image = cv::imread(photo, cv::IMREAD_GRAYSCALE);
  cv::resize(image, image, {768, 576}, 0, 0, cv::INTER_AREA);
  const std::vector<Rival> rivals{Ours(), Lsd(false), EdgeDrawing()};
  std::vector<std::vector<double>> times(rivals.size());
  std::vector<std::size_t> counts(rivals.size());
  for (int round = 0; round < (options.quick ? 10 : 60); ++round) {
    for (std::size_t i = 0; i < rivals.size(); ++i) {
      const double start = CpuSeconds();
      rivals[i].detect(image);
      times[i].push_back(1000 * (CpuSeconds() - start));
      counts[i] = rivals[i].segments().size();
    }
  }
  fmt::print("{} at 768x576: {} segments, LSD {}, EdgeDrawing {}\n", photo, counts[0], counts[1], counts[2]);
  const double ours = Median(times[0]);
  figures.AtMost("  edges, time", ours, 2, "ms");
  figures.Note("  LSD, time", Median(times[1]), "ms");
  figures.Note("  EdgeDrawing, time", Median(times[2]), "ms");
  figures.AtLeast("  times faster than LSD", Median(times[1]) / ours, 10, "");
}

/// Total length of what each operator finds as the photograph is blurred more and more.
void Lengths(const std::string& photo, Figures& figures) {
  const cv::Mat sharp = cv::imread(photo, cv::IMREAD_GRAYSCALE);
  for (const double blur_px : {0.0, 1.0, 2.0, 3.0, 5.0}) {
    cv::Mat image = sharp.clone();  // each blur by itself: none of them adds to the one before
    if (blur_px > 0) cv::GaussianBlur(sharp, image, {}, blur_px);
    std::vector<double> lengths;
    for (const Rival& rival : {OverScales(), Ours(), Lsd(false), EdgeDrawing()}) {
      rival.detect(image);
      double sum = 0;
      for (const EdgeSegment& segment : rival.segments()) sum += segment.length_px();
      lengths.push_back(sum);
    }
    fmt::print(
        "{} blurred by {} px: over scales {:.0f}, one scale {:.0f}, LSD {:.0f}, EdgeDrawing {:.0f} px\n",
        photo, blur_px, lengths[0], lengths[1], lengths[2], lengths[3]);
    figures.AtLeast("  length over that of the better rival",
                    lengths[0] / std::max({lengths[2], lengths[3], 1.0}), 0.95, "");
  }
}

struct Bounds {
  double contrast, noise, error_px, coverage;
};

void Accuracy(const Bounds& bounds, const VisionOptions& options, Figures& figures) {
  fmt::print("rectangles of contrast {}, noise {}\n", bounds.contrast, bounds.noise);
  auto rivals = AllRivals();
  std::vector<test::LineScorer> scorers(rivals.size());
  Rng rng(21);
  for (int i = 0; i < (options.quick ? 10 : 100); ++i) {
    const auto scene = test::RandomRectangles(bounds.contrast, bounds.noise, 0.5, rng);
    for (std::size_t r = 0; r < rivals.size(); ++r) {
      rivals[r].detect(scene.image);
      scorers[r].Add(scene.lines, rivals[r].segments());
    }
  }
  const test::LineScore ours = scorers[0].Score();
  figures.AtMost("  ends beside the true line, mean", ours.mean_error_px, bounds.error_px, "px");
  figures.AtLeast("  coverage", ours.coverage, 0.98, "");
  figures.AtMost("  broken true lines", 100 * ours.broken, 4, "%");
  figures.AtMost("  pieces per line", ours.pieces, 1.05, "");
  figures.AtMost("  segments of two lines", 100 * ours.wrong_unions, 1, "%");
  figures.Note("  segments of no line, per image", double(ours.n_false) / (options.quick ? 10 : 100), "");
  figures.Note("  squared error over variance, across", ours.nees, "");
  for (std::size_t r = 1; r < rivals.size(); ++r) {
    const test::LineScore score = scorers[r].Score();
    fmt::print("  {:22} ends {:.3f} px, coverage {:.3f}, broken {:.1f} %, {:.2f} pieces\n", rivals[r].name,
               score.mean_error_px, score.coverage, 100 * score.broken, score.pieces);
  }
}

}  // namespace

void BenchEdges(const VisionOptions& options, Figures& figures) {
  for (const std::string& photo : options.photos) Times(photo, options, figures);
  for (const std::string& photo : options.photos) Lengths(photo, figures);
  Accuracy({100, 5, 0.025, 0.98}, options, figures);
  Accuracy({30, 10, 0.12, 0.98}, options, figures);
}

}  // namespace priamos::bench
