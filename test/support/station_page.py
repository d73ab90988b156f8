"""A page of the station without a browser: a WebSocket, and a hand that holds or lets go. Standard library only."""
import json
import threading
import time

from web_socket import WebSocket

REST = [0, 0, 0, 0, 0, 0]


class Page:
    """Reports its hand every 40 ms and keeps what the station says."""

    def __init__(self, port, host="127.0.0.1"):
        self.axis, self.hold, self.buttons = REST, False, {}
        self.talks, self.hears = True, True
        self.hello, self.station, self.messages, self.ages, self.beat = None, None, {}, {}, 0
        self.frozen_beat = None
        self.closed = False
        self.socket = WebSocket(port, host=host, origin=f"http://{host}:{port}")
        for work in (self._listen, self._report):
            threading.Thread(target=work, daemon=True).start()

    def say(self, message):
        try:
            self.socket.send(json.dumps(message))
        except OSError:
            self.closed = True

    def close(self):
        self.closed = True
        self.socket.close()

    def _listen(self):
        try:
            while not self.closed:
                kind, text = self.socket.receive()
                if kind == 1:
                    self._take(json.loads(text))
        except (OSError, ValueError):
            self.closed = True

    def _take(self, text):
        if text["type"] == "hello":
            self.hello = text
            return
        self.beat, self.station = text["beat"], text["station"]
        for item in text["items"]:
            self.messages[item["channel"]] = item["message"]
            self.ages[item["channel"]] = item["age_s"]  # when it was sent here

    def _report(self):
        while not self.closed:
            self._tell_hand()
            time.sleep(0.04)

    def _tell_hand(self):
        if self.talks and self.hello:
            self.say({"type": "stick", "beat": self.beat if self.frozen_beat is None else self.frozen_beat,
                      "axis": self.axis, "hold": self.hold, **self.buttons})

    def push(self, forward=1):
        self.axis, self.hold = [forward, 0, 0, 0, 0, 0], True
        self._tell_hand()  # a key that goes down is reported at once

    def let_go(self):
        self.axis, self.hold, self.buttons = REST, False, {}
        self._tell_hand()


def wait_for(condition, seconds):
    """Whether the condition came true in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.002)
    return condition()
