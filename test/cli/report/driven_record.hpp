#pragma once

#include "cli/report/report_record.hpp"

namespace priamos::cli {

/// A base that drives 10 m along x and believes to be so far to the left of where it is.
inline RunRecord DriveAlongX(double left_m) {
  RunRecord record;
  for (int i = 0; i <= 500; ++i) {
    world_truth_t truth{};
    truth.utime = 1'000'000 + i * 20'000;
    truth.x_m = 0.02 * i;
    record.truth.push_back(truth);
    pose_t pose{};
    pose.utime = truth.utime;
    pose.x_m = truth.x_m;
    pose.y_m = left_m;
    record.poses.push_back(pose);
  }
  return record;
}

}  // namespace priamos::cli
