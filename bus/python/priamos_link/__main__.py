"""`python3 -m priamos_link`: messages of a radio link as lines of JSON."""

import argparse
import json
import os
import re
import select
import signal
import stat
import sys
import termios
import time
import tty

from .end import End
from .handshake import timed_nonce
from .table import Table, age_of, pack, unpack

SIMULATION_KEY = b"everybody knows this key".ljust(32, b"\0")
TICK_S = 0.001


class Refusal(Exception):
    """One sentence for a person."""


def parse(arguments):
    parser = argparse.ArgumentParser(prog="priamos_link", description=__doc__.split(": ", 1)[1])
    parser.add_argument("--port", required=True, help="serial port, or a tty of `priamos link emulate`")
    parser.add_argument("--table", required=True, help="what `priamos link table link.toml --json` printed")
    parser.add_argument("--key", help="the link's key file; without it the simulation key, on a pseudo terminal only")
    parser.add_argument("--seconds", type=float, default=0, help="end after so long; 0: with Ctrl-C")
    parser.add_argument("--onboard", action="store_true", help="be the robot's end; else the workstation's")
    return parser.parse_args(arguments)


def read_text(path, what):
    try:
        with open(path, encoding="utf-8") as file:
            return file.read(1 << 20)
    except (OSError, UnicodeDecodeError) as error:
        raise Refusal(f"{path}: expected {what}, got none: {error}") from None


def read_table(path):
    try:
        return Table(read_text(path, "a channel table"))
    except ValueError as error:
        raise Refusal(f"{path}: {error}") from None


def read_key(path, port):
    if path is None:
        if not os.path.realpath(port).startswith("/dev/pts/"):
            raise Refusal(f"--key: expected a key file on {port}, which others can reach, got none")
        return SIMULATION_KEY
    text = read_text(path, "the link's key")
    if stat.S_IMODE(os.stat(path).st_mode) & 0o077:
        raise Refusal(f"{path}: expected a key that only its owner can read: `chmod 600 {path}`")
    if not re.fullmatch(r"[0-9a-fA-F]{64}\n?", text):
        raise Refusal(f"{path}: expected 64 hexadecimal digits, got something else")
    return bytes.fromhex(text)


def check_cipher(table):
    try:
        if table.encrypted:
            import cryptography.hazmat.primitives.ciphers  # noqa: F401
    except ImportError:
        raise Refusal("expected python3-cryptography for an encrypted link, got none: install it") from None


def open_port(path, baud):
    speed = getattr(termios, f"B{baud}", None)
    if speed is None:
        raise Refusal(f"{path}: expected a baud rate that serial ports have, got {baud}")
    try:
        port = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        tty.setraw(port)
        settings = termios.tcgetattr(port)
        settings[4] = settings[5] = speed
        termios.tcsetattr(port, termios.TCSANOW, settings)
    except (OSError, termios.error) as error:
        raise Refusal(f"{path}: expected a serial port, got none: {error}") from None
    return port


def show(table, delivery, now):
    channel = table.channels[delivery.channel]
    wall_us = int(time.time() * 1e6)
    stamp_us = wall_us - round((now - delivery.time) * 1e6)
    message = {"channel": channel.name, "utime": stamp_us}
    try:
        fields = unpack(channel, delivery.packed, stamp_us)
    except ValueError as error:
        return complain(f"{channel.name}: {error}")
    message.update({"message": fields} if fields is not None else {"hex": delivery.packed.hex(), "bits": delivery.bits})
    print(json.dumps(message), flush=True)


def offer(end, line, now):
    """Takes a line as show() prints it. Raises ValueError with one sentence."""
    try:
        data = json.loads(line)
    except RecursionError:
        raise ValueError("expected a message, got one nested too deeply") from None
    if not isinstance(data, dict) or end.table.index(data.get("channel")) is None:
        raise ValueError(f"expected {{\"channel\": NAME, ...}} with a channel of the link, got {line.strip()[:60]}")
    index, made = end.table.index(data["channel"]), now
    if "hex" in data:
        packed, bits = bytes.fromhex(data["hex"]), int(data.get("bits", 4 * len(data["hex"])))
    else:
        utime, message = int(time.time() * 1e6), dict(data.get("message", {}))
        age_us = age_of(end.table.channels[index], message, utime)
        packed, bits = pack(end.table.channels[index], message, utime - age_us)
        made = now - age_us / 1e6
    if bits > 8 * len(packed) or not end.offer(index, packed, bits, now, made):
        raise ValueError(f"{data['channel']}: expected a message that this end sends, of its size, and room for it, got "
                         f"{bits} bits")


def complain(text):
    print(f"priamos_link: {text}", file=sys.stderr, flush=True)


class Lines:
    """Lines of standard input as they come."""

    def __init__(self):
        self.rest, self.open = b"", True

    def read(self):
        data = os.read(0, 65536)
        self.open = bool(data)
        # What is typed in may end without a line feed.
        *lines, self.rest = (self.rest + (data or b"\n")).split(b"\n")
        self.rest = self.rest[:65536]
        return [line.decode(errors="replace") for line in lines if line.strip()]


def run(end, port, ended, seconds):
    lines, up, waiting = Lines(), False, b""
    until = time.monotonic() + (seconds or float("inf"))
    while not ended and time.monotonic() < until:
        sources = [port] + ([0] if lines.open else [])
        ready, _, _ = select.select(sources, [], [], TICK_S)
        if port in ready:
            data = os.read(port, 4096)
            now = time.monotonic()  # after the reading: never before the bytes came
            try:
                for delivery in end.receive(data, now):
                    show(end.table, delivery, now)
            except ValueError as error:
                complain(error)
        now = time.monotonic()
        if 0 in ready:
            for line in lines.read():
                try:
                    offer(end, line, now)
                except (ValueError, TypeError, OverflowError) as error:
                    complain(error)
        waiting += end.step(now)
        if waiting:
            try:
                waiting = waiting[os.write(port, waiting):]
            except BlockingIOError:
                waiting = waiting[-64:]
        if end.up(now) != up:
            up = not up
            complain("link is up" if up else "link is down")


def main(arguments=None):
    options = parse(arguments)
    try:
        table = read_table(options.table)
        key = read_key(options.key, options.port)
        port = open_port(options.port, table.baud)
        check_cipher(table)
    except Refusal as refusal:
        complain(refusal)
        return 2
    end = End(table, key, options.onboard, timed_nonce, time.monotonic())
    ended = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: ended.append(True))
    try:
        run(end, port, ended, options.seconds)
    except (OSError, BrokenPipeError) as error:
        complain(f"{options.port}: {error}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
