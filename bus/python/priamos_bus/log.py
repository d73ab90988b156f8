"""LCM's log files: reading, also of damaged ones, and writing."""

import mmap
import os
import stat
import struct as binary
from dataclasses import dataclass

from .decoding import decode
from .encoding import encode
from .model import MessageError
from .schema import Schema, fingerprint_of, own_types
from .type_texts import TypeTexts, is_type_text

_MAGIC = b"\xed\xa1\xda\x01"
_HEADER = binary.Struct(">4sqqII")
MOST_CHANNEL, MOST_DATA, LARGEST_TIME = 255, 64 << 20, 1 << 53


class LogError(Exception):
    """A file that cannot be read or written; one sentence."""


@dataclass
class Event:
    """One message of a log. `utime`: time of recording, microseconds since 1970."""
    number: int
    utime: int
    channel: str
    data: bytes
    offset: int = 0


class Log:
    """The events of a log file, in their order; `for event in log`. Damage does not end the reading: it goes on at the
    next credible event, and `skipped_bytes` and `damaged_places` count what was lost.

    decode() knows the types whose texts the recorder wrote into the log, those of `texts` ((file, text) each, see
    read_folder), and without any PRIAMOS's own. Raises LogError when the file cannot be read."""

    def __init__(self, path, texts=None):
        self.path, self.skipped_bytes, self.damaged_places = str(path), 0, 0
        self.data = _map(self.path)
        self.schema = Schema(own_types() if texts is None else texts)
        self._types = TypeTexts(self.schema)

    def __iter__(self):
        self.skipped_bytes = self.damaged_places = 0
        at, skipping = 0, False
        while at < len(self.data):
            whole, follower = self._place(at)
            if whole:
                event = self._event(at, follower)
                if not self._types.take(event.data):
                    self._types.of(event.data)  # the choice among its definitions is made here
                yield event
            else:
                # Nothing begins before the next magic: one place, however long.
                follower = self._find_magic(follower)
                self.damaged_places += not skipping
                self.skipped_bytes += follower - at
            skipping, at = not whole, follower

    def decode(self, event):
        """The message as a dict, see decoding.decode. Raises MessageError."""
        struct = self._types.of(event.data)
        if struct is None:
            raise MessageError(f"{event.channel}: expected a message of a known type, got fingerprint "
                               f"{fingerprint_of(event.data):016x}; next: name its .lcm folder")
        return decode(struct, event.data)

    def messages(self, *channels):
        """(event, message) of these channels, of all without any; what cannot be decoded, and type texts, left out."""
        for event in self:
            if is_type_text(event.data) or (channels and event.channel not in channels):
                continue
            try:
                yield event, self.decode(event)
            except MessageError:
                continue

    # ---- where events are

    def _find_magic(self, at):
        found = self.data.find(_MAGIC, at)
        return found if found >= 0 else len(self.data)

    def _magic_at(self, at):
        return self.data[at:at + 4] == _MAGIC

    def _end(self, at):
        """Where the event ends by its header, perhaps beyond the file; None when the header is not plausible."""
        header = self.data[at:at + _HEADER.size]
        if len(header) < _HEADER.size:
            return None
        _, _, utime, channel, data = _HEADER.unpack(header)
        if not -LARGEST_TIME <= utime <= LARGEST_TIME or not 0 < channel <= MOST_CHANNEL or data > MOST_DATA:
            return None
        begin = at + _HEADER.size
        if not all(0x20 <= byte < 0x7F for byte in self.data[begin:begin + channel]):
            return None
        return begin + channel + data

    def _place(self, at):
        """(whether a whole event begins here, where the reading goes on)."""
        end = self._end(at) if self._magic_at(at) else None
        if end is None:
            return False, at + 1
        size = len(self.data)
        if end == size or (end < size and self._magic_at(end)):
            swallowed = self._swallowed(at, end)
            return swallowed is None, end if swallowed is None else swallowed
        # No magic follows: the length is wrong, and the event would swallow the next ones, or the next is damaged.
        limit = min(end, size)
        follower = self._follower(at + 4, limit, self._number(at))
        return end <= size and follower == limit, follower

    def _swallowed(self, at, end):
        """Where the events begin that this one has swallowed, because a damaged length ends it at a later one: their
        numbers are left out before the event at `end`, which they fill. None: it has not."""
        number = self._number(at)
        if end + _HEADER.size > len(self.data) or not 2 <= self._number(end) - number <= end - at:
            return None
        first = self._numbered(self.data.find(_MAGIC, at + _HEADER.size, end), end, number + 1)
        follower, last = first, number
        while follower is not None and follower < end:
            last += 1
            if not self._magic_at(follower) or self._number(follower) != last:
                return None
            follower = self._end(follower)
        return first if follower == end and self._number(end) == last + 1 else None

    def _numbered(self, at, end, number):
        """The first event with that number that a magic from `at` on begins, and that ends before `end`."""
        while at >= 0:
            behind = self._end(at)
            if behind is not None and behind <= end and self._number(at) == number:
                return at
            at = self.data.find(_MAGIC, at + 1, end)
        return None

    def _follower(self, begin, end, number):
        at = self.data.find(_MAGIC, begin, end)
        while at >= 0:
            behind = self._end(at)
            if behind is not None and behind <= len(self.data):
                last = behind == len(self.data) and self._number(at) == (number + 1 + 2**63) % 2**64 - 2**63
                if last or self._magic_at(behind):
                    return at
            at = self.data.find(_MAGIC, at + 1, end)
        return end

    def _number(self, at):
        return int.from_bytes(self.data[at + 4:at + 12], "big", signed=True)

    def _event(self, at, end):
        _, number, utime, channel, _ = _HEADER.unpack_from(self.data, at)
        begin = at + _HEADER.size
        return Event(number, utime, self.data[begin:begin + channel].decode("ascii"), self.data[begin + channel:end], at)


