"""Contents of frames: entries of bits, most significant first."""

from priamos_bus.bits import Ended, Reader, Writer  # noqa: F401

FRAME_ACK, EVENT_ACK, FLOOR, LISTEN, OVER, FORGET, NEXT_KEY = range(7)
SEGMENT = 26


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
