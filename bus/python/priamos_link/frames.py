"""Frames on the line, as PROTOCOL.md has them: COBS, blocks, codes, encryption."""

import hashlib
import hmac
from dataclasses import dataclass

UP, DOWN = 0, 1
WHOLE_TAG, HELLO_TAG = 0x80, 0x81
LONGEST_BUNDLE = 240
_BLOCKS = {(8 * n + 6) // 7 + 8: n for n in (11, 14, 17, 21, 24, 28, 34)}


def blake(key, data, size):
    return hashlib.blake2b(data, digest_size=size, key=key).digest()


def cobs_encode(data):
    out, block = bytearray(), bytearray()
    for byte in data:
        if byte:
            block.append(byte)
            continue
        out.append(len(block) + 1)
        out += block
        block.clear()
    out.append(len(block) + 1)
    return bytes(out + block)


def cobs_decode(data):
    """The content, or None when these bytes are none."""
    out, at = bytearray(), 0
    while at < len(data):
        code = data[at]
        if code == 0 or at + code > len(data):
            return None
        out += data[at + 1:at + code]
        at += code
        if at < len(data) and code < 255:
            out.append(0)
    return bytes(out)


def block_decode(data):
    """The content of a block, errors not corrected; None when it has not the form of one."""
    size = _BLOCKS.get(len(data))
    if size is None or any(byte < 0x80 for byte in data):
        return None
    bits = "".join(f"{byte & 0x7F:07b}" for byte in data)[:8 * size]
    return int(bits, 2).to_bytes(size, "big")


@dataclass
class Hello:
    table_hash: int
    stream: int
    nonce: int
    echo: int
    need: bool = False
    agreed: bool = False
    over: bool = False
    code_bytes: int = 4


@dataclass
class Data:
    counter: int
    bundle: bytes
    echo: int | None  # counter of a frame of this end


class Window:
    """Counters that came: each is accepted once."""

    def __init__(self, floor=0):
        self.highest, self.used = floor, (1 << 64) - 1

    def fresh(self, counter):
        if counter > self.highest:
            return True
        back = self.highest - counter
        return back < 64 and not self.used >> back & 1

    def use(self, counter):
        if counter > self.highest:
            ahead = counter - self.highest
            self.used = self.used << ahead & (1 << 64) - 1 if ahead < 64 else 0
            self.highest = counter
        self.used |= 1 << self.highest - counter

    def complete(self, low):
        first = max(0, self.highest - 31)
        return first + (low - first & 0x7F)


class Codec:
    """Seals the frames of one direction and opens those of the other."""

    def __init__(self, link_key, table, outgoing):
        self.authentication_key = blake(link_key, b"priamos radio 1 authentication", 32)
        self.encryption_key = blake(link_key, b"priamos radio 1 encryption", 32)
        self.table, self.outgoing = table, outgoing

    def epoch_of(self, onboard, offboard):
        data = b"epoch" + onboard.to_bytes(8, "little") + offboard.to_bytes(8, "little")
        return int.from_bytes(blake(self.authentication_key, data, 32)[:8], "little") or 1

    def seal(self, epoch, counter, bundle, whole, echo):
        head = bytes([WHOLE_TAG]) + counter.to_bytes(5, "little") if whole else bytes([counter & 0x7F])
        size = 0 if whole else self.table.echo_bytes(self.outgoing)
        if size:
            head += (echo & (1 << 8 * size) - 1).to_bytes(size, "little")
        code = self._code(self.outgoing, epoch, counter, echo if size else None, bundle)
        if self.table.encrypted:
            bundle = self._crypt(self.outgoing, epoch, counter, code, bundle)
        return cobs_encode(head + bundle + code) + b"\0"

    def seal_hello(self, hello):
        flags = hello.need | hello.agreed << 1 | hello.over << 2 | (hello.code_bytes - 4) // 2 << 3
        body = (hello.table_hash.to_bytes(4, "little") + hello.stream.to_bytes(4, "little")
                + hello.nonce.to_bytes(8, "little") + hello.echo.to_bytes(8, "little") + bytes([flags]))
        return cobs_encode(bytes([HELLO_TAG]) + body + self._hello_code(self.outgoing, body)) + b"\0"

    def open(self, content, epoch, window, newest_sent):
        """Data, Hello or None."""
        if len(content) < 1 + self.table.code_bytes:
            return None
        if content[0] == HELLO_TAG:
            return self._open_hello(content)
        return self._open_data(content, epoch, window, newest_sent) if epoch else None

    def _open_hello(self, content):
        body, code = content[1:26], content[26:]
        if len(content) != 34 or not hmac.compare_digest(code, self._hello_code(1 - self.outgoing, body)):
            return None
        number = lambda a, b: int.from_bytes(body[a:b], "little")
        flags = body[24]
        return Hello(number(0, 4), number(4, 8), number(8, 16), number(16, 24), bool(flags & 1), bool(flags & 2),
                     bool(flags & 4), 4 + 2 * (flags >> 3 & 3))

    def _open_data(self, content, epoch, window, newest_sent):
        if content[0] > WHOLE_TAG:
            return None
        whole, echo = content[0] == WHOLE_TAG, None
        at = 1 + (5 if whole else self.table.echo_bytes(1 - self.outgoing))
        if len(content) < at + self.table.code_bytes or len(content) - at > LONGEST_BUNDLE + self.table.code_bytes:
            return None
        counter = int.from_bytes(content[1:6], "little") if whole else window.complete(content[0])
        if not whole and at > 1:
            echo = newest_sent - (newest_sent - int.from_bytes(content[1:at], "little") & (1 << 8 * (at - 1)) - 1)
        bundle, code = content[at:-self.table.code_bytes], content[-self.table.code_bytes:]
        if echo is not None and echo < 0:
            return None
        if self.table.encrypted:
            bundle = self._crypt(1 - self.outgoing, epoch, counter, code, bundle)
        right = self._code(1 - self.outgoing, epoch, counter, echo, bundle)
        if not hmac.compare_digest(code, right) or not window.fresh(counter):
            return None
        window.use(counter)
        return Data(counter, bundle, echo)

    def _code(self, direction, epoch, counter, echo, bundle):
        kind = (3 if self.table.encrypted else 1) + (0 if echo is None else 4)
        head = (bytes([kind, direction]) + epoch.to_bytes(8, "little") + counter.to_bytes(8, "little")
                + self.table.hash.to_bytes(4, "little"))
        if echo is not None:
            head += echo.to_bytes(8, "little")
        return blake(self.authentication_key, head + bundle, 16)[:self.table.code_bytes]

    def _hello_code(self, direction, body):
        return blake(self.authentication_key, bytes([2, direction]) + bytes(20) + body, 16)[:8]

    def _crypt(self, direction, epoch, counter, code, bundle):
        from cryptography.hazmat.primitives.ciphers import Cipher
        from cryptography.hazmat.primitives.ciphers.algorithms import ChaCha20

        numbers = bytes([direction]) + epoch.to_bytes(8, "little") + counter.to_bytes(8, "little") + code
        key = blake(self.encryption_key, numbers, 32)
        return Cipher(ChaCha20(key, bytes(16)), mode=None).encryptor().update(bundle)
