"""Texts of files as documents: nothing may be cut, and no key may stand twice."""
import json
import math
import tomllib

from quantities import expect

LARGEST = 64 << 20  # bytes of a mechanism file
DEEPEST = 127  # tables and lists in each other


def document_of(path):
    """A mechanism file, in TOML or JSON, with every number as text."""
    with open(path, "rb") as file:
        text = file.read(LARGEST + 1)
    expect(len(text) <= LARGEST, "more", f"a file of at most {LARGEST} bytes")
    text = text.decode("utf-8-sig")  # with or without a mark of the order of bytes
    if text.lstrip().startswith("{"):
        return as_texts(json.loads(text, parse_int=str, parse_float=str, object_pairs_hook=distinct))
    return as_texts(tomllib.loads(text, parse_float=str))


def distinct(pairs):
    expect(len(dict(pairs)) == len(pairs), pairs, "each key of an object once")
    return dict(pairs)


def finite(text):
    """A number of an object that is no text and no whole number; none is NaN or infinite."""
    expect(math.isfinite(float(text)), text, "a number")
    return float(text)


def whole_or_finite(text):
    """A number of an object that is written as a whole one; -0 is none."""
    return finite(text) if text == "-0" or not math.isfinite(float(text)) else int(text)


DECODER = json.JSONDecoder(object_pairs_hook=distinct, parse_int=whole_or_finite, parse_float=finite, parse_constant=finite)


def object_at(text, at):
    """The object that begins at a place of a text, and its end."""
    value, end = DECODER.raw_decode(text, at)
    expect(depth(value) <= DEEPEST, "deeper nesting", f"at most {DEEPEST} tables and lists in each other")
    json.dumps(value, ensure_ascii=False).encode()  # halves of characters are no text
    return value, end


def depth(value):
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, list) else None
    return 0 if parts is None else 1 + max(map(depth, parts), default=0)


def as_texts(value):
    """With every number as text."""
    if isinstance(value, dict):
        return {key: as_texts(own) for key, own in value.items()}
    return list(map(as_texts, value)) if isinstance(value, list) else str(value)
