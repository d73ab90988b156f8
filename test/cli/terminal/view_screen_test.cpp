#include "cli/terminal/view_screen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

const Time kNow = FromUtime(1'000'000'000);

landmark_view_t View() {
  landmark_view_t view{};
  view.utime_exposure = ToUtime(kNow) - 1'500'000;
  view.request_id = 7;
  view.landmark_id = 1;
  view.side = 1;
  view.n_left_out = 3;
  for (const int kind : {0, 0, 1, 2}) {
    view_edge_t edge{};
    edge.kind = static_cast<std::int8_t>(kind);
    edge.u1_px = edge.u2_px = 100.0F + 100.0F * static_cast<float>(kind);
    edge.v2_px = 500;
    view.edges.push_back(edge);
  }
  view.n_edges = static_cast<std::int8_t>(view.edges.size());
  return view;
}

landmark_fix_t Fix() {
  landmark_fix_t fix{};
  fix.request_id = 7;
  fix.n_matched = 12;
  fix.residual_px = 0.25;
  fix.sigma_x_m = 0.003;
  fix.sigma_y_m = 0.004;
  return fix;
}

TEST(ViewScreenTest, SaysWhatItWaitsFor) {
  EXPECT_THAT(ViewScreen().Render(kNow, {}, true), HasSubstr("waiting for LANDMARK_VIEW"));
}

TEST(ViewScreenTest, NamesVerdictAgeAndEdges) {
  ViewScreen dut;
  dut.Add(View());
  dut.Add(Fix());
  const std::string text = dut.Render(kNow, {}, false);
  EXPECT_THAT(text, HasSubstr("look 7: landmark 1, left side: FOUND; 12 edges, 0.25 px, 5.0 mm"));
  EXPECT_THAT(text,
              HasSubstr("left camera: 2 edges expected (dotted), 1 matched (green), 1 rejected (red), 3\n"
                        "  more not shown"));
  EXPECT_THAT(text, HasSubstr("1.5 s ago"));
}

TEST(ViewScreenTest, TheFixOfAnotherLookIsNotMixedIn) {
  ViewScreen dut;
  landmark_fix_t fix = Fix();
  fix.request_id = 6;
  dut.Add(fix);
  dut.Add(View());
  EXPECT_THAT(dut.Render(kNow, {}, false), Not(HasSubstr("12 edges")));
}

TEST(ViewScreenTest, ALookThatFailedSaysWhy) {
  landmark_view_t view = View();
  view.verdict = landmark_fix_t::TOO_FEW_EDGES;
  view.camera = 1;
  EXPECT_THAT(ViewTitle(view, nullptr), HasSubstr("not found, too few edges"));
  EXPECT_THAT(ViewLegend(view), HasSubstr("right camera"));
}

TEST(ViewScreenTest, FitsTheTerminal) {
  ViewScreen dut;
  dut.Add(View());
  for (const ScreenSize size : {ScreenSize{80, 24}, ScreenSize{200, 50}, ScreenSize{40, 60}}) {
    const std::string text = dut.Render(kNow, size, false);
    EXPECT_LT(Lines(text), size.rows);
    EXPECT_GT(Lines(text), 10);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(Characters(line), size.columns) << line;
  }
}

TEST(ViewScreenTest, TellsWhatTheLaserShowsOfTheFloor) {
  obstacle_line_t line{};
  line.utime_exposure = ToUtime(kNow) - 400'000;
  line.seen_share = 0.9F;
  EXPECT_THAT(FloorText(line, 0.4, 80), HasSubstr("floor: clear; 90 % of the line seen 0.4 s ago"));
  line.verdict = obstacle_line_t::OBSTACLE;
  line.n_segments = 1;
  line.segments.resize(1);
  line.segments[0].kind = obstacle_segment_t::UP;
  line.segments[0].x1_m = line.segments[0].x2_m = 2;
  line.segments[0].y1_m = -1;
  line.segments[0].y2_m = -0.5;
  line.segments[0].height_m = 0.03F;
  ViewScreen dut;
  dut.Add(line);
  EXPECT_FALSE(dut.empty());
  const std::string text = dut.Render(kNow, {}, false);
  EXPECT_THAT(text, HasSubstr("OBSTACLE; UP 3.0 cm 2.0 m ahead, from -0.50 to -1.00 m"));
  EXPECT_THAT(text, HasSubstr("--^^^^^^^^^^^^^^^^| right"));
}

TEST(ViewScreenTest, AShortLineShowsTheWholeFloor) {
  obstacle_line_t line{};
  line.n_segments = 1;
  line.segments.resize(1);
  line.segments[0].kind = obstacle_segment_t::UP;
  line.segments[0].y1_m = 1;
  line.segments[0].y2_m = 0;
  EXPECT_THAT(FloorText(line, 0.4, 40), HasSubstr("left |^^^^^^^^^^^^^^-------------| right"));
}

TEST(ViewScreenTest, EachKindHasItsColourWhereItLies) {
  const std::string text = DrawView(View(), {80, 20}).Text(true);
  const auto green = text.find("\x1b[1;32m"), red = text.find("\x1b[31m");
  ASSERT_NE(green, std::string::npos);
  ASSERT_NE(red, std::string::npos);
  EXPECT_LT(green, red);  // 200 px and 300 px from the left
}

}  // namespace
}  // namespace priamos::cli
