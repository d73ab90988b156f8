"""Looks after the processes of a simulated robot as a person does at the station: how each is, the lines it wrote, a new
start, also while the robot is driven, and a new world.

usage: station_processes.py BIN URL FOLDER
"""
import json
import subprocess
import sys
import threading
import time

from browser import Browser
from station_page import Page, wait_for

BIN, URL, FOLDER = sys.argv[1:4]
PORT = int(URL.rstrip("/").rsplit(":", 1)[1])


class Truth:
    """Where the simulated base truly is, and how fast."""

    def __init__(self):
        self.pose, self.speed, self.heard = None, 0.0, 0.0
        echo = subprocess.Popen([BIN + "/priamos", "topic", "echo", "WORLD_TRUTH", "--bus", "onboard", "--json"],
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        threading.Thread(target=self._read, args=(echo,), daemon=True).start()

    def _read(self, echo):
        for line in echo.stdout:
            truth = json.loads(line)
            self.pose, self.heard = (truth["x_m"], truth["y_m"]), time.monotonic()
            self.speed = max(abs(truth["vx_m_s"]), abs(truth["vy_m_s"]), abs(truth["wz_rad_s"]))

    def stands_for(self, seconds):
        """Whether the base stands all the time."""
        end, fastest = time.monotonic() + seconds, 0.0
        while time.monotonic() < end:
            fastest = max(fastest, self.speed)
            time.sleep(0.01)
        return fastest < 0.005


def report(name, value):
    print(f"{name}: {value}", flush=True)


def row(name):
    return f"document.querySelector('.process[data-name={name}]')"


def summary(browser, name):
    return browser.run(f"{row(name)}?.querySelector('summary').innerText ?? ''")


def inside(browser, name):
    return browser.run(f"{row(name)}?.innerText ?? ''")


def press(browser, name, label):
    """Presses the button with that label in the row of a process."""
    return browser.run(f"(() => {{ const b = [...{row(name)}.querySelectorAll('button')].find((b) => b.textContent.startsWith('{label}')"
                       " && !b.hidden && !b.disabled); b?.click(); return b !== undefined; })()")


def open_row(browser, name):
    browser.run(f"{row(name)}.open = true; {row(name)}.scrollIntoView()")
    time.sleep(0.4)


def load(browser):
    browser.call("Page.navigate", url=URL)
    wait_for(lambda: "m" in (browser.text("robot") or ""), 8)


def health(browser):
    names = ["onboard-robot", "onboard-head", "onboard-radio", "offboard-planner", "offboard-radio", "line"]
    report("every process is listed", wait_for(lambda: all(summary(browser, n) for n in names), 25))
    report("and is well", wait_for(lambda: "good" in summary(browser, "onboard-robot"), 15))
    for name, seconds in (("offboard-planner", 5), ("onboard-robot", 16)):
        open_row(browser, name)
        press(browser, name, "Last lines")
        report(f"lines of {name}", wait_for(lambda: browser.run(f"{row(name)}.querySelector('pre').textContent.length > 10"), seconds))
    browser.picture(FOLDER + "/processes.png")


def restart(browser):
    open_row(browser, "onboard-head")
    press(browser, "onboard-head", "Restart")
    press(browser, "onboard-head", "Really")
    time.sleep(0.3)
    report("a double click restarts", "under way" in inside(browser, "onboard-head"))
    time.sleep(0.5)
    browser.picture(FOLDER + "/restart.png")
    press(browser, "onboard-head", "Really")
    report("restart is under way", wait_for(lambda: "under way" in inside(browser, "onboard-head"), 1))
    report("it was started again", wait_for(lambda: "started again 1" in summary(browser, "onboard-head"), 25))
    report("it is well again", wait_for(lambda: "good" in summary(browser, "onboard-head"), 20))


def drive(page, truth):
    """Whether the base drives: a busy machine refuses commands that are late, and a drive does not begin."""
    for _ in range(3):
        page.push(1)
        if wait_for(lambda: truth.speed > 0.05, 6):
            return True
        page.let_go()
        time.sleep(0.5)
    return False


def key_drives(browser, truth):
    """The same by keyboard; the key stays held."""
    for _ in range(3):
        browser.key("down", "KeyW", "w")
        if wait_for(lambda: truth.speed > 0.05, 6):
            return True
        browser.key("up", "KeyW", "w")
        time.sleep(0.5)
    return False


def restart_while_driving(truth):
    page = Page(PORT)
    wait_for(lambda: page.station and page.messages.get("DRIVE_STATUS"), 5)
    time.sleep(0.3)
    report("the base drives", drive(page, truth))
    page.say({"type": "process", "action": "restart", "name": "onboard-robot"})
    ordered = time.monotonic()
    # The radio carries an order every 5 s.
    report("emergency stop is latched", wait_for(lambda: page.messages["DRIVE_STATUS"]["estop"], 12))
    print(f"measured: known to be stopped {time.monotonic() - ordered:.2f} s after the order at the station")
    report("the base stands", wait_for(lambda: truth.speed < 0.005, 2))
    report("and goes on standing with the key held", truth.stands_for(6))
    page.let_go()
    report("it is still stopped", page.messages["DRIVE_STATUS"]["estop"])
    page.buttons = {"rearm": True}
    report("it is re-armed", wait_for(lambda: not page.messages["DRIVE_STATUS"]["estop"], 5))
    page.let_go()
    time.sleep(0.5)
    report("and drives again", drive(page, truth))
    page.let_go()
    page.close()


def new_world(browser, truth):
    load(browser)
    wait_for(lambda: not browser.run("document.getElementById('world-section').hidden"), 5)
    offers = browser.run("[...document.getElementById('scenario').options].map((o) => o.value)")
    report("worlds are offered", len(offers) >= 5)
    browser.run("(() => { const s = document.getElementById('scenario'); s.value = 'corridor'; s.dispatchEvent(new Event('change')); })()")
    browser.run("document.getElementById('world-section').scrollIntoView()")
    report("the base drives in the old world", key_drives(browser, truth))
    browser.click("new-world")
    time.sleep(0.7)
    browser.picture(FOLDER + "/world.png")
    browser.click("new-world")
    begun = time.monotonic()
    report("it says what goes on", wait_for(lambda: "new world begins" in browser.text("world-text"), 2))
    away = wait_for(lambda: "no connection" in browser.text("connection"), 5)
    if away:
        browser.picture(FOLDER + "/world-begins.png")
    report("the station is away for a moment", away)
    back = wait_for(lambda: browser.text("world-text") == "" and "station connected" in browser.text("connection"), 25)
    report("and is back by itself", back)
    print(f"measured: a new world within {time.monotonic() - begun:.1f} s")
    wait_for(lambda: "radio up" in browser.text("summary") and "0." in browser.text("robot"), 8)
    report("a key held all the while moves nothing", truth.stands_for(3))
    report("nothing is stopped, no mission left", browser.run("document.getElementById('stopped').hidden")
           and "waiting" in browser.text("mission-text"))
    report("the plan is the new one", browser.run("document.getElementById('scenario').value") == "corridor")
    browser.key("up", "KeyW", "w")
    time.sleep(0.5)
    report("the base drives in the new world", key_drives(browser, truth))
    browser.key("up", "KeyW", "w")
    browser.picture(FOLDER + "/corridor.png")


def other_sizes():
    for name, options in {"processes-dark": {"scheme": "dark"},
                          "processes-phone": {"width": 390, "height": 844}}.items():
        browser = Browser(**options)
        load(browser)
        wait_for(lambda: summary(browser, "onboard-robot"), 20)
        if "dark" in name:
            browser.click("language")
        open_row(browser, "onboard-robot")
        label = "Letzte" if "dark" in name else "Last"
        press(browser, "onboard-robot", label)
        wait_for(lambda: browser.run(f"{row('onboard-robot')}.querySelector('pre').textContent.length > 10"), 16)
        press(browser, "onboard-robot", "Neu starten" if "dark" in name else "Restart")
        time.sleep(0.4)
        browser.run(f"{row('onboard-robot')}.scrollIntoView()")
        browser.picture(f"{FOLDER}/{name}.png")
        report(f"{name} fits", browser.run("document.documentElement.scrollWidth <= window.innerWidth"))
        report(f"{name} complaints", browser.complaints)
        browser.close()


truth = Truth()
page = Browser()
load(page)
health(page)
restart(page)
other_sizes()
restart_while_driving(truth)
new_world(page, truth)
report("complaints", [c for c in page.complaints if "WebSocket" not in c])
page.close()