def _map(path):
    try:
        # Whoever opens a pipe waits for somebody who writes.
        with open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                raise LogError(f"{path}: cannot be read: it is no file")
            if status.st_size == 0:
                if os.pread(file.fileno(), 1, 0):  # as in /proc, which the kernel makes up
                    raise LogError(f"{path}: cannot be read: it has no length")
                return b""
            return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    except (OSError, ValueError) as error:
        raise LogError(f"{path}: cannot be read: {getattr(error, 'strerror', None) or error}") from None


class LogWriter:
    """Writes a new log that every LCM tool reads; a context manager. Raises LogError."""

    def __init__(self, path):
        self.path, self.number = str(path), 0
        try:
            self.file = open(path, "wb")
        except OSError as error:
            raise LogError(f"{path}: cannot be written: {error.strerror}") from None

    def write(self, utime, channel, data):
        """Writes an encoded message."""
        name = channel.encode("ascii", "replace")
        if not 0 < len(name) <= MOST_CHANNEL or not all(0x20 <= byte < 0x7F for byte in name):
            raise LogError(f"{self.path}: expected a channel of 1 to {MOST_CHANNEL} printable characters, got {channel!r}")
        if len(data) > MOST_DATA or not -LARGEST_TIME <= utime <= LARGEST_TIME:
            raise LogError(f"{self.path}: expected at most {MOST_DATA} bytes and a time before 2255, which readers take, "
                           f"got {len(data)} bytes at {utime} us")
        try:
            self.file.write(_HEADER.pack(_MAGIC, self.number, utime, len(name), len(data)) + name + data)
        except OSError as error:
            raise LogError(f"{self.path}: cannot be written: {error.strerror}") from None
        self.number += 1

    def write_message(self, utime, channel, struct, message):
        """Writes a dict as a message of a type of a Schema. Raises MessageError, too."""
        self.write(utime, channel, encode(struct, message))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.file.close()
        except OSError as error:
            raise LogError(f"{self.path}: cannot be written: {error.strerror}") from None
