"""Encoded messages as dicts, every byte checked."""

import struct as binary

from .model import INTEGER_BITS, SIZES, STRUCT_CODES, MessageError
from .schema import fingerprint_of

DEEPEST = 64
MOST_EMPTY = 32768  # elements that need no bytes are memory all the same
_FLOAT = binary.Struct(">f")


def decode(struct, data):
    """A message as a dict in the order of its fields: int, float, bool, str, lists, dicts; bytes for arrays of
    bytes. A float is the shortest decimal that reads back as it; a boolean that is neither 0 nor 1 is an int; a
    text that is no UTF-8 has surrogates (errors="surrogateescape"). Raises MessageError."""
    reader = _Reader(struct, data)
    if len(data) < 8:
        reader.fail("the message ends within a field")
    if fingerprint_of(data) != struct.fingerprint:
        reader.at = 0
        reader.fail("the fingerprint is that of another type")
    fields = reader.body(struct)
    if reader.at != len(data):
        reader.fail("there are bytes behind the last field")
    return fields


def short_float(value):
    """The shortest decimal that reads back as this number of 32 bits: 1.14, not 1.1399999856948853."""
    if value != value or value in (float("inf"), float("-inf")):
        return value
    for digits in range(1, 9):
        short = float(f"{value:.{digits}g}")
        try:
            if _FLOAT.unpack(_FLOAT.pack(short))[0] == value:
                return short
        except OverflowError:  # rounded up beyond the largest one
            pass
    return float(f"{value:.9g}")


class _Reader:
    def __init__(self, struct, data):
        self.struct, self.data, self.at, self.depth, self.empty_left = struct, bytes(data), 8, 0, MOST_EMPTY

    def fail(self, sentence):
        raise MessageError(f"{self.struct.full_name}: byte {self.at} of {len(self.data)}: {sentence}")

    def take(self, size):
        if size > len(self.data) - self.at:
            self.fail("the message ends within a field")
        self.at += size
        return self.at - size

    def body(self, struct):
        if self.depth == DEEPEST:
            self.fail("structs are nested too deeply")
        self.depth += 1
        values, counts = {}, {}
        counting = {d.count for field in struct.fields for d in field.dims}
        for field in struct.fields:
            if not field.dims:
                if field.kind == "struct" and field.type.fixed_size == 0:
                    self.note_empty(1)
                begin = self.at
                values[field.name] = self.value(field)
                if field.kind in INTEGER_BITS:
                    counts[field.name] = values[field.name]
                if field.name in counting and counts[field.name] < 0:
                    self.at = begin
                    self.fail("the count of an array is negative")
                continue
            sizes = [counts[d.count] if d.count else d.size for d in field.dims]
            self.check_sizes(field, sizes)
            values[field.name] = self.array(field, sizes, 0)
        self.depth -= 1
        return values

    def check_sizes(self, field, sizes):
        """Refuses counts that the bytes left cannot hold, before anything is made of them."""
        left = len(self.data) - self.at
        each = field.type.fixed_size if field.kind == "struct" else SIZES.get(field.kind)
        elements, rows = 1, 0
        for i, size in enumerate(sizes):
            if i > 0:
                rows = max(rows, elements)
            elements *= size
            if elements > left + self.empty_left:
                self.fail("the count of an array is larger than the message")
            if elements == 0:
                break
        if elements == 0 or each == 0:
            self.note_empty(max(rows, elements))
        if elements * (each or 0) > left:
            self.fail("the count of an array is larger than the message")

    def note_empty(self, values):
        """Refuses a message of more values without bytes than any has; a few lines of text define billions."""
        self.empty_left -= values
        if self.empty_left < 0:
            self.fail("the count of an array is larger than the message")

    def array(self, field, sizes, level):
        size, last = sizes[level], level + 1 == len(sizes)
        if not last:
            return [self.array(field, sizes, level + 1) for _ in range(size)]
        if field.kind == "byte":
            begin = self.take(size)
            return self.data[begin:self.at]
        if field.kind in STRUCT_CODES:
            begin = self.take(size * SIZES[field.kind])
            values = binary.unpack_from(f">{size}{STRUCT_CODES[field.kind]}", self.data, begin)
            return [_plain(field.kind, value) for value in values]
        return [self.value(field) for _ in range(size)]

    def value(self, field):
        if field.kind == "struct":
            return self.body(field.type)
        if field.kind == "string":
            return self.text()
        begin = self.take(SIZES[field.kind])
        return _plain(field.kind, binary.unpack_from(">" + STRUCT_CODES[field.kind], self.data, begin)[0])

    def text(self):
        length = int.from_bytes(self.data[self.take(4):self.at], "big", signed=True)
        if not 1 <= length <= len(self.data) - self.at:
            self.fail("the length of a string is not above 0 or larger than the message")
        begin = self.take(length)
        if self.data[self.at - 1] != 0:
            self.fail("a string does not end in a zero")
        return self.data[begin:self.at - 1].decode("utf-8", "surrogateescape")


def _plain(kind, value):
    if kind == "float":
        return short_float(value)
    if kind == "boolean" and value in (0, 1):
        return value == 1
    return value
