"""Figures of the station: how drives end, in Chromium too; from key to wheel; what pages and server cost.

usage: station_bench.py BIN ROBOT PORT UP_JSON ROUNDS PART...   (parts: ends browser latency cost frames growth)
"""
import json
import os
import signal
import statistics
import subprocess
import sys
import time

from browser import Browser
from cut_line import CutLine
from station_page import Page, wait_for
from station_rig import ENDS, Rig, report

BIN, ROBOT, PORT, UP, ROUNDS, PARTS = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4], int(sys.argv[5]), sys.argv[6:]
TICK_S = 1 / os.sysconf("SC_CLK_TCK")


def progress(i, n, what):
    if i % 10 == 0:
        print(f"  {what}: {i} of {n}", file=sys.stderr, flush=True)


def measure_ends(rig):
    for how in ENDS:
        took = []
        for i in range(ROUNDS):
            progress(i, ROUNDS, how)
            took.append(rig.seconds_to_stand(how, (-1) ** i))
        report(how, took)


class BrowserHand:
    """A page in Chromium behind a line that can be cut, with a key that is held."""

    def __init__(self, rig):
        self.rig = rig
        self.line = CutLine(rig.port)
        self._begin()

    def _begin(self):
        self.browser = Browser()
        self._open()

    def _open(self):
        self.browser.open_tab(f"http://127.0.0.1:{self.line.port}/")
        self.browser.call("Page.bringToFront")
        wait_for(lambda: "m" in (self.browser.text("robot") or ""), 10)

    def hold(self, key):
        for _ in range(6):
            self.browser.key("down", *key)
            if wait_for(lambda: self.rig.wheels.turning, 3):
                return time.sleep(0.4)
            self.browser.key("up", *key)
            time.sleep(0.5)
        raise SystemExit(f"the wheels do not turn: {self.browser.text('phase')}")

    def end(self, how):
        if how == "tab closed":
            self.browser.close_tab()
        elif how == "tab hidden":
            self.browser.cover_tab()
        elif how == "window without focus":
            self.browser.run("window.dispatchEvent(new Event('blur'))")
        elif how == "network cut":
            self.line.cut()
        elif how == "browser killed":
            self.browser.process.kill()
        elif how == "radio cut":
            os.kill(self.rig.pid_of("offboard-radio"), signal.SIGSTOP)

    def mend(self, how):
        if how == "tab closed":
            self._open()
        elif how == "tab hidden":
            self.browser.uncover_tab()
        elif how == "network cut":
            self.line.mend()
        elif how == "browser killed":
            self.browser.close()
            self._begin()
        elif how == "radio cut":
            os.kill(self.rig.pid_of("offboard-radio"), signal.SIGCONT)


def seconds_to_stand(rig, hand, how, key):
    """And whether it moved again when the way was free, with the key still held."""
    hand.hold(key)
    while not rig.wheels.turning:  # a busy machine loses the hand
        hand.browser.key("up", *key)
        hand.hold(key)
    ended = time.monotonic()
    hand.end(how)
    time.sleep(0.8)
    stood = rig.wheels.last_turn
    hand.mend(how)
    time.sleep(1.2)
    hand.browser.key("up", *key)
    again = rig.wheels.last_turn > stood
    time.sleep(0.3)
    return max(0.0, stood - ended), again


def measure_browser(rig):
    hand = BrowserHand(rig)
    supervisor = int(open(os.path.dirname(UP) + "/up.lock", encoding="utf-8").readline())
    for how in ("tab closed", "tab hidden", "window without focus", "network cut", "browser killed", "radio cut"):
        took, again = [], 0
        if how == "radio cut":
            os.kill(supervisor, signal.SIGSTOP)  # it would start a silent radio again
        for i in range(ROUNDS):
            progress(i, ROUNDS, how)
            seconds, moved = seconds_to_stand(rig, hand, how, ("KeyW", "w") if i % 2 == 0 else ("KeyS", "s"))
            took.append(seconds)
            again += moved
        if how == "radio cut":
            os.kill(supervisor, signal.SIGCONT)
        report(how, took)
        print(f"{how}: moved again while the key was still held: {again}", flush=True)
    hand.browser.close()


def measure_latency(rig):
    """From the push on a page that drove before to the first wheel command, and from letting go to the last one."""
    page = rig.drive()
    page.let_go()
    begins, ends = [], []
    for i in range(ROUNDS):
        wait_for(lambda: not rig.wheels.turning, 3)
        time.sleep(0.15 + 0.013 * (i % 10))
        pushed = time.monotonic()
        page.push(0.6 if i % 2 == 0 else -0.6)
        if wait_for(lambda: rig.wheels.turning, 3):
            begins.append(rig.wheels.first_turn - pushed)
        time.sleep(0.25)
        page.let_go()
        released = time.monotonic()
        wait_for(lambda: not rig.wheels.turning, 3)
        ends.append(max(0.0, rig.wheels.last_turn - released))
    for what, took in (("push to first wheel command", begins), ("letting go to last wheel command", ends)):
        print(f"{what}: {len(took)} of {ROUNDS}, median {1000 * statistics.median(took):.0f} ms, "
              f"95 % {1000 * sorted(took)[int(0.95 * len(took))]:.0f} ms, worst {1000 * max(took):.0f} ms", flush=True)
    page.close()


def cpu_s(pid):
    with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * TICK_S


def memory_mb(pid):
    with open(f"/proc/{pid}/status", encoding="utf-8") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS")) / 1000


