"""Chromium without a screen, steered over its DevTools protocol. Standard library only."""
import atexit
import base64
import json
import os
import re
import socket
import struct
import subprocess
import tempfile
import urllib.request


class Browser:
    """One page in a fresh profile, which is gone afterwards."""

    def __init__(self, width=1366, height=768, scheme="light", language="en-US"):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.process = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--remote-debugging-port=0",
             f"--user-data-dir={self.profile.name}", f"--window-size={width},{height}", f"--lang={language}", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env={**os.environ, "LANGUAGE": language[:2], "LANG": "C.UTF-8"})
        self.port = next(m.group(1) for m in (re.search(r"ws://127.0.0.1:(\d+)/", line) for line in self.process.stderr) if m)
        atexit.register(self.process.kill)
        self.number, self.complaints = 0, []
        self.looks = (width, height, scheme, language)
        pages = json.load(urllib.request.urlopen(f"http://127.0.0.1:{self.port}/json"))
        self._take(next(p for p in pages if p["type"] == "page")["id"])

    def _take(self, tab):
        """Talks to that tab from now on."""
        self.tab = tab
        self._connect(f"ws://127.0.0.1:{self.port}/devtools/page/{tab}")
        width, height, scheme, language = self.looks
        for domain in ("Page", "Runtime", "Log"):
            self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.call("Emulation.setUserAgentOverride", userAgent=self.run("navigator.userAgent"), acceptLanguage=language)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def _order(self, order):
        """Of the browser, not of a page."""
        return urllib.request.urlopen(urllib.request.Request(f"http://127.0.0.1:{self.port}/json/{order}", method="PUT")).read()

    def open_tab(self, url):
        self._take(json.loads(self._order("new?" + url))["id"])

    def close_tab(self):
        """Of all tabs one must stay; open_tab is next."""
        self._order("close/" + self.tab)

    def cover_tab(self):
        """Another tab goes before this one."""
        self.cover = json.loads(self._order("new?about:blank"))["id"]

    def uncover_tab(self):
        self._order("close/" + self.cover)
        self._order("activate/" + self.tab)

    def _connect(self, url):
        host, port, path = re.match(r"ws://([^:/]+):(\d+)(/.*)", url).groups()
        self.socket = socket.create_connection((host, int(port)), timeout=30)
        self.socket.sendall((f"GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}\r\n\r\n").encode())
        head = b""
        while b"\r\n\r\n" not in head:
            head += self.socket.recv(1)

    def _exactly(self, n):
        data = b""
        while len(data) < n:
            piece = self.socket.recv(n - len(data))
            if not piece:
                raise ConnectionError("the browser is gone")
            data += piece
        return data

    def _hear(self):
        text = b""
        while True:
            first, length = self._exactly(2)
            if length == 126:
                length, = struct.unpack(">H", self._exactly(2))
            elif length == 127:
                length, = struct.unpack(">Q", self._exactly(8))
            text += self._exactly(length)
            if first & 0x80:
                return json.loads(text)

    def call(self, method, **parameters):
        self.number += 1
        payload = json.dumps({"id": self.number, "method": method, "params": parameters}).encode()
        self.socket.sendall(b"\x81" + (bytes([0x80 | len(payload)]) if len(payload) < 126 else b"\xfe" + struct.pack(">H", len(payload)))
                            + bytes(4) + payload)
        while True:
            answer = self._hear()
            if answer.get("id") == self.number:
                return answer.get("result", answer)
            # A machine without a graphics card draws in software, and says so.
            drawing = answer.get("params", {}).get("entry", {}).get("source") == "rendering"
            if answer.get("method") in ("Runtime.exceptionThrown", "Log.entryAdded") and not drawing:
                self.complaints.append(json.dumps(answer["params"])[:300])

    def run(self, script):
        """Value of a JavaScript expression."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        return answer.get("result", {}).get("value")

    def text(self, element):
        return self.run(f"document.getElementById('{element}').innerText")

    def click(self, element):
        self.run(f"document.getElementById('{element}').click()")

    def key(self, action, code, key):
        self.call("Input.dispatchKeyEvent", type={"down": "keyDown", "up": "keyUp"}[action], code=code, key=key)

    def mouse(self, action, x, y, button="left", **held):
        """`buttons=` of those that are down then: 1 left, 2 right."""
        self.call("Input.dispatchMouseEvent", type=action, x=x, y=y, button=button, clickCount=1, **held)

    def picture(self, file):
        with open(file, "wb") as out:
            out.write(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))

    def bytes_of(self, element):
        """Bytes of a PNG of that element: next to none when it is empty."""
        box = self.run(f"(() => {{ const r = document.getElementById('{element}').getBoundingClientRect();"
                       " return {x: r.x, y: r.y, width: r.width, height: r.height, scale: 1}; })()")
        return len(base64.b64decode(self.call("Page.captureScreenshot", format="png", clip=box)["data"]))

    def close(self):
        self.process.terminate()
        self.process.wait()
        self.profile.cleanup()
