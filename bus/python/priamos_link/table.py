"""The channel table of a link, from `priamos link table link.toml --json`."""

import hashlib
import json
from dataclasses import dataclass, field

from priamos_bus import Packer, Schema, filled, json_form

from .frames import DOWN, UP


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
    packer: Packer | None = None

    @property
    def one_segment(self):
        return 0 < self.fixed_bits <= 208


def _packer(channel):
    """Packs messages of the type that a channel of the JSON names, defined by its "lcm"; None without."""
    if "lcm" not in channel:
        return None
    schema = Schema([("the table", channel["lcm"])])
    struct = schema.find(str(channel["type"]))
    if struct is None:
        raise ValueError(f"channel {channel['name']}: no type {channel['type']}: {schema.problems[:1]}")
    return Packer(struct)


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
                                     _packer(c)) for c in data["channels"]]
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
            if c.packer is not None and c.packer.max_bits != c.max_bits:
                raise ValueError(f"channel {c.name}: a type of at most {c.packer.max_bits} bits")

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


def unpack(channel, packed, now_us):
    """The message as a dict, or None when the table does not say its type. Raises ValueError for what is no message."""
    return None if channel.packer is None else json_form(channel.packer.unpack(packed, now_us))


def age_of(channel, values, now_us):
    """How long ago a command was made, by its own time stamp [us]; 0 of other messages, and when it has none."""
    fields = channel.packer.struct.fields if channel.packer is not None and channel.kind == "command" else []
    name = next((f.name for f in fields if f.annotation.age_us is not None and not f.dims), None)
    stamp = values.get(name, 0)
    return max(0, now_us - stamp) if isinstance(stamp, int) and stamp else 0


def _stop_to_send(struct, values):
    """A STOP whose driver is none, with the nearest one: not to send it is the unsafe side. None for other messages, a
    REARM above all."""
    stop, driver = values.get("action") == 1, values.get("driver", 0)
    if struct.name != "estop_t" or not stop or not isinstance(driver, int):
        return None
    limits = next(f.annotation for f in struct.fields if f.name == "driver")
    return {**values, "driver": max(int(limits.min.value), min(int(limits.max.value), driver))}


def pack(channel, values, now_us):
    """Bytes and bits of a message; fields that are left out are 0 or empty, time stamps now. A STOP is sent
    with the nearest driver. Raises ValueError."""
    if channel.packer is None:
        raise ValueError(f'{channel.name}: expected "hex" and "bits": the table does not say its type')
    struct = channel.packer.struct
    values = _stop_to_send(struct, values) or values
    packed = channel.packer.pack(filled(struct, values, now_us), now_us)
    if packed.refused:
        raise ValueError(f"{channel.name}: expected values within their range, got another one in {packed.refused[0]}")
    return packed.bytes, packed.bits
