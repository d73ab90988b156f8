"""Definitions of types that a recorder wrote into a log, as messages of type_text_t: see bus/log/README.md."""

import itertools

from .decoding import decode
from .lcm_text import parse_lcm
from .model import MessageError
from .schema import Schema, fingerprint_of

TYPE_TEXT = "TYPE_TEXT"
MOST_TYPES = 4096  # of one log, whatever it holds
MOST_TEXT_BYTES = 16 << 20  # kept of texts whose messages have not come
MOST_TYPES_OF_TEXT, MOST_BYTES_OF_TEXT = 256, 1 << 18  # one text: a type with all types in it
MOST_READ_TEXTS = 64  # that are kept as they were read
MOST_VERSIONS, MOST_TRIES, MOST_WORK = 8, 64, 8  # of one part; whole texts put together; bytes of them per byte kept
_PART_OVERHEAD = 64  # bytes of memory beside the text
_OWN = Schema([("type_text_t.lcm", """package priamos;
struct type_text_t {
  int64_t utime;
  int64_t fingerprint;
  int16_t part;
  int16_t parts;
  string text;
}""")]).find("type_text_t")


def is_type_text(data):
    """Whether an encoded message defines a type."""
    return fingerprint_of(data) == _OWN.fingerprint


class TypeTexts:
    """Has `schema` know the types that a log defines itself, in whatever version.

    A log may hold definitions that are damaged or forged, on a live bus by anybody. A recorder writes the genuine one
    directly before the first message of the type: so the choice is made at that message, the newest text goes first, it
    has to define a type of that message's fingerprint, and better one that the message obeys. What comes later changes
    nothing. Of texts that many others follow before the message, one that defines its fingerprint is kept."""

    def __init__(self, schema):
        self.schema, self.claimed, self.chosen, self.text_bytes, self.chosen_bytes = schema, {}, 0, 0, 0
        self._read, self._proof_bytes = {}, 0

    def take(self, data):
        """Takes an encoded message; False when it is of another type."""
        if not is_type_text(data):
            return False
        try:
            message = decode(_OWN, data)
        except MessageError:
            return True
        fingerprint = message["fingerprint"] % 2**64
        if self.schema.find(fingerprint) is None and 0 <= message["part"] < message["parts"]:
            claimed = self.claimed.setdefault(fingerprint, _ClaimedTexts())
            self.text_bytes -= claimed.bytes
            if claimed.needs_proof():
                claimed.keep(lambda text: self._defines(text, fingerprint))
            claimed.add(message["part"], message["parts"], message["text"])
            self.text_bytes += claimed.bytes
            while self.text_bytes > MOST_TEXT_BYTES or len(self.claimed) > MOST_TYPES:
                self._forget(next(iter(self.claimed)))
        return True

    def of(self, data):
        """The type of an encoded message; None while it is unknown."""
        fingerprint = fingerprint_of(data)
        known = self.schema.find(fingerprint)
        full = self.chosen >= MOST_TYPES or self.chosen_bytes > MOST_TEXT_BYTES
        if known is not None or fingerprint not in self.claimed or full:
            return known
        struct = self._choose(self.claimed[fingerprint], fingerprint, data)
        if struct is not None:
            self.chosen += 1
            self.chosen_bytes += self.claimed[fingerprint].bytes
            self.schema.adopt(struct)
        self._forget(fingerprint)
        return struct

    def _choose(self, claimed, fingerprint, data):
        best = None
        for text in claimed.texts():
            schema = self._schema_of(text)
            struct = schema and schema.find(fingerprint)
            if struct is None:
                continue
            try:
                decode(struct, data)
                return struct
            except MessageError:
                best = best or struct
        return best

    def _defines(self, text, fingerprint):
        size = len(text.encode("utf-8", "surrogateescape"))
        if self._proof_bytes + size > MOST_TEXT_BYTES:
            return False
        self._proof_bytes += size
        schema = self._schema_of(text)
        return schema is not None and schema.find(fingerprint) is not None

    def _schema_of(self, text):
        """Its types; None when it defines none, or more than a recorder would write. Each text is read once, also when
        it is claimed to define many types."""
        if text not in self._read:
            if len(self._read) == MOST_READ_TEXTS:
                self._read.clear()
            fits = len(text.encode("utf-8", "surrogateescape")) <= MOST_BYTES_OF_TEXT
            types = len(parse_lcm("the log", text, [])) if fits else 0
            self._read[text] = Schema([("the log", text)]) if 0 < types <= MOST_TYPES_OF_TEXT else None
        return self._read[text]

    def _forget(self, fingerprint):
        self.text_bytes -= self.claimed.pop(fingerprint).bytes


class _ClaimedTexts:
    """What a log claims to be the text of one type: parts of texts, of which some may be damaged or forged."""

    def __init__(self):
        self.by_count, self.bytes, self.added, self.proof_at, self.proven = {}, 0, 0, 0, None

    def needs_proof(self):
        """Whether the next part may push out one that no proof has seen."""
        return self.proven is None and self.added - self.proof_at >= MOST_VERSIONS

    def keep(self, proves):
        """Keeps the first whole text that proves itself, whatever comes after it."""
        self.proof_at = self.added
        self.proven = next(filter(proves, self.texts()), None)
        if self.proven is not None:
            self.bytes += len(self.proven) + _PART_OVERHEAD

    def add(self, part, parts, text):
        self.added += 1
        self.by_count[parts] = self.by_count.pop(parts, {})  # the newest last
        versions = self.by_count[parts].setdefault(part, [])
        if text in versions:
            versions.remove(text)
            self.bytes -= len(text) + _PART_OVERHEAD
        elif len(versions) == MOST_VERSIONS:
            self.bytes -= len(versions.pop(0)) + _PART_OVERHEAD
        self.bytes += len(text) + _PART_OVERHEAD
        versions.append(text)

    def texts(self):
        """Whole texts, those of the newest parts first, the one that was kept last."""
        whole = [parts for count, parts in reversed(self.by_count.items()) if len(parts) == count][:MOST_TRIES]
        for parts in whole:
            # A share of the work for each, so that none keeps the others from being tried.
            seen, most = 0, MOST_WORK * self.bytes // len(whole)
            newest_first = [parts[i][::-1] for i in reversed(range(len(parts)))]
            for chosen in itertools.islice(itertools.product(*newest_first), MOST_TRIES // len(whole)):
                text = "".join(reversed(chosen))
                if seen > 0 and seen + len(text) > most:
                    break
                seen += len(text)
                yield text.encode("utf-8", "surrogateescape").decode("utf-8", "surrogateescape")
        if self.proven is not None:
            yield self.proven
