#!/usr/bin/env python3
"""Checks certificates of looproot: docs/certificate.md has the format and the theorems.

usage: verify.py CERTIFICATE [--file MECHANISM]

Exit code 0: every item holds; 2: one does not, which is named; 1: the certificate cannot be read.
"""
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.set_int_max_str_digits(4300)
try:
    from bounds import check_proof
    from chains import Chain
    from distance import check_distance
    from isolation import modes_of, prove_all
    from mobility import check_mobility
    from platforms import Platform
    from quantities import Refused, Unreadable, Whole, count, fields, items
except ImportError as error:
    sys.exit(f"error: {error}; python-flint is needed: pip install python-flint")

VERSION = 1
LONGEST = 4 << 20  # bytes of one certificate


def refuse_constant(text):
    raise Unreadable(f"found {text}, expected a number")


def distinct(pairs):
    table = dict(pairs)
    if len(table) != len(pairs):
        raise Unreadable("found a key twice in one object")
    return table


def parse(text):
    try:
        return json.loads(text, parse_int=Whole, parse_float=refuse_constant, parse_constant=refuse_constant, object_pairs_hook=distinct)
    except RecursionError:
        raise Unreadable("found brackets nested too deeply") from None
    except ValueError as error:
        raise Unreadable(f"found no JSON: {str(error)[:80]}") from None


def certificates(path):
    """One object a line, or one object in all."""
    try:
        with open(path, "rb") as file:
            head = file.readline(LONGEST + 1).strip()
            is_line = head.startswith(b"{") and head.endswith(b"}")
            rest = None if is_line else file.read(LONGEST + 1)
            if len(head) + len(rest or b"") > LONGEST:
                raise Unreadable(f"found more than {LONGEST} bytes in one certificate")
            if not is_line:
                yield 1, parse((head + rest).decode())
                return
            line = 1
            while head:
                yield line, parse(head.decode())
                head, line = b"\n", line + 1
                while head.isspace():
                    head = file.readline(LONGEST + 1)
                head = head.strip()
                if len(head) > LONGEST:
                    raise Unreadable(f"found more than {LONGEST} bytes in one certificate")
    except OSError as error:
        raise Unreadable(error.strerror or "cannot be read") from None
    except UnicodeDecodeError:
        raise Unreadable("found bytes that are no UTF-8") from None


def check(certificate, source):
    form, version, data, claim, modes, proof = fields(
        certificate, ("format", "version", "data", "claim", "modes", "proof"), ("info",))[:6]
    if form != "looproot-certificate" or count(version) != VERSION:
        raise Unreadable(f"found format {str(form)[:40]!r}, version {str(version)[:20]}, expected looproot-certificate, version {VERSION}")
    verb = claim.get("verb") if isinstance(claim, dict) else None
    if verb == "mobility":
        if source is not None:
            source(data, True)
        return check_mobility(data, claim, modes, proof)
    _, status, word, real, complex_ = fields(claim, ("verb", "status", "proof", "real"), ("complex",))
    if verb != "solve" or word != "proved":
        raise Refused("claim: only proved answers of solve and mobility are covered")
    mechanism = data.get("mechanism") if isinstance(data, dict) else None
    kind = mechanism.get("kind") if isinstance(mechanism, dict) else None
    if not isinstance(mechanism, dict):
        raise Unreadable("found no mechanism among the data")
    kinds = {"arm": Chain, "loop": Chain, "platform": Platform}
    if kind not in kinds:
        raise Unreadable(f"found the kind {str(kind)[:40]!r}, expected one of {', '.join(kinds)}")
    system = kinds[kind](data)
    if system.size not in (6, 7) or kind != "platform" and system.size != 6:
        raise Refused(f"closure: {system.size} unknowns, where this checker proves loops of six")
    if source is not None:
        source(data)
    first = proof[0] if isinstance(proof, list) and len(proof) == 1 else None
    if isinstance(first, dict) and first.get("kind") == "distance":
        return check_distance(system, claim, modes, first)
    modes = modes_of(modes, system.size)
    prove_all(system, modes)
    check_proof(system, modes, items(proof))
    if count(complex_) != len(modes):
        raise Refused(f"claim: complex is {complex_}, where {len(modes)} are proved")
    found = sum(is_real for _, _, is_real in modes)
    if count(real) != found:
        raise Refused(f"claim: real is {real}, where {found} are proved")
    if status != ("complete" if found else "unreachable"):
        raise Refused(f"claim: the status is {str(status)[:40]!r}, where {found} real solutions are proved")
    return f"{len(modes)} solutions, {found} of them real: complete, proved"


def main(arguments):
    if len(arguments) not in (1, 3) or len(arguments) == 3 and arguments[1] != "--file" or arguments[0] in ("-h", "--help"):
        print(__doc__.strip(), file=sys.stdout if "-h" in arguments or "--help" in arguments else sys.stderr)
        return 0 if "-h" in arguments or "--help" in arguments else 1
    path, code, several = arguments[0], 0, 0
    try:
        source = None
        if len(arguments) == 3:
            from source import Source
            source = Source(arguments[2]).compare
        for line, certificate in certificates(path):
            several += 1
            try:
                print(f"{path}:{line}: holds: {check(certificate, source)}")
            except Refused as refusal:
                print(f"{path}:{line}: refused: {refusal}")
                code = 2
        if not several:
            raise Unreadable("found no certificate")
    except Unreadable as error:
        print(f"error: {path}: {error}", file=sys.stderr)
        return 1
    except (ArithmeticError, AttributeError, LookupError, MemoryError, RecursionError, TypeError, ValueError) as error:
        print(f"error: {path}: found what is no certificate: {type(error).__name__}: {str(error)[:80]}", file=sys.stderr)
        return 1
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
