"""Tokens of a .lcm text."""

import re
from dataclasses import dataclass

from .model import SchemaError

_BLANK = " \t\n\v\f\r"
# Bytes of a comment that are no UTF-8 (errors="surrogateescape") are taken for Latin-1.
_LATIN_1 = {0xDC00 + byte: chr(byte) if byte >= 0xA0 else "\ufffd" for byte in range(0x80, 0x100)}
_TOKEN = re.compile(r"""(?P<blank>[ \t\n\v\f\r]+)
    |(?P<line>//[^\n]*)
    |(?P<block>/\*.*?\*/)
    |(?P<word>[A-Za-z_][A-Za-z0-9_.]*)
    |(?P<number>(?=[0-9]|[-+.][0-9])[-+]?(?:(?<=[eE])[-+]|[0-9A-Za-z_.])*)
    |(?P<symbol>[{}\[\];,=])""", re.VERBOSE | re.DOTALL)


@dataclass
class Token:
    type: str  # word, number, symbol, comment, wrong, end
    text: str
    line: int
    last_line: int
    column: int
    starts_line: bool


def _stripped(text, marks):
    return text.strip(_BLANK).lstrip(marks).lstrip(_BLANK)


def tokenize(text):
    tokens, at, line, begin, empty = [], 0, 1, 0, True
    text = text.removeprefix("\ufeff")
    while at < len(text):
        match = _TOKEN.match(text, at)
        kind = match.lastgroup if match else "wrong"
        end = match.end() if match else at + 1
        if not match and text.startswith("/*", at):
            end = len(text)
        body = text[at:end]
        if kind != "blank":
            token = Token(kind, body, line, line, at - begin + 1, empty)
            empty = False
            if kind == "wrong":
                token.text = ("the comment is not closed" if body.startswith("/*") else
                              f"this character (code {ord(body)}) has no place in a .lcm file")
            elif kind in ("line", "block"):
                token.type = "comment"
                token.text = (_stripped(body, "/!<") if kind == "line" else
                              " ".join(filter(None, (_stripped(part, "/*!<") for part in body[:-2].split("\n")))))
        if "\n" in body:
            line += body.count("\n")
            begin = at + body.rindex("\n") + 1
            empty = kind == "blank"
        at = end
        if kind == "blank":
            continue
        token.last_line = line
        before = tokens[-1] if tokens else None
        if (kind == "line" and before and before.type == "comment" and token.starts_line
                and before.last_line + 1 == token.line and before.column == token.column):
            before.text += (" " if before.text and token.text else "") + token.text
            before.last_line = token.line
        else:
            tokens.append(token)
    tokens.append(Token("end", "", line, line, at - begin + 1, empty))
    for token in tokens:
        if token.type == "comment":
            token.text = token.text.translate(_LATIN_1)
    return tokens


class Tokens:
    """The tokens of one text, one after the other; what is not as expected raises SchemaError."""

    def __init__(self, file, text):
        self.file, self.tokens, self.at = file, tokenize(text), 0
        self.last = self.tokens[0]

    def peek(self):
        while self.tokens[self.at].type == "comment":
            self.at += 1
        return self.tokens[self.at]

    def next(self):
        self.last = self.peek()
        if self.last.type != "end":
            self.at += 1
        if self.last.type == "wrong":
            self.fail(self.last, self.last.text)
        return self.last

    def expect(self, symbol):
        token = self.next()
        if token.text != symbol:
            self.fail(token, f"expected '{symbol}', got {_got(token)}")

    def separator(self):
        token = self.next()
        if token.text not in (";", ","):
            self.fail(token, f"expected ';', got {_got(token)}")
        return token.text

    def word(self, what):
        token = self.next()
        if token.type != "word":
            self.fail(token, f"expected {what}, got {_got(token)}")
        return token.text

    def leading_comment(self):
        """The last comment here, when what follows begins on the next line at the latest."""
        text = ""
        while self.tokens[self.at].type == "comment":
            comment, follower = self.tokens[self.at], self.tokens[self.at + 1]
            text = comment.text if comment.last_line + 1 >= follower.line else ""
            self.at += 1
        return text

    def trailing_comment(self):
        token = self.tokens[self.at]
        if token.type != "comment" or token.line != self.last.last_line:
            return ""
        self.at += 1
        return token.text

    def begins_type(self):
        token = self.tokens[self.at]
        return token.type == "word" and token.text in ("struct", "enum") and self._behind(2) == "{"

    def skip_declaration(self):
        """To the end of a declaration that cannot be read."""
        while self.tokens[self.at].type != "end":
            token = self.tokens[self.at]
            if self.begins_type() or (token.type == "word" and token.text == "package" and self._behind(2) == ";"):
                return
            self.at += 1
            if token.type == "symbol" and token.text == "}":
                return

    def _behind(self, n):
        at = self.at
        while n > 0 and self.tokens[at].type != "end":
            at += 1
            n -= self.tokens[at].type != "comment"
        return self.tokens[at].text

    def fail(self, token, sentence):
        raise SchemaError(f"{self.file}:{token.line}: {sentence}")


def _got(token):
    return "the end of the file" if token.type == "end" else f"'{token.text}'"
