"""The channel table of a link, from `priamos link table link.toml --json`."""

import hashlib
import json
import re
from dataclasses import dataclass, field

from .frames import DOWN, UP

_RANGE = re.compile(r"(?:(age) )?(-?[\d.]+)\.\.(-?[\d.]+) by ([\d.e-]+)(?:, or (-?[\d.]+))?$")


@dataclass
class Channel:
    name: str
    meaning: str
    direction: int
    kind: str  # state, event or command
    fixed_bits: int
    max_bits: int
    ttl_us: int
    urgent: bool
    delta: list = field(default_factory=list)
    fields: list = field(default_factory=list)

    @property
    def one_segment(self):
        return 0 < self.fixed_bits <= 208


class Table:
    """Channels in their order, and what both ends must have in common."""

    def __init__(self, text):
        """`text`: the JSON. Raises ValueError with one sentence when it is no table."""
        try:
            data = json.loads(text)
            self.encrypted, self.code_bytes = bool(data["encrypted"]), int(data["code_bytes"])
            self.baud, self.bytes_per_s = int(data["baud"]), float(data["bytes_per_s"])
            self.channels = [Channel(c["name"], c["meaning"], UP if c["direction"] == "up" else DOWN, c["class"],
                                     c["fixed_bits"], c["max_bits"], c["ttl_us"], c["urgent"], c["delta"],
                                     c.get("fields", [])) for c in data["channels"]]
            claimed = int(data["table_hash"], 16)
            self._check()
            self.hash = self._hash()
        except (ArithmeticError, AttributeError, KeyError, RecursionError, TypeError, ValueError) as error:
            raise ValueError(f"expected what `priamos link table link.toml --json` prints, got {error}") from None
        if self.hash != claimed:
            raise ValueError(f"expected a table with hash {self.hash:08x}, got {claimed:08x}: print it anew")
        self.id_bits = (len(self.channels) + 1).bit_length()

    def _check(self):
        """What the hash does not cover, and what would make the process busy for ever."""
        if not (30 <= self.bytes_per_s <= 1e6 and 300 <= self.baud <= 1_000_000):
            raise ValueError(f"baud {self.baud} and {self.bytes_per_s} byte/s")
        for c in self.channels:
            if not all(isinstance(width, int) and width > 0 for width in c.delta):
                raise ValueError(f"channel {c.name}: delta {c.delta}")
            for f in c.fields:
                if not (0 <= int(f["bits"]) <= 65535 and 0 <= int(f["values"]) <= 65535):
                    raise ValueError(f"channel {c.name}: a field of {f['bits']} bits, {f['values']} times")
                FieldCode(f["codes"])

    def echo_bytes(self, direction):
        if not any(c.kind == "command" and c.direction == direction for c in self.channels):
            return 0
        return 1 if self.bytes_per_s <= 2000 else 2

    def index(self, name):
        return next((i for i, c in enumerate(self.channels) if c.name == name), None)

    def _hash(self):
        text = "priamos radio 1 table " + ("sealed" if self.encrypted else "clear")
        text += "" if self.code_bytes == 4 else f" code {self.code_bytes}"
        for c in self.channels:
            number = 3 if c.delta else ("state", "event", "command").index(c.kind)
            text += f"\n{c.name} {c.meaning} {c.direction} {number} {c.fixed_bits} {c.max_bits} {c.ttl_us}"
            text += " " + ",".join(map(str, c.delta)) if c.delta else ""
        return int.from_bytes(hashlib.blake2b((text + "\n").encode(), digest_size=16).digest()[:4], "little")


class FieldCode:
    """How a field of numbers is packed: `codes` of `priamos link bits`."""

    def __init__(self, codes):
        match = _RANGE.match(codes)
        self.boolean = codes == "false, true"
        self.known = self.boolean or match is not None
        if match:
            age, first, last, step, none = match.groups()
            self.age, self.first, self.step = age is not None, float(first), float(step)
            if self.step <= 0 or (self.age and self.step < 1):
                raise ValueError(f"codes {codes}")
            self.none = None if none is None else float(none)
            self.last = round((float(last) - self.first) / self.step)

    def value(self, code, now_us):
        """Raises ValueError for a code that the field does not have."""
        if self.boolean:
            return bool(code)
        if self.none is not None and code == self.last + 1:
            return self.none
        if code > self.last:
            raise ValueError(f"expected a code up to {self.last}, got {code}")
        value = self.first + code * self.step
        return now_us - round(value) if self.age else round(value, 9)

    def code(self, value, now_us):
        if self.boolean:
            return int(bool(value))
        if self.none is not None and value == self.none:
            return self.last + 1
        if self.age:  # never younger than the truth
            return min(self.last, max(0, -int((value - now_us) // round(self.step))))
        return min(self.last, max(0, round((value - self.first) / self.step)))


def unpack(channel, packed, bits, now_us):
    """Fields by name, or None when the type has more than numbers. Raises ValueError for a code it does not have."""
    values, at, text = {}, 0, f"{int.from_bytes(packed, 'big'):0{8 * len(packed)}b}" if packed else ""
    for f in channel.fields:
        code = FieldCode(f["codes"])
        if not code.known or f["values"] == 0:
            return None
        each = []
        for _ in range(f["values"]):
            each.append(code.value(int(text[at:at + f["bits"]] or "0", 2), now_us))
            at += f["bits"]
        values[f["name"]] = each if f["values"] > 1 else each[0]
    return values if channel.fields and at == bits else None


def pack(channel, values, now_us):
    """Bytes and bits of a message of numbers. Raises ValueError with one sentence."""
    text = ""
    for f in channel.fields:
        code = FieldCode(f["codes"])
        if not code.known:
            raise ValueError(f"{channel.name}: expected \"hex\" and \"bits\": {f['name']} is no number")
        value = values.get(f["name"], now_us if getattr(code, "age", False) else 0)
        each = value if isinstance(value, list) else [value]
        if len(each) != f["values"] or not all(isinstance(v, (int, float)) for v in each):
            raise ValueError(f"{channel.name}: {f['name']}: expected {f['values']} numbers, got {value!r}")
        text += "".join(f"{code.code(v, now_us):0{f['bits']}b}" if f["bits"] else "" for v in each)
    if not text:
        raise ValueError(f"{channel.name}: expected a message of numbers, got none")
    return int(text.ljust(-(-len(text) // 8) * 8, "0"), 2).to_bytes(-(-len(text) // 8), "big"), len(text)
