"""Definitions of types that a recorder wrote into a log, as messages of type_text_t: see bus/log/README.md."""

from .decoding import decode
from .model import MessageError
from .schema import Schema

TYPE_TEXT = "TYPE_TEXT"
MOST_TYPES = 4096  # of one log, whatever it holds
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
            schema.adopt(Schema([("the log", "".join(known[i] for i in range(parts)))]))
