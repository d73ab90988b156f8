"""A robot that is driven from pages of the station: what the wheels are told, how a drive begins, and how it ends."""
import json
import os
import signal
import subprocess
import threading
import time

from station_page import Page, wait_for

ENDS = ("released", "tab closed", "silent", "stop", "delayed", "station killed")
LATE_S = 0.3  # asked: so long after the end of a drive no command turns a wheel


class Wheels:
    """Wheel commands on the robot's bus: when they were last other than zero."""

    def __init__(self, tools, robot):
        self.turning, self.last_turn, self.first_turn = False, 0.0, 0.0
        self.echo = subprocess.Popen([tools + "/priamos", "topic", "echo", "WHEEL_COMMAND", "--bus", "onboard", "--robot", robot, "--json"],
                                     stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.echo.stdout:
            heard = time.monotonic()
            turning = any(abs(w) > 1e-6 for w in json.loads(line)["speed_rad_s"])
            if turning:
                self.last_turn = heard
                if not self.turning:
                    self.first_turn = heard
            self.turning = turning

    def close(self):
        self.echo.terminate()


class Rig:
    """`tools`: folder of the programs; `up_file`: up.json of `priamos up`."""

    def __init__(self, tools, robot, port, up_file):
        self.port, self.up_file, self.next_port = port, up_file, port + 100
        self.wheels = Wheels(tools, robot)

    def pid_of(self, process):
        with open(self.up_file, encoding="utf-8") as file:
            return next(p["pid"] for p in json.load(file)["processes"] if p["name"] == process)

    def second_station(self):
        """Another one beside that of `priamos up`, which would start one that is killed again later each time."""
        with open(f"/proc/{self.pid_of('offboard-console')}/cmdline", encoding="utf-8") as file:
            arguments = file.read().rstrip("\0").split("\0")
        self.next_port += 1  # who waits for the page of an earlier one holds its port
        port = self.next_port
        return subprocess.Popen([*arguments, "--port", str(port)], stderr=subprocess.DEVNULL), port

    def open_page(self, port=None):
        """A page; the station may still be starting."""
        for _ in range(300):
            try:
                return Page(port or self.port)
            except ConnectionError:
                time.sleep(0.1)
        raise SystemExit("no station")

    def drive(self, forward=1, port=None):
        page = self.open_page(port)
        wait_for(lambda: page.station and page.messages.get("DRIVE_STATUS"), 5)
        time.sleep(0.2)
        page.push(forward)
        for _ in range(3):  # a busy machine refuses what is too old, and a drive does not begin
            if wait_for(lambda: self.wheels.turning, 6):
                time.sleep(0.4)
                return page
            page.let_go()
            time.sleep(0.3)
            page.push(forward)
        raise SystemExit(f"the wheels do not turn: {page.station} {page.messages.get('DRIVE_STATUS')}")

    def end(self, page, how, station=None):
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
            station.kill()
            station.wait()

    def seconds_to_stand(self, how, forward):
        """From the end of a drive to the last command that turned a wheel, with the hand still on the stick after it."""
        station, port = self.second_station() if how == "station killed" else (None, None)
        page = self.drive(forward, port)
        ended = time.monotonic()
        self.end(page, how, station)
        time.sleep(0.6)
        page.talks, page.frozen_beat = True, None  # the hand is still there when the way is free again
        time.sleep(0.6)
        if how == "stop":
            rearm(page)
        if not page.closed:
            page.let_go()
            time.sleep(0.2)
            page.close()
        time.sleep(0.2)
        return max(0.0, self.wheels.last_turn - ended)

    def starts_while_held(self):
        """Whether a hand that is on the stick when its page connects turns the wheels."""
        first = self.drive()
        held = self.open_page()
        held.push()  # before it was ever seen at rest
        first.close()
        time.sleep(0.5)
        began = self.wheels.last_turn
        time.sleep(2)
        return self.wheels.last_turn > began


def rearm(page):
    page.let_go()
    time.sleep(0.2)
    page.buttons = {"rearm": True}
    wait_for(lambda: not page.messages["DRIVE_STATUS"]["estop"], 4)
    page.let_go()
    time.sleep(0.2)


def report(how, took):
    late = sum(t > LATE_S for t in took)
    print(f"{how}: {len(took) - late} of {len(took)} within {LATE_S:.3f} s, worst {max(took):.3f} s", flush=True)
