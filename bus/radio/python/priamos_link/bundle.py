"""Contents of frames: entries of bits, most significant first."""

FRAME_ACK, EVENT_ACK, FLOOR, LISTEN, OVER, FORGET, NEXT_KEY = range(7)
SEGMENT = 26


class Ended(Exception):
    """The rest of a bundle cannot be read."""


class Reader:
    def __init__(self, data):
        self.text = "".join(f"{byte:08b}" for byte in data)
        self.at = 0

    @property
    def left(self):
        return len(self.text) - self.at

    def get(self, bits):
        if bits > self.left:
            raise Ended
        self.at += bits
        return int(self.text[self.at - bits:self.at] or "0", 2)

    def take(self, bits):
        value = self.get(bits)
        return (value << -bits % 8).to_bytes(-(-bits // 8), "big")


class Writer:
    def __init__(self):
        self.text = ""

    def put(self, value, bits):
        if bits:
            self.text += f"{value & (1 << bits) - 1:0{bits}b}"

    def append(self, data, bits):
        self.text += "".join(f"{byte:08b}" for byte in data)[:bits]

    def bytes(self):
        size = -(-len(self.text) // 8)
        return int(self.text.ljust(8 * size, "0") or "0", 2).to_bytes(size, "big")


def encode_duration(seconds):
    for exponent in range(8):
        mantissa = round(max(0, seconds) * 1e3 / 4**exponent)
        if mantissa < 512:
            return exponent << 9 | mantissa
    return 0xFFF


def decode_duration(code):
    return (code & 0x1FF) * 4**(code >> 9) / 1e3


def apply_difference(widths, before, reader):
    """A message that differs from `before` by what the reader holds."""
    old, out = Reader(before), Writer()
    for width in widths:
        value = old.get(width)
        if reader.get(1):
            if width <= 4 or reader.get(1):
                value = reader.get(width)
            else:
                short = width // 3 + 1
                value = (value + reader.get(short) - (1 << short - 1)) % (1 << width)
        out.put(value, width)
    return out.bytes()
