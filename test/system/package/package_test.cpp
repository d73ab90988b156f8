// The bus as others install it: a project outside the tree finds it, is built against it, and runs.

#include <gmock/gmock.h>

#include <cstdio>

#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

class BusPackage : public testing::Test {
 protected:
  ShellAnswer Run(const std::string& script, int seconds) const {
    return RunInPrivateNetwork("DIR=" + folder_.path().string() + "\nBUILD=" PRIAMOS_BINARY_DIR "\n" + script,
                               folder_ / "script.sh", seconds);
  }
  const TemporaryFolder folder_;
};

/// Processor seconds of building the project, over those of compiling a file that includes <regex>.
double BuildOverSmallFile(const std::string& answer) {
  double user_s = 0, system_s = 0, small_user_s = 0, small_system_s = 0;
  const auto at = answer.find("processor time: ");
  if (at == std::string::npos || std::sscanf(answer.c_str() + at, "processor time: %lf %lf %lf %lf end",
                                             &user_s, &system_s, &small_user_s, &small_system_s) != 4)
    return 1e9;
  return (user_s + system_s) / (small_user_s + small_system_s);
}

TEST_F(BusPackage, AProjectOutsideTheTreeIsBuiltAgainstItAndRuns) {
  const auto answer = Run(R"sh(
    for file in install_manifest.txt install_folders.txt; do touch $DIR/$file; done
    cp -r $SOURCE/bus/package/example $DIR/weather
    DESTDIR= cmake --install $BUILD --component priamos_bus --prefix $DIR/installed > $DIR/install.txt || cat $DIR/install.txt
    export CCACHE_DISABLE=1 TIMEFORMAT='%U %S'
    printf '#include <regex>\nint main() { return std::regex_match("a", std::regex("[a-z]+")); }\n' > $DIR/small.cpp
    { time c++ -std=c++20 -c $DIR/small.cpp -o $DIR/small.o; } 2> $DIR/small.txt
    cmake -S $DIR/weather -B $DIR/build -DCMAKE_PREFIX_PATH=$DIR/installed > $DIR/configure.txt 2>&1 || cat $DIR/configure.txt
    { time cmake --build $DIR/build -j2 > $DIR/make.txt 2>&1 || cat $DIR/make.txt; } 2> $DIR/built.txt
    echo "processor time: $(tail -1 $DIR/built.txt) $(tail -1 $DIR/small.txt) end"
    grep -liE 'opencv|mrpt|ceres' $DIR/build/CMakeCache.txt && echo "needs what only the robot needs"
    $DIR/build/weather-station --bus onboard --set speed_m_s=12.5 2> $DIR/station.txt & STATION=$!
    timeout 20 $BIN/priamos topic echo WIND speed_m_s --bus onboard --types $DIR/weather/lcm --count 2
    timeout 20 $BIN/priamos log record $DIR/wind.lcmlog --bus onboard --seconds 1.2 --no-health > /dev/null
    echo "$($DIR/build/weather-log $DIR/wind.lcmlog) events in the log"
    kill $STATION; wait $STATION; echo "station $?"
    $DIR/build/weather-station --interface | grep WIND
  )sh",
                          240);
  // A minute, on a machine that takes 15 s for that file; no ratio of two times of one machine hangs on its
  // speed.
  EXPECT_LT(BuildOverSmallFile(answer.text), 4) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("12.5\n12.5\n"));
  EXPECT_THAT(answer.text, testing::Not(HasSubstr("only the robot"))) << "OpenCV, MRPT or Ceres";
  EXPECT_THAT(answer.text, HasSubstr("station 0"));
  EXPECT_THAT(answer.text, testing::ContainsRegex("\n([5-9]|[1-9][0-9]) events in the log"));
  EXPECT_THAT(answer.text, testing::ContainsRegex("out +WIND +wind_t"));
}

}  // namespace
}  // namespace priamos
