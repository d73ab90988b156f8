"""The content of .lcm files as data: filled by lcm_text, completed by schema."""

import re
from dataclasses import dataclass, field

INTEGER_BITS = {"int8_t": 8, "int16_t": 16, "int32_t": 32, "int64_t": 64}
STRUCT_CODES = {"int8_t": "b", "int16_t": "h", "int32_t": "i", "int64_t": "q", "float": "f", "double": "d",
                "boolean": "b", "byte": "B"}
SIZES = {"int8_t": 1, "int16_t": 2, "int32_t": 4, "int64_t": 8, "float": 4, "double": 8, "boolean": 1, "byte": 1}
PRIMITIVES = {*SIZES, "string"}


class SchemaError(ValueError):
    """A type that cannot be used; one sentence, `file:line: ...`."""


class MessageError(ValueError):
    """Bytes or a dict that are no message of a type; one sentence."""


@dataclass
class Number:
    """A number of an annotation; `integer` is exact where it was written as one."""
    value: float
    integer: int | None = None


@dataclass
class Annotation:
    """`[unit] @frame F @range A,B @step S @invalid V @max N @age US @refuse: meaning`."""
    unit: str = ""
    frame: str = ""
    min: Number | None = None
    max: Number | None = None
    step: Number | None = None
    invalid: Number | None = None
    sizes: list = field(default_factory=list)
    age_us: int | None = None
    refuse: bool = False
    meaning: str = ""
    problem: str = ""


@dataclass
class Dimension:
    """One dimension of an array: `size` elements, or as many as the field `count` says."""
    text: str
    size: int = 0
    count: str | None = None


@dataclass
class Field:
    name: str
    kind: str  # a primitive, or "struct"
    type_name: str
    line: int
    dims: list = field(default_factory=list)
    type: "Struct | None" = field(default=None, repr=False)
    comment: str = ""
    annotation: Annotation = field(default_factory=Annotation)


@dataclass
class Constant:
    name: str
    kind: str
    text: str
    value: Number
    line: int


@dataclass
class Struct:
    """A message type. `fingerprint` is LCM's, set by Schema."""
    package: str
    name: str
    full_name: str
    doc: str
    file: str
    line: int
    constants: list = field(default_factory=list)
    fields: list = field(default_factory=list)
    fingerprint: int = 0
    fixed_size: int | None = None  # encoded bytes of the body where every message has the same

    def where(self, part):
        return f"{self.file}:{part.line}: {self.full_name}.{part.name}: "

    def is_enumeration(self, part):
        """Whether `part` is an integer whose meaning names a constant, "IDLE", or with "LIMIT_..." several."""
        if part.kind not in INTEGER_BITS or part.annotation.age_us is not None:
            return False
        words = re.findall(r"[A-Za-z0-9_]+", part.annotation.meaning)
        return any(word == c.name or (word.endswith("_") and c.name.startswith(word))
                   for c in self.constants for word in words)
