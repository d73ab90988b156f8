// The station with the whole robot behind the radio: driven from pages, and looked at in Chromium.

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "test/system/robot_shell.hpp"

namespace priamos {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// `up`: everything of config/sim; `down`; both quiet.
const std::string kHelpers = R"sh(
export PYTHONPATH=$SOURCE/test/support PYTHONDONTWRITEBYTECODE=1
up() {
  $BIN/priamos up $SOURCE/config/sim --logs $LOGS --detach > /dev/null || echo failed
  for i in $(seq 200); do $BIN/priamos status --logs $LOGS > /dev/null && return; sleep 0.1; done
}
down() { $BIN/priamos down --logs $LOGS > /dev/null; }
)sh";

class Station : public RobotShell {
 protected:
  Station() : RobotShell(kHelpers) {}
};

TEST_F(Station, HoweverADriveEndsTheWheelsStandWithinThreeTenthsOfASecond) {
  const auto answer = RunScript(R"sh(
    up; python3 $SOURCE/test/support/station_driving.py $BIN priamos 8080 2 $LOGS/up.json; down
  )sh",
                                180);
  for (const char* how : {"released", "tab closed", "silent", "stop", "delayed", "station killed"})
    EXPECT_THAT(answer.text, HasSubstr(std::string(how) + ": 2 of 2 within 0.300 s"));
  EXPECT_THAT(answer.text, HasSubstr("key held while a page connects: wheels stand"));
}

/// The pictures of every view stay in build/station-views.
TEST_F(Station, IsSeenAndUsedInABrowser) {
  const std::string views = PRIAMOS_BINARY_DIR "/station-views";
  std::filesystem::create_directories(views);
  const auto answer = RunScript("VIEWS=" + views + R"sh(
    up; python3 $SOURCE/test/support/station_views.py http://127.0.0.1:8080/ $VIEWS $BIN priamos; down
  )sh",
                                240);
  for (const char* seen : {"connected: station connected",
                           "key drives: True",
                           "blur ends the drive: True",
                           "held key goes on after it: False",
                           "command key ends the drive: True",
                           "held key goes on after the command key: False",
                           "stick drives: True",
                           "released stick ends the drive: True",
                           "left button drives: True",
                           "left button let go ends the drive: True",
                           "space bar stops: True",
                           "held button re-arms: True",
                           "mission starts: True",
                           "edges are seen: True",
                           "space is drawn: True",
                           "fields are offered: True",
                           "numbers with units: True",
                           "numbers change: True",
                           "charts are drawn: True",
                           "held charts stand: True",
                           "one is taken away: True",
                           "mission is aborted: True",
                           "heading by a drag: 45",
                           "chosen once: false",
                           "drives to a place: True",
                           "a pose is not set on the way: True",
                           "a robot at rest is told its pose: True",
                           "places are chosen: True",
                           "progress is shown: True",
                           "an order waits: True",
                           "it is paused: True",
                           "what waits is cancelled: True",
                           "it goes on: True",
                           "ends are listed: True",
                           "corridor distances: [True, True, False, False, False]",
                           "rounds: [True, True, False, False, False, False]",
                           "what is allowed: x m: allowed: a number, -100 … 100",
                           "Enter ticks: True",
                           "a slider takes no letters: True",
                           "a field says that it takes keys: True",
                           "the head says where it looks: True",
                           "it looks there: True",
                           "it looks ahead: True",
                           "an alarm is shown: True",
                           "in the head of the page, too: 1 alarm",
                           "then no more: True",
                           "who acknowledged it: True",
                           "parameters are shown: True",
                           "of every process: True",
                           "live parameters are shown: True",
                           "an order is under way: True",
                           "a new value is in force: True",
                           "it is not saved: True",
                           "a bold value is refused: True",
                           "all is as in the file: True",
                           "German: True",
                           "complaints: []",
                           "dark fits: True",
                           "phone fits: True",
                           "phone speaks: Fahren",
                           "tablet fits: True"})
    EXPECT_THAT(answer.text, HasSubstr(seen));
  EXPECT_GT(std::filesystem::file_size(views + "/mission.png"), 20'000u);
}

TEST_F(Station, ProcessesAreLookedAfterAndAWorldBeginsAnewInABrowser) {
  const std::string views = PRIAMOS_BINARY_DIR "/station-views";
  std::filesystem::create_directories(views);
  const auto answer = RunScript("VIEWS=" + views + R"sh(
    up; python3 $SOURCE/test/support/station_processes.py $BIN http://127.0.0.1:8080/ $VIEWS; down
  )sh",
                                240);
  for (const char* seen : {"every process is listed: True",
                           "and is well: True",
                           "lines of offboard-planner: True",
                           "lines of onboard-robot: True",
                           "a double click restarts: False",
                           "restart is under way: True",
                           "it was started again: True",
                           "it is well again: True",
                           "processes-dark fits: True",
                           "processes-dark complaints: []",
                           "processes-phone fits: True",
                           "processes-phone complaints: []",
                           "the base drives: True",
                           "emergency stop is latched: True",
                           "the base stands: True",
                           "and goes on standing with the key held: True",
                           "it is still stopped: True",
                           "it is re-armed: True",
                           "and drives again: True",
                           "worlds are offered: True",
                           "the base drives in the old world: True",
                           "it says what goes on: True",
                           "the station is away for a moment: True",
                           "and is back by itself: True",
                           "a key held all the while moves nothing: True",
                           "nothing is stopped, no mission left: True",
                           "the plan is the new one: True",
                           "the base drives in the new world: True",
                           "complaints: []"})
    EXPECT_THAT(answer.text, HasSubstr(seen));
}

