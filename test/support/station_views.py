"""Looks at the station as a person does: loads it, drives, stops, and leaves a picture of every view.

usage: station_views.py URL FOLDER BIN ROBOT
"""
import json
import subprocess
import sys
import time

from browser import Browser
from station_page import wait_for

URL, FOLDER, BIN, ROBOT = sys.argv[1:5]


def middle(browser, element):
    return browser.run(f"(() => {{ const r = document.getElementById('{element}').getBoundingClientRect();"
                       " return [r.x + r.width / 2, r.y + r.height / 2]; })()")


def load(browser):
    browser.call("Page.navigate", url=URL)
    wait_for(lambda: "m" in (browser.text("robot") or ""), 8)
    paint = "performance.getEntriesByName('first-contentful-paint')"
    wait_for(lambda: browser.run(paint + ".length > 0"), 5)
    return browser.run(paint + "[0].startTime")


def drives(browser):
    return "you drive" in browser.text("phase")


def raise_alarm():
    """As the head would send it."""
    alarm = {"utime": int(time.monotonic() * 1e6), "severity": 1, "robot": ROBOT, "source": "head", "text": "the left camera is dark"}
    subprocess.run([BIN + "/priamos", "topic", "pub", "ALARM", "alarm_t", json.dumps(alarm), "--bus", "offboard", "--robot", ROBOT],
                   check=True, stdout=subprocess.DEVNULL)


def picture_of(browser, part, name):
    """With that part of the page in sight."""
    browser.run(f"document.getElementById('{part}').scrollIntoView()")
    time.sleep(0.3)
    browser.picture(f"{FOLDER}/{name}.png")
    browser.run("document.getElementById('drive-title').scrollIntoView()")


def report(name, value):
    print(f"{name}: {value}", flush=True)


def keyboard(browser):
    browser.key("down", "KeyW", "w")
    report("key drives", wait_for(lambda: drives(browser), 5))
    browser.picture(FOLDER + "/drive.png")
    browser.run("window.dispatchEvent(new Event('blur'))")
    report("blur ends the drive", wait_for(lambda: not drives(browser), 1))
    time.sleep(0.5)
    report("held key goes on after it", drives(browser))
    browser.key("up", "KeyW", "w")


def command_key(browser):
    """Of a Mac: the up of what was held does not come."""
    browser.key("down", "KeyW", "w")
    wait_for(lambda: drives(browser), 5)
    browser.key("down", "MetaLeft", "Meta")
    report("command key ends the drive", wait_for(lambda: not drives(browser), 1))
    browser.key("up", "MetaLeft", "Meta")
    time.sleep(0.5)
    report("held key goes on after the command key", drives(browser))
    browser.key("up", "KeyW", "w")


def two_buttons(browser):
    """The right one is held while the left one is let go, for which a page gets no pointerup."""
    x, y = middle(browser, "stick")
    browser.mouse("mousePressed", x, y, buttons=1)
    browser.mouse("mouseMoved", x, y - 40, buttons=1)
    report("left button drives", wait_for(lambda: drives(browser), 5))
    browser.mouse("mousePressed", x, y - 40, "right", buttons=3)
    browser.mouse("mouseReleased", x, y - 40, buttons=2)
    report("left button let go ends the drive", wait_for(lambda: not drives(browser), 1))
    browser.mouse("mouseReleased", x, y - 40, "right", buttons=0)


def stick(browser):
    x, y = middle(browser, "stick")
    browser.mouse("mousePressed", x, y)
    browser.mouse("mouseMoved", x, y - 40)
    report("stick drives", wait_for(lambda: drives(browser), 5))
    browser.mouse("mouseReleased", x, y - 40)
    report("released stick ends the drive", wait_for(lambda: not drives(browser), 1))


def stop_and_rearm(browser):
    browser.key("down", "Space", " ")
    browser.key("up", "Space", " ")
    report("space bar stops", wait_for(lambda: not browser.run("document.getElementById('stopped').hidden"), 2))
    browser.picture(FOLDER + "/stopped.png")
    x, y = middle(browser, "rearm")
    browser.mouse("mousePressed", x, y)
    report("held button re-arms", wait_for(lambda: browser.run("document.getElementById('stopped').hidden"), 4))
    browser.mouse("mouseReleased", x, y)


