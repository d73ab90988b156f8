"""A page of the station without a browser: a WebSocket, and a hand that holds or lets go. Standard library only."""
import base64
import json
import os
import socket
import struct
import threading
import time

REST = [0, 0, 0, 0, 0, 0]


class Page:
    """Reports its hand every 40 ms and keeps what the station says."""

    def __init__(self, port, host="127.0.0.1"):
        self.axis, self.hold, self.buttons = REST, False, {}
        self.talks, self.hears = True, True
        self.hello, self.station, self.messages, self.ages, self.beat = None, None, {}, {}, 0
        self.frozen_beat = None
        self.closed = False
        self.socket = socket.create_connection((host, port), timeout=5)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._upgrade(f"{host}:{port}")
        self.socket.settimeout(None)
        for work in (self._listen, self._report):
            threading.Thread(target=work, daemon=True).start()

    def _upgrade(self, name):
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /socket HTTP/1.1\r\nHost: {name}\r\nOrigin: http://{name}\r\nUpgrade: websocket\r\n"
                             f"Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n").encode())
        head = b""
        while b"\r\n\r\n" not in head:
            byte = self.socket.recv(1)
            if not byte:
                raise ConnectionError(head.decode())
            head += byte
        if b" 101 " not in head:
            raise ConnectionError(head.decode())

    def say(self, message):
        payload = json.dumps(message).encode()
        mask = os.urandom(4)
        head = bytes([0x81, 0x80 | len(payload)]) if len(payload) < 126 else bytes([0x81, 0xFE]) + struct.pack(">H", len(payload))
        try:
            self.socket.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload)))
        except OSError:
            self.closed = True

    def close(self):
        self.closed = True
        self.socket.shutdown(socket.SHUT_RDWR)
        self.socket.close()

    def _exactly(self, n):
        data = b""
        while len(data) < n:
            piece = self.socket.recv(n - len(data))
            if not piece:
                raise ConnectionError
            data += piece
        return data

    def _listen(self):
        try:
            while not self.closed:
                first, length = self._exactly(2)
                if length == 126:
                    length, = struct.unpack(">H", self._exactly(2))
                elif length == 127:
                    length, = struct.unpack(">Q", self._exactly(8))
                text = self._exactly(length)
                if first & 15 == 1:
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
            if self.talks and self.hello:
                self.say({"type": "stick", "beat": self.beat if self.frozen_beat is None else self.frozen_beat,
                          "axis": self.axis, "hold": self.hold, **self.buttons})
            time.sleep(0.04)

    def push(self, forward=1):
        self.axis, self.hold = [forward, 0, 0, 0, 0, 0], True

    def let_go(self):
        self.axis, self.hold, self.buttons = REST, False, {}


def wait_for(condition, seconds):
    """Whether the condition came true in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.002)
    return condition()
