"""Numbers of any width, most significant bit first; the last byte is filled with zeros."""


class Ended(Exception):
    """There are fewer bits left than wanted."""


class Reader:
    def __init__(self, data):
        self.value, self.size, self.at = int.from_bytes(data, "big"), 8 * len(data), 0

    @property
    def left(self):
        return self.size - self.at

    def get(self, bits):
        if bits > self.left:
            raise Ended
        self.at += bits
        return self.value >> self.size - self.at & (1 << bits) - 1

    def take(self, bits):
        value = self.get(bits)
        return (value << -bits % 8).to_bytes(-(-bits // 8), "big")


class Writer:
    def __init__(self):
        self.value, self.size = 0, 0

    def put(self, value, bits):
        self.value = self.value << bits | value & (1 << bits) - 1
        self.size += bits

    def append(self, data, bits):
        """The first `bits` bits of `data`."""
        self.put(int.from_bytes(data, "big") >> 8 * len(data) - bits, bits)

    def bytes(self):
        fill = -self.size % 8
        return (self.value << fill).to_bytes((self.size + fill) // 8, "big")