def legend(browser):
    return browser.run("[...document.querySelectorAll('.chart li')].map((l) => l.innerText.replaceAll('\\n', ' '))")


def plots(browser):
    """Chooses one number, drags another one onto a second chart, holds the charts, takes one away."""
    browser.click("show-plots")
    field = "[...document.querySelectorAll('.fields details[data-channel=POSE] button')].find((b) => b.textContent === 'x_m')"
    report("fields are offered", wait_for(lambda: browser.run(f"{field} !== undefined"), 5))
    browser.run(f"{field}.click()")
    browser.run("[...document.querySelectorAll('.plots .tools button')].find((b) => b.textContent === 'Another chart').click()")
    browser.run("(() => { const data = new DataTransfer(); data.setData('text/plain', 'LINK_STATUS false 0 utilisation_in');"
                " document.querySelectorAll('.chart')[1].dispatchEvent(new DragEvent('drop', {dataTransfer: data})); })()")
    report("numbers with units", wait_for(lambda: len(legend(browser)) == 2 and legend(browser)[0].endswith(" m ×"), 5))
    before = legend(browser)[1]
    report("numbers change", wait_for(lambda: legend(browser)[1] != before, 15))
    time.sleep(3)
    report("charts are drawn", browser.run("[...document.querySelectorAll('.chart canvas')].every((c) => c.width > 100)"))
    browser.picture(FOLDER + "/plots.png")
    browser.run("document.querySelector('.plots .tools button').click()")
    time.sleep(0.3)
    before = legend(browser)
    time.sleep(1)
    report("held charts stand", legend(browser) == before)
    browser.run("document.querySelector('.chart li button').click()")
    report("one is taken away", len(legend(browser)) == 1)


def values(browser):
    """The parameters of a process of the robot, with unit and range."""
    browser.click("show-values")
    table = "(document.querySelector('.values')?.innerText ?? '')"
    report("parameters are shown", wait_for(lambda: "beat_hz" in browser.run(table), 12))
    browser.run("(() => { const s = document.querySelector('#view-values select'); s.value = 'robot'; s.dispatchEvent(new Event('change')); })()")
    report("of every process", wait_for(lambda: "rad/s" in browser.run(table), 5))
    live_values(browser)
    browser.picture(FOLDER + "/values.png")
    browser.click("show-plan")


def live_values(browser):
    """A parameter of the running robot is changed by keyboard, through the radio; one that is too bold is refused."""
    row = "[...document.querySelectorAll('.live tr')].find((r) => r.innerText.includes('shape.max_speed_m_s'))"
    cell = lambda i: f"({row}?.children[{i}]?.innerText ?? '')"
    report("live parameters are shown", wait_for(lambda: "0.6 m/s (file)" in browser.run(cell(1)), 12))

    def enter(value):
        browser.run(f"(() => {{ const f = {row}.querySelector('input'); f.focus(); f.value = '{value}'; f.dispatchEvent(new Event('input')); }})()")
        browser.key("down", "Enter", "Enter")
        browser.key("up", "Enter", "Enter")

    enter("0.3")
    report("an order is under way", wait_for(lambda: "under way" in browser.run(cell(4)), 2))
    report("a new value is in force", wait_for(lambda: browser.run(cell(1)) == "0.3 m/s" and browser.run(cell(4)) == "in force", 20))
    note = "(document.querySelector('.live [role=status]')?.innerText ?? '')"
    report("it is not saved", wait_for(lambda: "not saved" in browser.run(note), 2))
    enter("0.9")
    report("a bold value is refused", wait_for(lambda: "less careful" in browser.run(cell(4)) and browser.run(cell(1)) == "0.3 m/s", 20))
    browser.run("document.querySelectorAll('.live .tools button')[1].click()")
    report("all is as in the file", wait_for(lambda: "(file)" in browser.run(cell(1)), 20))