TEST_F(Station, TheTutorialIsDoneStepByStep) {
  const std::string views = PRIAMOS_BINARY_DIR "/station-views/tutorial";
  std::filesystem::create_directories(views);
  const auto answer = RunScript("VIEWS=" + views + R"sh(
    up; mkdir $LOGS.work; cd $LOGS.work; ln -s $SOURCE/config config
    PATH=$BIN:$PATH PRIAMOS_LOGS=$LOGS python3 $SOURCE/test/support/tutorial.py $SOURCE/modules/console/TUTORIAL.md $VIEWS
    down
  )sh",
                                240);
  EXPECT_THAT(answer.text, ContainsRegex("steps: [0-9]+, failed: \\[\\], pictures without a step: \\[\\]"));
}

TEST_F(Station, ShowsALogInABrowser) {
  const std::string views = PRIAMOS_BINARY_DIR "/station-views";
  std::filesystem::create_directories(views);
  const auto answer = RunScript("VIEWS=" + views + R"sh(
    $BIN/priamos replay show $SOURCE/logs/recorded/door-offboard.lcmlog --deployment $SOURCE/config/sim \
      --paused --port 0 --json > $LOGS.address & SHOW=$!
    for i in $(seq 100); do [ -s $LOGS.address ] && break; sleep 0.05; done
    python3 $SOURCE/test/support/replay_views.py $(grep -o 'http[^"]*' $LOGS.address) $VIEWS
    kill -INT $SHOW; wait $SHOW; echo "ended: $?"
  )sh",
                                60);
  for (const char* seen :
       {"paused at the beginning: True", "plays: True", "seeks: True", "states after a seek: True",
        "plots the log's numbers: True", "space is drawn: True", "complaints: []", "ended: 0"})
    EXPECT_THAT(answer.text, HasSubstr(seen));
}

TEST_F(Station, FoxgloveSeesTheRobotAndOrdersIt) {
  const auto answer = RunScript(R"sh(
    up; python3 $SOURCE/test/support/foxglove_station.py 8080; down
  )sh",
                                90);
  for (const char* seen :
       {"says who it is: True", "topics are offered: True", "schemas of the panels: True",
        "schema of a type: True", "pose comes: True", "and as a transform: True", "plan comes: True",
        "sonars are asked for over the radio: True", "time goes on: True", "an order is taken: True",
        "and obeyed: True", "path is drawn: True", "nonsense is refused: True", "parameters are shown: True",
        "a parameter is changed through the radio: True", "stop stops: True",
        "nobody looks, nothing comes: True", "a page of another origin: refused", "warnings: []"})
    EXPECT_THAT(answer.text, HasSubstr(seen));
}

TEST_F(Station, AnyBusIsServedWithTypesThatNothingWasCompiledWith) {
  const auto answer = RunScript(R"sh(
    mkdir $LOGS.types
    echo 'package farm; struct tank_t { double level_m; // [m]: of the milk
    }' > $LOGS.types/tank_t.lcm
    BUS='udpm://239.255.76.70:7770?ttl=0'
    $BIN/priamos topic serve --bus $BUS --types $LOGS.types --port 0 --json > $LOGS.address & SERVE=$!
    for i in $(seq 100); do [ -s $LOGS.address ] && break; sleep 0.05; done
    (while sleep 0.1; do $BIN/priamos topic pub TANK tank_t '{"level_m":1.5}' --bus $BUS --types $LOGS.types; done) & PUB=$!
    PORT=$(grep -o ':[0-9]*/' $LOGS.address | tr -d ':/') python3 - <<'PY'
import json, os, urllib.request
from foxglove_client import Foxglove
from station_page import Page, wait_for
port = int(os.environ["PORT"])
client = Foxglove(port)
print("channel is offered:", wait_for(lambda: client.channels.get("TANK", {}).get("schemaName") == "farm.tank_t", 5))
client.subscribe("TANK")
print("message comes:", wait_for(lambda: client.newest.get("TANK") == {"level_m": 1.5}, 5))
page = Page(port)
print("page gets it:", wait_for(lambda: page.messages.get("TANK") == {"level_m": 1.5}, 5))
schema = json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/types/farm.tank_t.json"))
print("unit:", schema["properties"]["level_m"]["description"])
PY
    kill $PUB; kill -INT $SERVE; wait $SERVE; echo "ended: $?"
  )sh",
                                40);
  for (const char* seen : {"channel is offered: True", "message comes: True", "page gets it: True",
                           "unit: [m] of the milk", "ended: 0"})
    EXPECT_THAT(answer.text, HasSubstr(seen));
}

