#include "head/core/edges/edge_profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>

namespace priamos::head {
namespace {

// A position in the row: pixel, phase of the kernel, and what remains of it.
constexpr int kFraction = 32, kPhaseShift = kFraction - 6, kRemainderBits = 10;
constexpr int kRemainderShift = kPhaseShift - kRemainderBits;
constexpr double kOne = std::int64_t{1} << kFraction;
constexpr std::int64_t kInPhase = (std::int64_t{1} << kPhaseShift) - 1;
static_assert(EdgeKernelSet::kPhases == 1 << 6);

struct ProfileLanes {
  cv::v_int32x4 first = cv::v_setzero_s32(), second[2] = {first, first}, third[2] = {first, first};
  cv::v_uint16x8 near = cv::v_setzero_u16(), far = near;
};

using Weights = std::array<std::int16_t, EdgeKernel::kTaps>;

cv::v_int32x4 Add(const cv::v_int32x4& sum, const cv::v_int16x8& a, const cv::v_int16x8& b,
                  const Weights& w) {
  return v_dotprod(b, cv::v_load_aligned(w.data() + 8), v_dotprod(a, cv::v_load_aligned(w.data()), sum));
}

void AddRow(const std::uint8_t* grey, const EdgeKernel& wide, const EdgeKernel& narrow, ProfileLanes& lanes) {
  const cv::v_uint16x8 near = cv::v_load_expand(grey), far = cv::v_load_expand(grey + 8);
  const cv::v_int16x8 a = v_reinterpret_as_s16(near), b = v_reinterpret_as_s16(far);
  lanes.first = Add(lanes.first, a, b, wide.first);
  lanes.second[0] = Add(lanes.second[0], a, b, wide.second);
  lanes.third[0] = Add(lanes.third[0], a, b, wide.third);
  lanes.second[1] = Add(lanes.second[1], a, b, narrow.second);
  lanes.third[1] = Add(lanes.third[1], a, b, narrow.third);
  lanes.near = lanes.near + near;
  lanes.far = lanes.far + far;
}

void Reduce(const ProfileLanes& lanes, float scale, EdgeSums& sums) {
  cv::v_int32x4 a, b, c, d;
  cv::v_transpose4x4(lanes.first, lanes.second[0], lanes.second[1], lanes.third[0], a, b, c, d);
  float sum[4];
  cv::v_store(sum, cv::v_cvt_f32((a + b) + (c + d)));
  sums.strength = scale * sum[0];
  sums.imbalance[0] = scale * sum[1];
  sums.imbalance[1] = scale * sum[2];
  sums.sharpness[0] = -scale * sum[3];
  sums.sharpness[1] = -scale * float(cv::v_reduce_sum(lanes.third[1]));
  std::uint16_t near[8], far[8];
  cv::v_store(near, lanes.near);
  cv::v_store(far, lanes.far);
  sums.low = float(near[3] + near[4]) / 2;
  sums.high = float(far[3] + far[4]) / 2;
}

constexpr int kTile = 16, kCacheLine = 64;

/// 16 x 16 pixels: four rounds of interleaving rows that are 8 apart.
void TransposeTile(const std::uint8_t* from, std::size_t from_step, std::uint8_t* to, std::size_t to_step) {
  cv::v_uint8x16 a[kTile], b[kTile];
  for (int i = 0; i < kTile; ++i) a[i] = cv::v_load(from + i * from_step);
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < kTile / 2; ++i) cv::v_zip(a[i], a[i + 8], b[2 * i], b[2 * i + 1]);
    for (std::size_t i = 0; i < kTile / 2; ++i) cv::v_zip(b[i], b[i + 8], a[2 * i], a[2 * i + 1]);
  }
  for (int i = 0; i < kTile; ++i) cv::v_store(to + i * to_step, a[i]);
}

/// cv::transpose for bytes, three times faster.
void Transpose(const cv::Mat& image, cv::Mat& out) {
  out.create(image.cols, image.rows, CV_8UC1);
  const int whole_x = image.cols / kTile * kTile, whole_y = image.rows / kTile * kTile;
  for (int left = 0; left < whole_x; left += kCacheLine) {  // whatever is read is used while it is near
    for (int y = 0; y < whole_y; y += kTile) {
      for (int x = left; x < std::min(left + kCacheLine, whole_x); x += kTile) {
        TransposeTile(image.ptr(y) + x, image.step, out.ptr(x) + y, out.step);
      }
    }
  }
  for (int y = 0; y < image.rows; ++y) {
    for (int x = y < whole_y ? whole_x : 0; x < image.cols; ++x)
      out.at<std::uint8_t>(x, y) = image.at<std::uint8_t>(y, x);
  }
}

}  // namespace

void EdgeProfile::SetImage(const cv::Mat& image) {
  image_ = image;
  Transpose(image, transposed_);
}

EdgeSums EdgeProfile::Sum(const AxisLine& line, int first, int last) const {
  constexpr int kRowsAhead = 6;
  const cv::Mat& rows = line.steep ? image_ : transposed_;
  first = std::max(first, 0);
  last = std::min(last, rows.rows - 1);
  ProfileLanes lanes;
  int n = 0, along = 0, remainder = 0;
  auto across = static_cast<std::int64_t>(line.Across(first) * kOne);
  const auto step = static_cast<std::int64_t>(line.slope * kOne);
  const std::uint8_t* row = rows.ptr(0) + first * rows.step[0];
  for (int t = first; t <= last; ++t, across += step, row += rows.step[0]) {
    const int pixel = static_cast<int>(across >> kFraction);
    if (pixel < EdgeKernel::kCentre || pixel + EdgeKernel::kTaps - EdgeKernel::kCentre > rows.cols) continue;
    const int phase = static_cast<int>(across >> kPhaseShift) & (EdgeKernelSet::kPhases - 1);
    remainder += static_cast<int>((across & kInPhase) >> kRemainderShift);
    __builtin_prefetch(row + kRowsAhead * rows.step[0] + pixel);
    AddRow(row + pixel - EdgeKernel::kCentre, line.wide->phases[phase], line.narrow->phases[phase], lanes);
    along += t;
    ++n;
  }
  EdgeSums sums;
  if (n == 0) return sums;
  Reduce(lanes, line.sign / float(EdgeKernel::kScale), sums);
  sums.rows = float(n);
  sums.along = float(along) / sums.rows;
  sums.inverse = sums.strength != 0 ? 1 / sums.strength : 0;
  // The kernels of the nearest phase were used; this brings the sums to the line itself.
  const float mean = float(remainder) / sums.rows - 0.5F * (1 << kRemainderBits);
  const float offset = mean / (EdgeKernelSet::kPhases << kRemainderBits);
  for (int i = 0; i < 2; ++i) sums.imbalance[i] -= offset * sums.sharpness[i];
  return sums;
}

}  // namespace priamos::head