def mission(browser):
    browser.click("sonars")
    browser.click("view")
    browser.click("show-space")
    browser.click("pass")
    report("mission starts", wait_for(lambda: "approaching" in browser.text("mission-text"), 5))
    report("it says", browser.text("mission-text"))
    wait_for(lambda: "looking" in browser.text("mission-text"), 20)
    browser.picture(FOLDER + "/looking.png")
    report("edges are seen", wait_for(lambda: "px" in browser.text("look"), 30))
    report("space is drawn", browser.bytes_of("space") > 8000)
    browser.picture(FOLDER + "/space.png")
    browser.click("show-plan")
    time.sleep(0.5)
    browser.picture(FOLDER + "/mission.png")
    browser.click("abort")
    report("mission is aborted", wait_for(lambda: "aborted" in browser.text("mission-text"), 5))


def place(browser):
    """Chooses a place on the plan by a drag, drives there, and at last says that the robot stands there."""
    browser.click("pick")
    x, y = browser.run("(() => { const r = document.getElementById('plan').getBoundingClientRect();"
                       " return [r.x + 0.33 * r.width, r.y + 0.55 * r.height]; })()")
    browser.mouse("mousePressed", x, y)
    browser.mouse("mouseMoved", x + 30, y - 30)
    browser.mouse("mouseReleased", x + 30, y - 30)
    report("heading by a drag", browser.run("document.getElementById('target-yaw').value"))
    report("chosen once", browser.run("document.getElementById('pick').getAttribute('aria-pressed')"))
    browser.click("goto")
    report("drives to a place", wait_for(lambda: "driving to" in browser.text("mission-text"), 5))
    report("mission", browser.text("mission-text"))
    time.sleep(1.5)
    browser.click("place")
    report("a pose is not set on the way", wait_for(lambda: "not set" in browser.text("placed"), 4))
    browser.picture(FOLDER + "/place.png")
    browser.click("abort")
    wait_for(lambda: "aborted" in browser.text("mission-text"), 5)
    time.sleep(1.5)
    browser.click("place")
    report("a robot at rest is told its pose", wait_for(lambda: "knows its new pose" in browser.text("placed"), 4))


def missions(browser):
    """A patrol of two places: paused, resumed; an order that waits is cancelled."""
    browser.run("document.querySelector('#orders details').open = true")
    for x in (2.0, 2.4):
        browser.run(f"(() => {{ for (const [id, v] of [['target-x', {x}], ['target-y', 1.5], ['target-yaw', '']])"
                    " document.getElementById(id).value = v; document.getElementById('orders').dispatchEvent(new Event('input')); })()")
        browser.click("add-place")
    report("places are chosen", wait_for(lambda: "→" in browser.text("patrol-places"), 2))
    browser.click("patrol")
    report("progress is shown", wait_for(lambda: "1 / 2" in (browser.text("progress-text") or ""), 8))
    browser.click("goto")
    report("an order waits", wait_for(lambda: "goto" in browser.text("queue"), 4))
    browser.click("pause")
    report("it is paused", wait_for(lambda: "paused" in (browser.text("progress-text") or ""), 6))
    picture_of(browser, "mission-title", "patrol")
    browser.run("document.querySelector('#queue button').click()")
    report("what waits is cancelled", wait_for(lambda: browser.text("queue") == "", 4))
    browser.click("pause")
    report("it goes on", wait_for(lambda: "paused" not in (browser.text("progress-text") or "paused"), 6))
    browser.click("abort")
    report("ends are listed", wait_for(lambda: "cancelled" in browser.text("ends"), 6))
    browser.click("clear-places")


def enabled(browser, field, value, button):
    """Whether a button can be pressed with that in a field."""
    browser.run(f"(() => {{ document.getElementById('{field}').value = '{value}';"
                " document.getElementById('orders').dispatchEvent(new Event('input')); })()")
    return browser.run(f"!document.getElementById('{button}').disabled")


