#include "head/core/edge_profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>

namespace priamos::head {
namespace {

constexpr int kFraction = 16;  ///< bits after the point of a position in the row
constexpr int kPhaseShift = kFraction - 6;
static_assert(EdgeKernelSet::kPhases == 1 << 6);

struct Lanes {
  cv::v_int32x4 first = cv::v_setzero_s32(), second[2] = {first, first}, third[2] = {first, first};
  cv::v_uint16x8 near = cv::v_setzero_u16(), far = near;
};

using Weights = std::array<std::int16_t, EdgeKernel::kTaps>;

cv::v_int32x4 Add(const cv::v_int32x4& sum, const cv::v_int16x8& a, const cv::v_int16x8& b,
                  const Weights& w) {
  return v_dotprod(b, cv::v_load_aligned(w.data() + 8), v_dotprod(a, cv::v_load_aligned(w.data()), sum));
}

void AddRow(const std::uint8_t* grey, const EdgeKernel& wide, const EdgeKernel& narrow, Lanes& lanes) {
  const cv::v_uint16x8 near = cv::v_load_expand(grey), far = cv::v_load_expand(grey + 8);
  const cv::v_int16x8 a = v_reinterpret_as_s16(near), b = v_reinterpret_as_s16(far);
  lanes.first = Add(lanes.first, a, b, wide.first);
  lanes.second[0] = Add(lanes.second[0], a, b, wide.second);
  lanes.third[0] = Add(lanes.third[0], a, b, wide.third);
  lanes.second[1] = Add(lanes.second[1], a, b, narrow.second);
  lanes.third[1] = Add(lanes.third[1], a, b, narrow.third);
  lanes.near = lanes.near + near, lanes.far = lanes.far + far;
}

}  // namespace

void EdgeProfile::SetImage(const cv::Mat& image) {
  image_ = image;
  cv::transpose(image, transposed_);
}

EdgeSums EdgeProfile::Sum(const AxisLine& line, int first, int last) const {
  const cv::Mat& rows = line.steep ? image_ : transposed_;
  first = std::max(first, 0), last = std::min(last, rows.rows - 1);
  EdgeSums sums;
  Lanes lanes;
  int along = 0, remainder = 0;
  for (int t = first; t <= last; ++t) {
    const int across = static_cast<int>(line.Across(t) * (1 << kFraction));
    const int pixel = across >> kFraction;
    if (pixel < EdgeKernel::kCentre || pixel + EdgeKernel::kTaps - EdgeKernel::kCentre > rows.cols) continue;
    const int phase = (across >> kPhaseShift) & (EdgeKernelSet::kPhases - 1);
    remainder += (across & ((1 << kPhaseShift) - 1)) - (1 << (kPhaseShift - 1));
    AddRow(rows.ptr(t) + pixel - EdgeKernel::kCentre, line.wide->phases[phase], line.narrow->phases[phase],
           lanes);
    along += t;
    ++sums.rows;
  }
  if (sums.rows == 0) return sums;
  const double scale = line.sign / EdgeKernel::kScale;
  // The kernels of the nearest phase were used; this brings the sums to the line itself.
  const double offset = double(remainder) / sums.rows / (1 << kFraction);
  sums.along = double(along) / sums.rows;
  sums.strength = scale * v_reduce_sum(lanes.first);
  for (int i = 0; i < 2; ++i) {
    sums.sharpness[i] = -scale * v_reduce_sum(lanes.third[i]);
    sums.imbalance[i] = scale * v_reduce_sum(lanes.second[i]) - offset * sums.sharpness[i];
  }
  std::uint16_t near[8], far[8];
  cv::v_store(near, lanes.near), cv::v_store(far, lanes.far);
  sums.low = (near[3] + near[4]) / 2.0, sums.high = (far[3] + far[4]) / 2.0;
  return sums;
}

EdgeSums EdgeProfile::RoughSum(const AxisLine& line, int first, int last, int step) const {
  const cv::Mat& rows = line.steep ? image_ : transposed_;
  first = std::max(first, 0), last = std::min(last, rows.rows - 1);
  EdgeSums sums;
  cv::v_int32x4 strength = cv::v_setzero_s32(), imbalance = strength;
  int along = 0;
  for (int t = first; t <= last; t += step) {
    const int across = static_cast<int>(line.Across(t) * (1 << kFraction));
    const int pixel = across >> kFraction;
    if (pixel < EdgeKernel::kCentre || pixel + EdgeKernel::kTaps - EdgeKernel::kCentre > rows.cols) continue;
    const EdgeKernel& kernel = line.wide->phases[(across >> kPhaseShift) & (EdgeKernelSet::kPhases - 1)];
    const std::uint8_t* grey = rows.ptr(t) + pixel - EdgeKernel::kCentre;
    const cv::v_int16x8 a = v_reinterpret_as_s16(cv::v_load_expand(grey));
    const cv::v_int16x8 b = v_reinterpret_as_s16(cv::v_load_expand(grey + 8));
    strength = Add(strength, a, b, kernel.first);
    imbalance = Add(imbalance, a, b, kernel.second);
    along += t;
    ++sums.rows;
  }
  if (sums.rows == 0) return sums;
  sums.along = double(along) / sums.rows;
  sums.strength = line.sign / EdgeKernel::kScale * v_reduce_sum(strength);
  sums.imbalance[0] = line.sign / EdgeKernel::kScale * v_reduce_sum(imbalance);
  return sums;
}

}  // namespace priamos::head
