#include "teleop/core/terminal_view.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

namespace priamos::teleop {
namespace {

using testing::HasSubstr;
using testing::Not;

TerminalView Driving() {
  TerminalView view;
  view.device = "space-mouse";
  view.stick.axis = {0.5, -1, 0, 0, 0, 0.25};
  view.stick.buttons = 1;
  view.phase = PilotPhase::kDriving;
  view.answer_age_s = 0.3;
  view.lease = "ours";
  view.doing = "operated";
  view.limit = "sonars";
  view.allowed = 0.4;
  view.nearest_m = 0.32;
  return view;
}

TEST(TerminalView, ShowsAxesButtonsLeaseAndAge) {
  const std::string text = Draw(Driving());
  EXPECT_THAT(text, HasSubstr("forward  ....................|##########.......... +0.50"));
  EXPECT_THAT(text, HasSubstr("left     ####################|.................... -1.00"));
  EXPECT_THAT(text, HasSubstr("[dead-man]"));
  EXPECT_THAT(text, HasSubstr("lease    ours"));
  EXPECT_THAT(text, HasSubstr("answered 0.3 s ago: operated"));
  EXPECT_THAT(text, HasSubstr("sonars (40 % of the wish left, 0.32 m free ahead)"));
}

TEST(TerminalView, SaysWhenTheRobotHasNotAnswered) {
  TerminalView view = Driving();
  view.answer_age_s.reset();
  EXPECT_THAT(Draw(view), HasSubstr("no answer yet"));
  EXPECT_THAT(Draw(view), Not(HasSubstr("ours")));
}

TEST(TerminalView, TheEstopIsNotOverlooked) {
  TerminalView view = Driving();
  view.estop = true;
  EXPECT_THAT(Draw(view), HasSubstr("e-stop   *** LATCHED ***"));
}

TEST(TerminalView, SaysWhatToDoNext) {
  TerminalView view = Driving();
  view.phase = PilotPhase::kIdle;
  EXPECT_THAT(Draw(view), HasSubstr("hold the dead-man and push"));
  view.device = "keyboard";
  EXPECT_THAT(Draw(view), HasSubstr("press and hold a key")) << "it has no dead-man";
  view.phase = PilotPhase::kMustLetGo;
  EXPECT_THAT(Draw(view), HasSubstr("let go of the stick"));
  view.estop = true;
  EXPECT_THAT(Draw(view), HasSubstr("let go of everything, then hold re-arm"));
}

TEST(TerminalView, ShowsWhatEachAxisMovesInThisMode) {
  TerminalView view = Driving();
  view.uses = Uses(PilotConfig(), PilotMode::kBase);
  EXPECT_THAT(Draw(view), HasSubstr("+0.25  turn\n"));
  EXPECT_THAT(Draw(view), Not(HasSubstr("tilt")));
  view.uses = Uses(PilotConfig(), PilotMode::kHead);
  EXPECT_THAT(Draw(view), HasSubstr("+0.25  pan\n"));
}

TEST(TerminalView, HasAlwaysAsManyLinesAndFitsTheTerminal) {
  TerminalView longest = Driving();
  longest.mode = PilotMode::kHead;
  longest.head_wish = {-0.5, -0.5, -0.5, -1000, -1000};
  longest.refused = 4095;
  longest.refusal = "let the stick go first";
  longest.estop = true;
  for (const TerminalView& view : {TerminalView{}, Driving(), longest}) {
    std::istringstream text(Draw(view));
    std::string line;
    int lines = 0;
    while (std::getline(text, line)) {
      ++lines;
      EXPECT_LE(line.size(), 100u) << line;
    }
    EXPECT_EQ(lines, 15);
  }
}

}  // namespace
}  // namespace priamos::teleop