def fields(browser):
    """What is not allowed in a field is no order, and said so."""
    report("corridor distances", [enabled(browser, "corridor-m", v, "corridor") for v in ("5", "0", "-5", "1000000", "")])
    browser.click("add-place")
    report("rounds", [enabled(browser, "rounds", v, "patrol") for v in ("2", "0", "-1", "99999", "1.5", "")])
    browser.click("clear-places")
    for field, value in (("rounds", "1"), ("corridor-m", "0"), ("target-x", "1000")):
        enabled(browser, field, value, "goto")
    report("what is allowed", browser.text("field-hint"))
    enabled(browser, "target-x", "2.4", "goto")


def keys(browser):
    """Everything by keyboard, the space bar being the stop's."""
    browser.run("document.getElementById('follow').focus()")
    browser.key("down", "Enter", "Enter")
    browser.key("up", "Enter", "Enter")
    report("Enter ticks", browser.run("document.getElementById('follow').checked"))
    browser.run("document.getElementById('turn').focus()")
    browser.key("down", "KeyW", "w")
    report("a slider takes no letters", wait_for(lambda: drives(browser), 20))
    browser.key("up", "KeyW", "w")
    browser.run("document.getElementById('target-x').focus()")
    report("a field says that it takes keys", wait_for(lambda: "keys go to the field" in browser.text("phase"), 5))
    browser.run("document.activeElement.blur(); document.getElementById('follow').click()")


def head(browser):
    """Points the head at a place on the plan, then straight ahead."""
    browser.run("document.getElementById('head-parts').open = true")
    report("the head says where it looks", wait_for(lambda: "pan" in browser.text("head-state"), 8))
    browser.click("look-there")
    x, y = browser.run("(() => { const r = document.getElementById('plan').getBoundingClientRect();"
                       " return [r.x + 0.3 * r.width, r.y + 0.3 * r.height]; })()")
    before = browser.text("head-state").split(",")[0]
    browser.mouse("mousePressed", x, y)
    browser.mouse("mouseReleased", x, y)
    report("it looks there", wait_for(lambda: browser.text("head-state").split(",")[0] != before, 8))
    print(f"head: {before} -> {browser.text('head-state')}")
    picture_of(browser, "head-title", "head")
    browser.click("look-ahead")
    report("it looks ahead", wait_for(lambda: "pan 0.0°" in browser.text("head-state").replace("-0.0", "0.0"), 8))
    browser.run("document.getElementById('head-parts').open = false")


def alarm(browser):
    """Somebody has to take note of an alarm, and everybody sees who did."""
    raise_alarm()
    report("an alarm is shown", wait_for(lambda: "left camera is dark" in browser.text("alarms"), 4))
    report("in the head of the page, too", browser.text("alarm-mark"))
    picture_of(browser, "alarm-title", "alarm")
    browser.run("document.querySelector('#alarms button').click()")
    report("who acknowledged it", wait_for(lambda: "acknowledged by 127.0.0.1" in browser.text("alarms"), 4))
    report("then no more", wait_for(lambda: browser.run("document.getElementById('alarm-mark').hidden"), 4))
    picture_of(browser, "link-title", "link")


def other_screens():
    for name, width, height, scheme, language in (("dark", 1366, 768, "dark", "en-US"), ("phone", 390, 844, "light", "de-DE"),
                                                  ("tablet", 820, 1180, "dark", "de-DE")):
        browser = Browser(width, height, scheme, language)
        load(browser)
        wide = browser.run("document.documentElement.scrollWidth")
        report(f"{name} fits", wide <= width)
        report(f"{name} speaks", browser.text("drive-title"))
        browser.picture(f"{FOLDER}/{name}.png")
        browser.close()


def main():
    browser = Browser()
    paint_ms = load(browser)
    report("first paint, after ms", round(paint_ms))
    report("connected", browser.text("connection"))
    browser.picture(FOLDER + "/start.png")
    keyboard(browser)
    command_key(browser)
    stick(browser)
    two_buttons(browser)
    stop_and_rearm(browser)
    mission(browser)
    place(browser)
    missions(browser)
    fields(browser)
    keys(browser)
    head(browser)
    alarm(browser)
    plots(browser)
    values(browser)
    browser.click("language")
    report("German", "Fahren" in browser.text("drive-title"))
    report("complaints", browser.complaints)
    browser.close()
    other_screens()


main()
