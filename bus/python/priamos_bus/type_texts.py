"""Definitions of types that a recorder wrote into a log, as messages of type_text_t: see bus/log/README.md."""

from .decoding import decode
from .model import MessageError
from .schema import Schema

TYPE_TEXT = "TYPE_TEXT"
MOST_TYPES = 4096  # of one log, whatever it holds
MOST_VALUES = 100_000  # of one message that need no byte of it: structs without fields, in arrays and nested
_OWN = Schema([("type_text_t.lcm", """package priamos;
struct type_text_t {
  int64_t utime;
  int64_t fingerprint;
  int16_t part;
  int16_t parts;
  string text;
}""")]).find("type_text_t")


class TypeTexts:
    """Parts of texts as they come."""

    def __init__(self):
        self.open, self.done = {}, set()

    def take(self, data, schema):
        """Takes an encoded message; when it completes the text of a type, `schema` knows the type from now on."""
        try:
            message = decode(_OWN, data)
        except MessageError:
            return
        fingerprint, parts = message["fingerprint"], message["parts"]
        if fingerprint in self.done or not 0 <= message["part"] < parts or len(self.done) + len(self.open) >= MOST_TYPES:
            return
        known = self.open.setdefault((fingerprint, parts), {})
        known[message["part"]] = message["text"]
        if len(known) == parts:
            del self.open[fingerprint, parts]
            self.done.add(fingerprint)
            defined = Schema([("the log", "".join(known[i] for i in range(parts)))])
            counts = {}
            schema.adopt(defined, lambda struct: _values(struct, counts) <= MOST_VALUES)


def _values(struct, counts):
    """Number of values in every message of a type, its arrays of variable size left out."""
    if id(struct) in counts:
        return counts[id(struct)]
    counts[id(struct)] = total = 1
    for field in struct.fields:
        values = 1 if field.type is None else _values(field.type, counts)
        for dimension in field.dims:
            values = values if dimension.count else min(values * dimension.size, MOST_VALUES + 1)
        total = min(total + values, MOST_VALUES + 1)
    counts[id(struct)] = total
    return total
