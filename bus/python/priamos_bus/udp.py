"""An LCM bus over UDP multicast, with the checks of bus/README.md: only unfragmented messages of at most 1400 bytes."""

import ipaddress
import re
import select
import socket
import struct as binary
import time

from .decoding import decode
from .encoding import encode
from .model import MessageError

MOST_BYTES, MOST_CHANNEL = 1400, 63
_MAGIC = b"LC02"
_LARGEST_GAP = 1 << 20
_URL = re.compile(r"udpm://(?P<group>[0-9.]+):(?P<port>\d{1,5})(?:\?(?P<options>.*))?", re.ASCII)


class BusError(Exception):
    """A bus that cannot be opened or takes no message; one sentence."""


def bus_url(side, robot="priamos", ttl=0):
    """The address of a robot's bus, "onboard" or "offboard", as `priamos topic url` prints it. Raises BusError."""
    if side not in ("onboard", "offboard"):
        raise BusError(f"bus {side!r}: expected onboard or offboard")
    if not re.fullmatch(r"[a-z0-9-]{1,32}", robot, re.ASCII):
        raise BusError(f'robot {robot!r}: expected a name of 1 to 32 of a-z, 0-9 and "-"')
    value = 2166136261  # FNV-1a
    for byte in robot.encode():
        value = (value ^ byte) * 16777619 % 2**32
    onboard = side == "onboard"
    return f"udpm://239.255.{1 + value // 6000 % 254}.{67 if onboard else 68}:" \
           f"{20000 + 2 * (value % 6000) + (not onboard)}?ttl={ttl}"


class Bus:
    """One bus by its URL, udpm://GROUP:PORT[?ttl=N], with the types of `schema`. Counts `lost` (numbers missing in the
    senders' series), `malformed`, `oversize` and `refused` (of a type nobody knows, or damaged). Raises BusError."""

    def __init__(self, url, schema):
        self.schema, self.url = schema, url
        self.lost = self.malformed = self.oversize = self.refused = 0
        self._number, self._next = 0, {}
        group, port, ttl = _address(url)
        self._to = (group, port)
        try:
            self._receiver = _join(group, port)
            self._sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            self._sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)
        except OSError as error:
            raise BusError(f"bus {url}: {error.strerror}; `priamos doctor` names what is missing") from None

    def publish(self, channel, type_name, message):
        """Sends a dict as a message of a type. Raises MessageError, and BusError when it does not leave."""
        struct = self.schema.find(type_name)
        if struct is None:
            raise MessageError(f"{type_name}: expected a type of the schema")
        data, name = encode(struct, message), channel.encode("ascii", "replace")
        if not _is_channel(name):
            raise BusError(f"expected a channel of 1 to {MOST_CHANNEL} printable characters, got {channel!r}")
        if len(data) > MOST_BYTES:
            raise BusError(f"{channel}: expected at most {MOST_BYTES} bytes, got {len(data)}")
        header = _MAGIC + binary.pack(">I", self._number)
        self._number = (self._number + 1) % 2**32
        try:
            self._sender.sendto(header + name + b"\0" + data, self._to)
        except OSError as error:
            raise BusError(f"bus {self.url}: {error.strerror}") from None

    def messages(self, *channels, seconds=None):
        """(channel, message) of these channels, of all without any, as they come; for ever, or so long."""
        until = None if seconds is None else time.monotonic() + seconds
        while until is None or time.monotonic() < until:
            wait = None if until is None else max(0, until - time.monotonic())
            if not select.select([self._receiver], [], [], wait)[0]:
                continue
            datagram, sender = self._receiver.recvfrom(65536)
            heard = self._take(datagram, sender)
            if heard is None or (channels and heard[0] not in channels):
                continue
            try:
                struct = self.schema.of(heard[1])
                if struct is None:
                    raise MessageError("unknown type")
                message = decode(struct, heard[1])
            except MessageError:
                self.refused += 1
                continue
            yield heard[0], message

    def _take(self, datagram, sender):
        """Channel and bytes of a datagram; None, and counted, when it is none of LCM's."""
        name, zero, data = datagram[8:].partition(b"\0")
        if datagram[:4] != _MAGIC or not zero or not _is_channel(name):
            self.malformed += 1
            return None
        self._count(sender, int.from_bytes(datagram[4:8], "big"))
        if len(data) > MOST_BYTES:
            self.oversize += 1
            return None
        return name.decode("ascii"), data

    def _count(self, sender, number):
        gap = (number - self._next.pop(sender, number)) % 2**32
        self.lost += gap if gap <= _LARGEST_GAP else 0
        self._next[sender] = (number + 1) % 2**32
        if len(self._next) > 256:  # the one that was silent for longest
            del self._next[next(iter(self._next))]

    def close(self):
        self._receiver.close()
        self._sender.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def _is_channel(name):
    return 0 < len(name) <= MOST_CHANNEL and all(0x20 <= byte < 0x7F for byte in name)


def _address(url):
    match = _URL.fullmatch(url)
    try:
        if not match or not ipaddress.IPv4Address(match["group"]).is_multicast or not 0 < int(match["port"]) < 65536:
            raise ValueError
        options = dict(option.split("=", 1) for option in (match["options"] or "").split("&") if option)
        ttl = int(options.get("ttl", 0))
        if not 0 <= ttl <= 255:
            raise ValueError
    except ValueError:
        raise BusError(f"bus {url}: expected udpm://GROUP:PORT?ttl=0 with a multicast group and a ttl of 0 to 255") from None
    return match["group"], int(match["port"]), ttl


def _join(group, port):
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
    receiver.bind((group, port))  # no other group on the port is heard
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + socket.inet_aton("0.0.0.0"))
    return receiver
