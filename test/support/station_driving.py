"""Drives the robot from pages of the station, ends each drive in another way, and prints how long the wheels turned on.

usage: station_driving.py BIN ROBOT PORT ROUNDS UP_JSON
"""
import json
import os
import signal
import subprocess
import sys
import threading
import time

from station_page import Page, wait_for

BIN, ROBOT, PORT, ROUNDS, UP = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]), sys.argv[5]


class Wheels:
    """Wheel commands on the robot's bus: when they were last other than zero."""

    def __init__(self):
        self.turning, self.last_turn, self.heard = False, 0.0, 0.0
        self.echo = subprocess.Popen([BIN + "/priamos", "topic", "echo", "WHEEL_COMMAND", "--bus", "onboard", "--robot", ROBOT, "--json"],
                                     stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.echo.stdout:
            self.heard = time.monotonic()
            self.turning = any(abs(w) > 1e-6 for w in json.loads(line)["speed_rad_s"])
            if self.turning:
                self.last_turn = self.heard


def console_pid():
    with open(UP, encoding="utf-8") as file:
        return next(p["pid"] for p in json.load(file)["processes"] if p["name"] == "offboard-console")


def open_page():
    """A page; the station may still be starting."""
    for _ in range(100):
        try:
            return Page(PORT)
        except ConnectionError:
            time.sleep(0.1)
    raise SystemExit("no station")


def drive(wheels, forward=1):
    page = open_page()
    wait_for(lambda: page.station and page.messages.get("DRIVE_STATUS"), 5)
    time.sleep(0.2)
    page.push(forward)
    if not wait_for(lambda: wheels.turning, 6):
        raise SystemExit(f"the wheels do not turn: {page.station} {page.messages.get('DRIVE_STATUS')}")
    time.sleep(0.4)
    return page


def end_of(page, how):
    if how == "released":
        page.let_go()
    elif how == "tab closed":
        page.close()
    elif how == "silent":
        page.talks = False
    elif how == "stop":
        page.say({"type": "stop"})
    elif how == "delayed":
        page.frozen_beat = page.beat  # what arrives from now on was wished ever longer ago
    elif how == "station killed":
        os.kill(console_pid(), signal.SIGKILL)


def rearm(page):
    page.let_go()
    time.sleep(0.2)
    page.buttons = {"rearm": True}
    wait_for(lambda: not page.messages["DRIVE_STATUS"]["estop"], 4)
    page.let_go()
    time.sleep(0.2)


def end_one(wheels, how, forward):
    """From the end of a drive to the last command that turned a wheel [s], with the hand still on the stick after it."""
    page = drive(wheels, forward)
    ended = time.monotonic()
    end_of(page, how)
    time.sleep(0.8)
    page.talks, page.frozen_beat = True, None  # the hand is still there when the way is free again
    time.sleep(0.8)
    if how == "stop":
        rearm(page)
    if not page.closed:
        page.let_go()
        time.sleep(0.2)
        page.close()
    time.sleep(0.2)
    return max(0.0, wheels.last_turn - ended)


def main():
    wheels = Wheels()
    for how in ("released", "tab closed", "silent", "stop", "delayed", "station killed"):
        took = sorted(end_one(wheels, how, (-1) ** i) for i in range(ROUNDS))
        late = sum(t > 0.3 for t in took)
        print(f"{how}: {ROUNDS - late} of {ROUNDS} within 0.300 s, worst {took[-1]:.3f} s", flush=True)
    first = drive(wheels)
    held = open_page()
    held.push()  # before it was ever seen at rest
    first.close()
    time.sleep(0.5)
    began = wheels.last_turn
    time.sleep(2)
    print(f"key held while a page connects: wheels {'turn' if wheels.last_turn > began else 'stand'}")
    wheels.echo.terminate()


main()
