"""The client's end of one WebSocket. Standard library only."""
import base64
import os
import socket
import struct


class WebSocket:
    """Opens it; raises ConnectionError with the server's answer when it refuses."""

    def __init__(self, port, target="/socket", host="127.0.0.1", origin=None, protocol=None):
        self.socket = socket.create_connection((host, port), timeout=5)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        more = "".join(f"{name}: {value}\r\n" for name, value in (("Origin", origin), ("Sec-WebSocket-Protocol", protocol)) if value)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET {target} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n{more}"
                             f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n").encode())
        self.head = b""
        while b"\r\n\r\n" not in self.head:
            byte = self.socket.recv(1)
            if not byte:
                raise ConnectionError(self.head.decode())
            self.head += byte
        if b" 101 " not in self.head:
            raise ConnectionError(self.head.decode())
        self.socket.settimeout(None)

    def send(self, payload, opcode=1):
        """A text, or with opcode 2 bytes."""
        payload = payload.encode() if isinstance(payload, str) else payload
        mask = os.urandom(4)
        size = bytes([0x80 | len(payload)]) if len(payload) < 126 else bytes([0xFE]) + struct.pack(">H", len(payload))
        self.socket.sendall(bytes([0x80 | opcode]) + size + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload)))

    def receive(self):
        """The next message: its opcode (1 text, 2 bytes, 8 the end) and its content. A ping is answered, as browsers do."""
        opcode, content = self._frame()
        while opcode == 9:
            self.send(content, opcode=10)
            opcode, content = self._frame()
        return opcode, content

    def _frame(self):
        first, length = self._exactly(2)
        if length == 126:
            length, = struct.unpack(">H", self._exactly(2))
        elif length == 127:
            length, = struct.unpack(">Q", self._exactly(8))
        return first & 15, self._exactly(length)

    def _exactly(self, n):
        data = b""
        while len(data) < n:
            piece = self.socket.recv(n - len(data))
            if not piece:
                raise ConnectionError
            data += piece
        return data

    def close(self):
        self.socket.shutdown(socket.SHUT_RDWR)
        self.socket.close()
