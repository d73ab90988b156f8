#include <fmt/format.h>

#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "head/core/edges/equal_contrast.hpp"
#include "head/core/stereo/pair_order.hpp"
#include "test/bench/vision/order/order_pairs.hpp"

namespace priamos::bench {
namespace {

using Change = std::function<cv::Mat(const cv::Mat&, cv::RNG&)>;

cv::Mat Gain(const cv::Mat& image, double gain) {
  cv::Mat out;
  image.convertTo(out, CV_8U, gain);
  return out;
}

cv::Mat Noise(const cv::Mat& image, double sigma, cv::RNG& rng) {
  cv::Mat noise(image.size(), CV_16S), out;
  rng.fill(noise, cv::RNG::NORMAL, 0, sigma);
  cv::add(image, noise, out, cv::noArray(), CV_8U);
  return out;
}

cv::Mat Shift(const cv::Mat& image, int right_px, int down_px) {
  cv::Mat out = image.clone();
  const cv::Rect all({}, image.size());
  const cv::Rect to = all & (all + cv::Point(right_px, down_px));
  image(to - cv::Point(right_px, down_px)).copyTo(out(to));
  return out;
}

cv::Mat Compress(const cv::Mat& image, int quality) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
}

/// One gain of 0.5 to 2, as likely above 1 as below.
cv::Mat AnyGain(const cv::Mat& image, cv::RNG& rng) {
  return Gain(image, std::exp2(rng.uniform(-1.0, 1.0)));
}

/// What is made of one image to pass it off as the other camera's.
const std::map<std::string, Change>& Copies() {
  static const std::map<std::string, Change> kCopies{
      {"itself", [](const cv::Mat& i, cv::RNG&) { return i; }},
      {"with noise of 2", [](const cv::Mat& i, cv::RNG& r) { return Noise(i, 2, r); }},
      {"with noise of 5", [](const cv::Mat& i, cv::RNG& r) { return Noise(i, 5, r); }},
      {"1 px to the right", [](const cv::Mat& i, cv::RNG&) { return Shift(i, 1, 0); }},
      {"1 px to the left", [](const cv::Mat& i, cv::RNG&) { return Shift(i, -1, 0); }},
      {"1 px down", [](const cv::Mat& i, cv::RNG&) { return Shift(i, 0, 1); }},
      {"compressed, quality 80", [](const cv::Mat& i, cv::RNG&) { return Compress(i, 80); }},
      {"compressed, quality 40", [](const cv::Mat& i, cv::RNG&) { return Compress(i, 40); }},
      {"gain 0.5 to 2", [](const cv::Mat& i, cv::RNG& r) { return AnyGain(i, r); }},
      {"all: noise, 1 px, quality 60, gain",
       [](const cv::Mat& i, cv::RNG& r) { return AnyGain(Compress(Noise(Shift(i, 1, 0), 2, r), 60), r); }},
  };
  return kCopies;
}

head::PairOrder Judge(const std::array<cv::Mat, 2>& images, const std::array<head::CameraModel, 2>& cameras) {
  std::array<head::EdgeImage, 2> edges;
  const auto options = head::ForOneScene(images, {});
  std::vector<head::CameraView> views;
  for (int c = 0; c < 2; ++c) {
    head::EdgeOperator(options[c]).Extract(images[c], edges[c]);
    views.push_back(head::MakeView(cameras[c], edges[c]));
  }
  return head::JudgeOrder(views[0], views[1], {});
}

struct Rate {
  int good = 0, all = 0;

  /// Wilson's interval of 95 %, lower end [%].
  double lower() const {
    constexpr double kZ = 1.96;
    const double n = all, p = good / n, z2 = kZ * kZ;
    return 100 * (p + z2 / (2 * n) - kZ * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n))) / (1 + z2 / n);
  }
};

/// Rates by kind of pair.
class Rates {
 public:
  explicit Rates(bool verbose) : verbose_(verbose) {}

  void Add(const std::string& what, const head::PairOrder& order, bool good) {
    const std::string of_all =
        "all: " + what.substr(0, what.find_first_of(",:"));  // accepted, or refused for which reason
    for (const std::string& name : {what, of_all}) {
      ++rates_[name].all;
      rates_[name].good += good;
    }
    if (verbose_ || !good)
      fmt::print("    {} {}: given {:.0f} ({}), exchanged {:.0f} ({}), still {} of {}\n",
                 good ? "ok" : "WRONG", what, order.as_given, order.n_as_given, order.exchanged,
                 order.n_exchanged, order.n_still, order.n_should_move);
  }
  void Report(Figures& figures) const {
    for (const auto& [what, rate] : rates_)
      figures.AtLeast(
          fmt::format("  {} ({} of {}, at least {:.2f} %)", what, rate.good, rate.all, rate.lower()),
          100.0 * rate.good / rate.all, 99.5, "%");
  }

 private:
  bool verbose_;
  std::map<std::string, Rate> rates_;
};

void Try(const std::string& kind, const OrderPair& pair, cv::RNG& rng, Rates& rates) {
  using head::PairVerdict;
  const auto& [left, right] = pair.images;
  const auto add = [&](const std::string& what, const std::array<cv::Mat, 2>& images, bool is_right) {
    const head::PairOrder order = Judge(images, pair.cameras);
    rates.Add(what + ": " + kind, order, (order.verdict == PairVerdict::kRight) == is_right);
  };
  add("accepted, as they are", {left, right}, true);
  add("accepted, gain 0.5 to 2", {left, AnyGain(right, rng)}, true);
  add("refused exchanged", {right, left}, false);
  add("refused exchanged, gain 0.5 to 2", {AnyGain(right, rng), left}, false);
  for (const auto& [what, change] : Copies()) {
    add("refused one image twice, " + what, {left, change(left, rng)}, false);
    add("refused one image twice, " + what, {change(right, rng), right}, false);
  }
}

}  // namespace

void BenchOrder(const VisionOptions& options, Figures& figures) {
  Rates rates(options.verbose);
  cv::RNG rng(options.seed);
  for (const auto& [kind, pair] : PhotographedPairs(options)) Try(kind, pair, rng, rates);
  ForEachRendered(options, options.quick ? 20 : 60,
                  [&](const char* kind, const OrderPair& pair) { Try(kind, pair, rng, rates); });
  rates.Report(figures);
}

}  // namespace priamos::bench