def measure_cost(rig):
    """Four viewers and a driver."""
    pid = rig.pid_of("offboard-console")
    viewers = [Page(PORT) for _ in range(4)]
    for viewer in viewers:
        viewer.talks = False
        viewer.say({"type": "listen", "channel": "SONAR_RANGES", "on": True})
    driver = rig.drive(0.2)
    before, began = cpu_s(pid), time.monotonic()
    for i in range(20):
        time.sleep(1)
        driver.push(0.2 if i % 2 == 0 else -0.2)
    share = (cpu_s(pid) - before) / (time.monotonic() - began)
    print(f"server with 4 viewers and a driver: {100 * share:.1f} % of a core, {memory_mb(pid):.0f} MB", flush=True)
    for page in (*viewers, driver):
        page.close()


def floor_parts(side_m):
    """FLOOR_MAP of a floor of rooms of 4 m."""
    cell, n = 0.2, round(side_m / 0.2)
    runs = [{"row": r, "first": c, "length": 19} for r in range(n) if r % 20 != 0 for c in range(1, n, 20)]
    walls = [{"x1_m": x, "y1_m": y, "x2_m": x + 3, "y2_m": y} for x in range(0, side_m, 4) for y in range(0, side_m, 4)]
    walls += [{"x1_m": x, "y1_m": y, "x2_m": x, "y2_m": y + 3} for x in range(0, side_m, 4) for y in range(0, side_m, 4)]
    n_parts = max(-(-len(runs) // 100), -(-len(walls) // 24))
    for i in range(n_parts):
        yield {"revision": 1, "part": i, "n_parts": n_parts, "cell_m": cell, "x_m": 0, "y_m": 0,
               "walls": walls[24 * i:24 * i + 24], "runs": runs[100 * i:100 * i + 100], "frontiers": []}


def publish(channel, kind, message):
    message["utime"] = int(time.time() * 1e6)
    for field in ("walls", "runs", "frontiers"):
        message[f"n_{field}"] = len(message[field])
    subprocess.run([BIN + "/priamos", "topic", "pub", channel, kind, json.dumps(message), "--bus", "offboard", "--robot", ROBOT],
                   check=True, stdout=subprocess.DEVNULL)


def frames_per_s(browser, seconds=5):
    return browser.run("new Promise((done) => { let n = 0; const t = performance.now(); const step = () => { ++n; "
                       f"if (performance.now() - t < {1000 * seconds}) requestAnimationFrame(step); else done(n / {seconds}); }}; step(); }})")


def measure_frames(rig):
    """With a floor of 32 m x 32 m, on a machine that draws in software."""
    for part in floor_parts(32):
        publish("FLOOR_MAP", "floor_map_t", part)
    browser = Browser()
    browser.call("Page.navigate", url=f"http://127.0.0.1:{rig.port}/")
    wait_for(lambda: "m" in (browser.text("robot") or ""), 10)
    paint = browser.run("performance.getEntriesByName('first-contentful-paint')[0]?.startTime")
    print(f"first paint: {paint:.0f} ms", flush=True)
    for view in ("plan", "space", "plots"):
        browser.click(f"show-{view}")
        time.sleep(1)
        browser.click("fit") if view == "plan" else None
        print(f"{view}: {frames_per_s(browser):.1f} frames/s", flush=True)
    browser.close()


def measure_growth(rig):
    """A recorded run at 24 times its rate onto the station's bus, ROUNDS minutes long, with plan and plots open in a page each."""
    pid = rig.pid_of("offboard-console")
    browsers = [Browser(), Browser()]
    for browser in browsers:
        browser.call("Page.navigate", url=f"http://127.0.0.1:{rig.port}/")
        wait_for(lambda: "m" in (browser.text("robot") or ""), 10)
    browsers[1].click("show-plots")
    field = "[...document.querySelectorAll('.fields details[data-channel=POSE] button')].find((b) => b.textContent === 'x_m')"
    wait_for(lambda: browsers[1].run(f"{field} !== undefined"), 5)
    browsers[1].run(f"{field}.click()")
    log, played = os.environ["RECORDED"], 0
    began, lines = time.monotonic(), []
    while time.monotonic() < began + 60 * ROUNDS:
        subprocess.run([BIN + "/priamos", "log", "play", log, "--speed", "24", "--bus", "offboard", "--robot", ROBOT],
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        played += 1
        if time.monotonic() > began + 30 * (len(lines) + 1):
            for browser in browsers:
                browser.call("HeapProfiler.collectGarbage")
            lines.append([memory_mb(pid)] + [browser.run("performance.memory.usedJSHeapSize / 1e6") for browser in browsers])
            print(f"  {len(lines) / 2} min, played {played} times: server, plan, plots [MB]: "
                  + ", ".join(f"{n:.1f}" for n in lines[-1]), file=sys.stderr, flush=True)
    first, last = lines[len(lines) // 4], lines[-1]
    print(f"{ROUNDS} minutes at 24 times the rate, from a quarter on: "
          + ", ".join(f"{what} {a:.1f} -> {b:.1f} MB" for what, a, b in zip(("server", "plan", "plots"), first, last)), flush=True)
    for browser in browsers:
        browser.close()


def main():
    rig = Rig(BIN, ROBOT, PORT, UP)
    parts = {"ends": measure_ends, "browser": measure_browser, "latency": measure_latency, "cost": measure_cost,
             "frames": measure_frames, "growth": measure_growth}
    for part in PARTS:
        parts[part](rig)
    rig.wheels.close()


main()
