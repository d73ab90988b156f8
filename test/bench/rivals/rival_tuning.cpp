#include "test/bench/rivals/rival_tuning.hpp"

#include <cmath>

namespace priamos::bench {

void MrptConfig::Describe(Archive& a) {
  a.Number("margin_m", margin_m, {"m", 0, 1, "added to the disc"});
  a.Number("reach_m", reach_m, {"m", 0.5, 10, "beyond this there is nothing"});
  a.Integer("directions", directions, {"-", 9, 1000, "around"});
  a.Number("too_close_m", too_close_m, {"m", 0, 2, "a direction that is free for less is not taken"});
  a.Number("slow_m", slow_m, {"m", 0, 5, "below this it drives the slower"});
  a.Number("wide_gap", wide_gap, {"-", 0, 1, "share of the circle from which on a gap is wide"});
  a.Number("risk_sectors", risk_sectors, {"-", 0, 1, "share of the circle on which its speed depends"});
  a.Numbers("weights", weights, {"-", 0, 100, "of its factors"});
  a.Numbers("thresholds", thresholds, {"-", 0, 1, "of its phases"});
}

void RivalTuning::Describe(Archive& a) {
  a.Text("name", name, "in the table");
  a.Choice("method", method, {"nd", "full_eval", "window"}, "who chooses the velocity");
  a.Choice("shape", shape, {"around", "within", "rectangle"}, "what it takes the base for");
  a.Section("drive", drive, "what it gets beside its method");
  a.Section("mrpt", mrpt, "nd and full_eval");
  a.Section("window", window, "window");
  if (shape == "rectangle" && method != "window") a.Refuse("shape", "a circle, which it needs");
}

double RivalTuning::Radius() const {
  if (shape == "rectangle") return 0;
  return shape == "within" ? kDrawnBody.width_m / 2 : std::hypot(kDrawnBody.length_m, kDrawnBody.width_m) / 2;
}

}  // namespace priamos::bench
