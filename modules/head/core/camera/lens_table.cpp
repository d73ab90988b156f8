#include "head/core/camera/lens_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace priamos::head {

namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kSlack_steps = 1;  // a motor may rest one step beside its set value

Vector6d ToVector(const LensState& s) {
  return (Vector6d() << std::log(s.focal_px), s.centre_px, s.k1, s.k2, s.pupil_m).finished();
}

LensState FromVector(const Vector6d& v) {
  return {std::exp(v(0)), {v(1), v(2)}, v(3), v(4), v(5)};
}

bool Ascending(const std::vector<int>& steps) {
  return !steps.empty() &&
         std::adjacent_find(steps.begin(), steps.end(), std::greater_equal<>()) == steps.end();
}

/// Nodes that take part at x, and their weights: Lagrange polynomial through the nearest four.
struct Weights {
  std::size_t first;
  std::vector<double> values;
};

Weights LagrangeWeights(const std::vector<int>& steps, double x) {
  const std::size_t n = std::min<std::size_t>(4, steps.size());
  const auto above = std::upper_bound(steps.begin(), steps.end(), x);
  const auto index =
      static_cast<std::ptrdiff_t>(above - steps.begin()) - static_cast<std::ptrdiff_t>(n + 1) / 2;
  const auto last_start = static_cast<std::ptrdiff_t>(steps.size() - n);
  Weights weights{static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, last_start)),
                  std::vector<double>(n, 1.0)};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const double xi = steps[weights.first + i], xj = steps[weights.first + j];
      weights.values[i] *= (x - xj) / (xi - xj);
    }
  }
  return weights;
}

std::string OutsideReason(const char* name, const std::vector<int>& steps, double x) {
  if (x >= steps.front() - kSlack_steps && x <= steps.back() + kSlack_steps) return "";
  return fmt::format("{} {:.0f} is outside of the calibrated {} to {}", name, x, steps.front(), steps.back());
}

}  // namespace

LensTable::LensTable(std::vector<int> zoom_steps, std::vector<int> focus_steps, std::vector<LensState> nodes)
    : zoom_steps_(std::move(zoom_steps)), focus_steps_(std::move(focus_steps)), nodes_(std::move(nodes)) {
  if (!Ascending(zoom_steps_) || !Ascending(focus_steps_)) {
    throw std::invalid_argument("the steps of a lens table must ascend");
  }
  if (nodes_.size() != zoom_steps_.size() * focus_steps_.size()) {
    throw std::invalid_argument("a lens table needs one node for every pair of zoom and focus steps");
  }
}

Outcome<LensState> LensTable::At(double zoom_step, double focus_step) const {
  if (nodes_.empty()) return Refusal{"the lens table is empty"};
  if (!std::isfinite(zoom_step) || !std::isfinite(focus_step)) return Refusal{"the setting is no number"};
  if (auto reason = OutsideReason("zoom", zoom_steps_, zoom_step); !reason.empty()) return Refusal{reason};
  if (auto reason = OutsideReason("focus", focus_steps_, focus_step); !reason.empty()) return Refusal{reason};
  const Weights zoom = LagrangeWeights(zoom_steps_, zoom_step);
  const Weights focus = LagrangeWeights(focus_steps_, focus_step);
  Vector6d sum = Vector6d::Zero();
  for (std::size_t i = 0; i < zoom.values.size(); ++i) {
    for (std::size_t j = 0; j < focus.values.size(); ++j) {
      const std::size_t node = (zoom.first + i) * focus_steps_.size() + focus.first + j;
      sum += zoom.values[i] * focus.values[j] * ToVector(nodes_[node]);
    }
  }
  return FromVector(sum);
}

}  // namespace priamos::head
