"""Reads .lcm texts: a recursive descent, one function per rule of the grammar."""

import re

from .annotation import parse_annotation, parse_number
from .lcm_tokens import Tokens
from .model import INTEGER_BITS, PRIMITIVES, Constant, Dimension, Field, Number, SchemaError, Struct

MOST_DIMENSIONS = 32
_C_INTEGER = re.compile(r"[-+]?(?:0[xX](?P<hex>[0-9a-fA-F]+)|(?P<oct>0[0-7]+)|(?P<dec>0|[1-9][0-9]*))", re.ASCII)


def parse_lcm(file, text, problems):
    """The structs of a text. What cannot be read adds (full name, sentence) to `problems`."""
    return _Parser(file, text).run(problems)


def _c_integer(text):
    match = _C_INTEGER.fullmatch(text) if len(text) < 80 else None
    if not match:
        return None
    base = {"hex": 16, "oct": 8, "dec": 10}[match.lastgroup]
    value = int(match[match.lastgroup], base) * (-1 if text.startswith("-") else 1)
    return value if -2**63 <= value < 2**63 else None


class _Parser(Tokens):
    def run(self, problems):
        self.package, self.structs, strange = "", [], False
        while True:
            self.current = ""
            try:
                if not self._declaration():
                    return self.structs
            except SchemaError as error:
                # What is no type at all may go on for a whole file: its first line says enough.
                if self.current or not strange:
                    problems.append((self.current, str(error)))
                strange = strange or not self.current
                self.skip_declaration()

    def _declaration(self):
        doc, token = self.leading_comment(), self.next()
        if token.type == "end":
            return False
        if token.text == "package":
            self.package = self.word("the name of the package")
            self.expect(";")
        elif token.text == "struct":
            self._struct(doc)
        elif token.text == "enum":
            self.current = self._full_name(self.word("the name of the enum"))
            self.fail(token, "enum types are not supported, use constants in a struct")
        elif token.text != ";":
            self.fail(token, f"expected 'package' or 'struct', got '{token.text}'")
        return True

    def _full_name(self, name):
        return f"{self.package}.{name}" if self.package else name

    def _struct(self, doc):
        line = self.peek().line
        name = self.word("the name of the struct")
        if name in PRIMITIVES:
            self.fail(self.last, f"'{name}' is a primitive type of LCM")
        self.current = self._full_name(name)
        struct = Struct(self.package, name, self.current, doc, self.file, line)
        self.names = set()
        self.expect("{")
        while True:
            leading = self.leading_comment()
            if self.peek().text == "}":
                break
            if self.begins_type():
                got = self.peek()
                self.fail(got, f"expected a field or '}}', got '{got.text}': LCM has no types within types")
            if self.peek().text == "const":
                self._constants(struct)
            else:
                self._fields(struct, leading)
        self.expect("}")
        self.structs.append(struct)

    def _constants(self, struct):
        self.expect("const")
        kind = self.word("the type of the constant")
        if kind not in INTEGER_BITS and kind not in ("float", "double"):
            self.fail(self.last, f"a constant cannot be of type {kind}, only integers, float and double")
        while True:
            line, name = self.peek().line, self.word("the name of the constant")
            self._refuse_taken(struct, name)
            self.expect("=")
            token = self.next()
            struct.constants.append(Constant(name, kind, token.text, self._constant_value(kind, token), line))
            if self.separator() != ",":
                return

    def _constant_value(self, kind, token):
        if kind in INTEGER_BITS:
            value = _c_integer(token.text)
            half = 1 << INTEGER_BITS[kind] - 1
            if value is None or not -half <= value < half:
                self.fail(token, f"'{token.text}' is no {kind}")
            return Number(float(value), value)
        number = parse_number(token.text)
        if number is None:
            self.fail(token, f"'{token.text}' is no number")
        return number

    def _fields(self, struct, leading):
        type_name = self.word("the type of a field")
        kind = type_name if type_name in PRIMITIVES else "struct"
        if kind == "struct" and "." not in type_name:
            type_name = self._full_name(type_name)
        fields, comments = [], []
        while True:
            line, name = self.peek().line, self.word("the name of the field")
            self._refuse_taken(struct, name)
            field = Field(name, kind, type_name, line)
            while self.peek().text == "[":
                self._dimension(struct, field)
            struct.fields.append(field)
            fields.append(field)
            separator = self.separator()
            comments.append(self.trailing_comment())
            if separator != ",":
                break
        # A comment behind the semicolon belongs to every field of the declaration that has none of its own.
        for field, own in zip(fields, comments):
            _annotate(field, leading, own or comments[-1])

    def _dimension(self, struct, field):
        self.expect("[")
        token = self.next()
        if len(field.dims) == MOST_DIMENSIONS:
            self.fail(token, f"expected at most {MOST_DIMENSIONS} dimensions of an array, got more")
        constant = next((c for c in struct.constants if c.name == token.text), None)
        if token.type == "number":
            size = _c_integer(token.text)
            if size is None or not 0 < size < 2**31:
                self.fail(token, f"the array size '{token.text}' is not a whole number above 0")
            dimension = Dimension(token.text, size)
        elif constant:
            size = (constant.value.integer or 0) if constant.kind in INTEGER_BITS else 0
            if not 0 < size < 2**31:
                self.fail(token, f"the array size '{token.text}' is {constant.text}, not a whole number above 0")
            dimension = Dimension(constant.text, size)  # LCM's fingerprint does not know the name
        elif token.type == "word":
            dimension = Dimension(token.text, count=self._count(struct, token))
        else:
            self.fail(token, f"expected the size of the array, got '{token.text}'")
        self.expect("]")
        field.dims.append(dimension)

    def _count(self, struct, token):
        found = next((f for f in struct.fields if f.name == token.text), None)
        if found is None:
            self.fail(token, f"the array size '{token.text}' is no field declared before the array")
        if found.kind not in INTEGER_BITS or found.dims:
            self.fail(token, f"the array size '{token.text}' is not a single integer field")
        return found.name

    def _refuse_taken(self, struct, name):
        if name in self.names:
            self.fail(self.last, f"the name '{name}' is used twice in {struct.full_name}")
        self.names.add(name)


def _annotate(field, leading, trailing):
    field.comment = leading + (" " if leading and trailing else "") + trailing
    marked = next((part for part in (trailing, leading) if part.startswith("[")), field.comment)
    field.annotation = parse_annotation(marked)