TEST_F(Station, EverythingOnThePageComesOverTheRadio) {
  const auto answer = RunScript(R"sh(
    up
    kill -STOP $(head -1 $LOGS/up.lock)  # which would start a silent radio again
    kill -STOP $(pid_of offboard-radio)
    python3 - <<'PY'
import time
from station_page import Page, wait_for
page = Page(8080)
time.sleep(1)
before = dict(page.messages)
time.sleep(2)
came = sorted(c for c, m in page.messages.items() if before.get(c) != m)
print("came without the radio:", came)
PY
    kill -CONT $(pid_of offboard-radio) $(head -1 $LOGS/up.lock); down
  )sh",
                                60);
  // Of the workstation itself: its processes, and what its planner does.
  EXPECT_THAT(answer.text,
              ContainsRegex("came without the radio: \\[('ALARM', )?'HEALTH', 'MISSION_STATUS'\\]"));
}

TEST_F(Station, IsServedEncryptedWithACertificate) {
  const auto answer = RunScript(R"sh(
    openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj /CN=station \
      -keyout $LOGS.key -out $LOGS.pem 2> /dev/null
    echo "driver abcdefghijklmnop" > $LOGS.tokens; chmod 600 $LOGS.tokens $LOGS.key
    $BIN/priamos-console --config $SOURCE/config/sim/console.toml --set 'address="0.0.0.0"' --set port=8443 --set ports=1 \
      --set "token_file=\"$LOGS.tokens\"" --set "certificate_file=\"$LOGS.pem\"" --set "key_file=\"$LOGS.key\"" &
    STATION=$!
    python3 - <<'PY'
import urllib.error, urllib.request
from browser import Browser
from station_page import wait_for
def plainly():
    try:
        return urllib.request.urlopen("http://127.0.0.1:8443/", timeout=1).read()
    except urllib.error.HTTPError as refusal:
        return refusal.read().decode().strip()
    except OSError:
        return None
wait_for(plainly, 10)
print("plainly:", plainly())
browser = Browser()
browser.call("Security.setIgnoreCertificateErrors", ignore=True)
browser.call("Page.navigate", url="https://127.0.0.1:8443/?token=abcdefghijklmnop")
print("page is connected:", wait_for(lambda: "connected" in (browser.text("connection") or ""), 10))
print("socket:", browser.run("performance.getEntriesByType('resource').every(r => r.name.startsWith('https:'))"))
browser.close()
PY
    kill -INT $STATION; wait $STATION; echo "ended: $?"
  )sh",
                                60);
  for (const char* seen :
       {"plainly: expected https:// at the beginning", "page is connected: True", "socket: True", "ended: 0"})
    EXPECT_THAT(answer.text, HasSubstr(seen));
}

TEST_F(Station, StrangersOnTheNetworkAreKeptOut) {
  const auto answer = RunScript(R"sh(
    console() { $BIN/priamos-console --config $SOURCE/config/sim/console.toml "$@"; }
    console --set 'address="0.0.0.0"'; echo "without tokens: $?"
    echo "driver shared" > $LOGS.tokens; chmod 600 $LOGS.tokens
    console --set 'address="0.0.0.0"' --set "token_file=\"$LOGS.tokens\""; echo "bad token: $?"
    console --set "key_file=\"$LOGS.key\""; echo "half of a pair: $?"
    console --set port=1 --set ports=1 --set 'address="127.0.0.77"'; echo "no port: $?"
  )sh",
                                30);
  EXPECT_THAT(answer.text, HasSubstr("address 0.0.0.0: expected a token_file"));
  EXPECT_THAT(answer.text, HasSubstr("without tokens: 2"));
  EXPECT_THAT(answer.text, HasSubstr("tokens:1: expected `driver TOKEN [NAME]`"));
  EXPECT_THAT(answer.text, HasSubstr("bad token: 2"));
  EXPECT_THAT(answer.text, HasSubstr("half of a pair: 2"));
}

TEST_F(Station, WhatItsAuditFileLacksIsSaid) {
  const auto answer = RunScript(R"sh(
    $BIN/priamos-console --config $SOURCE/config/sim/console.toml --set 'audit_file="/dev/full"' --set port=8095 --set ports=1 &
    STATION=$!
    python3 - <<'PY'
import time
from station_page import Page, wait_for
def page():
    try:
        return Page(8095)
    except OSError:
        return None
wait_for(page, 10)
time.sleep(2.5)
PY
    kill -INT $STATION; wait $STATION; echo "ended: $?"
  )sh",
                                30);
  EXPECT_THAT(answer.text, HasSubstr("audit_file /dev/full cannot be written: "));
  EXPECT_THAT(answer.text, HasSubstr("ended: 0"));
}

}  // namespace
}  // namespace priamos
