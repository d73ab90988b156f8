"""All types that a program knows: nested types resolved, LCM's fingerprints computed."""

import pathlib

from .lcm_text import parse_lcm
from .model import SIZES, SchemaError

_MASK = 2**64 - 1
_HUGE = 2**62


def read_folder(folder):
    """(file, text) of every .lcm file below `folder`, for Schema. Raises SchemaError."""
    try:
        files = sorted(path for path in pathlib.Path(folder).rglob("*.lcm") if path.is_file())
        texts = [(str(path), path.read_text("utf-8", "surrogateescape")) for path in files]
    except OSError as error:
        raise SchemaError(f"{folder}: cannot be read: {error.strerror}") from None
    if not texts:
        raise SchemaError(f"{folder}: there is no .lcm file in it")
    return texts


def own_types():
    """(file, text) of PRIAMOS's own types, installed beside this file or in its clone."""
    here = pathlib.Path(__file__).resolve().parent
    folder = here / "lcmtypes"
    return read_folder(folder if folder.is_dir() else here.parents[2] / "lcmtypes")


def fingerprint_of(data):
    """The first eight bytes of a message; 0 when there are fewer."""
    return int.from_bytes(data[:8], "big") if len(data) >= 8 else 0


class Schema:
    """The types of `texts`, (file, text) each. One that cannot be used is no hindrance: `problems` names it."""

    def __init__(self, texts):
        self.types, self.problems, self._by_fingerprint = {}, [], {}
        self._refused, ambiguous = set(), set()
        for file, text in texts:
            unreadable = []
            structs = parse_lcm(file, text, unreadable)
            for name, sentence in unreadable:
                self._refuse(name, sentence)
            for struct in structs:
                known = self.types.setdefault(struct.full_name, struct)
                if known is not struct and not _same_definition(known, struct):
                    self._refuse(struct.full_name, f"{file}:{struct.line}: expected one definition of "
                                 f"{struct.full_name}, got another one than in {known.file}:{known.line}")
                    ambiguous.add(struct.full_name)
        for name in ambiguous:
            del self.types[name]
        self._remove_incomplete()
        for struct in self.types.values():
            for field in struct.fields:
                if field.kind == "struct":
                    field.type = self.types[field.type_name]
        self._compute()

    def find(self, name_or_fingerprint):
        """The type of this name (full, or short where only one has it) or fingerprint; None when unknown."""
        if isinstance(name_or_fingerprint, int):
            return self._by_fingerprint.get(name_or_fingerprint)
        if name_or_fingerprint in self.types:
            return self.types[name_or_fingerprint]
        found = [s for s in self.types.values() if s.name == name_or_fingerprint]
        return found[0] if len(found) == 1 else None

    def of(self, data):
        """The type of an encoded message; None when unknown."""
        return self._by_fingerprint.get(fingerprint_of(data))

    def adopt(self, struct):
        """Has a type of another Schema found by its fingerprint, too."""
        self._by_fingerprint.setdefault(struct.fingerprint, struct)

    def _refuse(self, name, sentence):
        self.problems.append(sentence)
        self._refused.add(name)

    def _remove_incomplete(self):
        changed = True
        while changed:
            changed = False
            for name, struct in sorted(self.types.items()):
                missing = next((f for f in struct.fields if f.kind == "struct" and f.type_name not in self.types), None)
                if missing:
                    wanted = "can be used" if missing.type_name in self._refused else "is defined"
                    self._refuse(name, f"{struct.where(missing)}expected a type that {wanted}, got {missing.type_name}")
                    del self.types[name]
                    changed = True

    def _compute(self):
        fingerprints = _Fingerprints()
        sizes = {}
        for name, struct in sorted(self.types.items()):
            try:
                struct.fingerprint = fingerprints.of(struct)
                struct.fixed_size = _fixed_size(struct, sizes)
            except (SchemaError, RecursionError):
                self._refuse(name, f"{struct.file}:{struct.line}: the types around {name} nest too deeply")
                del self.types[name]
        self._remove_incomplete()
        for _, struct in sorted(self.types.items()):
            self._by_fingerprint.setdefault(struct.fingerprint, struct)


def _same_definition(a, b):
    def fields(struct):
        return [(f.name, f.type_name, [(d.text, d.size, d.count) for d in f.dims]) for f in struct.fields]

    # A comment is a part of the definition when it says how the radio packs the field.
    return (fields(a) == fields(b)
            and all(x.comment == y.comment for x, y in zip(a.fields, b.fields) if x.annotation.unit or y.annotation.unit)
            and [(c.name, c.kind, c.text) for c in a.constants] == [(c.name, c.kind, c.text) for c in b.constants])


def _fixed_size(struct, known):
    """Encoded bytes of a body that has no string and no variable array; else None."""
    if id(struct) in known:
        return known[id(struct)]
    known[id(struct)] = None  # what a type sees of itself while it is open
    total = 0
    for field in struct.fields:
        size = _fixed_size(field.type, known) if field.kind == "struct" else SIZES.get(field.kind)
        for dimension in field.dims:
            size = None if size is None or dimension.count else min(size * dimension.size, _HUGE)
        if size is None:
            return None
        total = min(total + size, _HUGE)
    known[id(struct)] = total
    return total


def _member_hash(struct):
    """lcm-gen's hash of the fields: the shift to the right is arithmetic, characters are signed."""
    value = 0x12345678

    def add(byte):
        nonlocal value
        shifted = (value - 2**64 if value >> 63 else value) >> 55
        value = ((value << 8 ^ shifted) + ((byte + 128) % 256 - 128)) & _MASK

    def add_text(text):
        add(len(text))
        for byte in text.encode("utf-8", "surrogateescape"):
            add(byte)

    for field in struct.fields:
        add_text(field.name)
        if field.kind != "struct":
            add_text(field.type_name)
        add(len(field.dims))
        for dimension in field.dims:
            add(1 if dimension.count else 0)
            add_text(dimension.text)
    return value


class _Fingerprints:
    def __init__(self):
        self.known, self.parents, self.terms = {}, set(), 0

    def of(self, struct):
        self.parents.clear()
        self.terms = 0
        return self._sum(struct)

    def _sum(self, struct):
        if id(struct) in self.parents:
            return 0
        if id(struct) in self.known:
            return self.known[id(struct)]
        self.terms += 1
        if len(self.parents) > 256 or self.terms > 1_000_000:
            raise SchemaError("too deep")
        self.parents.add(id(struct))
        value = _member_hash(struct)
        for field in struct.fields:
            if field.type is not None:
                value = value + self._sum(field.type) & _MASK
        self.parents.discard(id(struct))
        value = (value << 1 & _MASK) + (value >> 63) & _MASK
        # Only a type that reaches no recursion has the same hash under every parent.
        if not reaches_recursion(struct):
            self.known[id(struct)] = value
        return value


def reaches_recursion(struct):
    """Whether a type that contains itself is in `struct`."""
    done, path = set(), set()

    def search(node):
        if id(node) in path:
            return True
        if id(node) in done:
            return False
        path.add(id(node))
        if any(field.type is not None and search(field.type) for field in node.fields):
            return True
        path.discard(id(node))
        done.add(id(node))
        return False

    return search(struct)
