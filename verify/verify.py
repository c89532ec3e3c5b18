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
    from bounds import distance, general, geometry
    from closures import proved_modes
    from eliminants import most_solutions
    from mechanism import FAULTS, Reader, is_same, of_file
    from mobility import curve, immobile, regular
    from quantities import Refused, Unreadable, Whole, fields, items, whole
    from real_zeros import most_real
except ImportError as error:
    sys.exit(f"error: {error}; python-flint is needed: pip install python-flint")

LONGEST = 4 << 20  # bytes of one certificate
# The items of a proof, the theorem that each rests on, and what it gives: of `solve` a bound on the number of solutions (complex
# ones included, or the real ones alone), or that there is no real one; of `mobility` the dimension of the motion.
SOLUTIONS = {"general-bound": general, "geometry-bound": geometry, "eliminant": most_solutions}
REAL_SOLUTIONS = {"real-zeros": most_real}
MOTIONS = {"eliminant": immobile, "curve": curve, "regular": regular}


def check(certificate, file):
    """What a certificate proves, in words. `file` returns the systems of a mechanism file, with or without inputs."""
    form, version, data, claim, modes, proof, _ = fields(
        certificate, ("format", "version", "data", "claim", "modes", "proof"), ("info",))
    if form != "looproot-certificate" or whole(version) != 1:
        raise Unreadable(f"found format {str(form)[:40]!r}, version {str(version)[:20]}, expected looproot-certificate, version 1")
    verb, kind = claim.get("verb"), items(proof)[0].get("kind") if len(proof) == 1 else None
    if verb not in ("solve", "mobility") or claim.get("proof") != "proved":
        raise Refused("claim: only proved answers of solve and mobility are covered")
    if len(proof) != 1:
        raise Refused(f"proof: found {len(proof)} items, expected one")
    known = MOTIONS if verb == "mobility" else {**SOLUTIONS, **REAL_SOLUTIONS, "distance": distance}
    if kind not in known:
        raise Unreadable(f"proof: found the kind {str(kind)[:40]!r}, expected one of {', '.join(known)}")
    system, = Reader(data, True).systems(verb == "solve")
    if file is not None and not any(is_same(system, own) for own in file(verb == "solve")):
        raise Refused("file: the data of the certificate are those of no case of the file")
    return of_motion(data, claim, modes, proof[0]) if verb == "mobility" else of_solutions(system, claim, modes, proof[0])


def of_motion(data, claim, modes, item):
    _, status, _, stated = fields(claim, ("verb", "status", "proof", "mobility"))
    if data["mechanism"]["kind"] != "loop":
        raise Refused("data: whether it moves is proved of a loop")
    found = MOTIONS[item["kind"]](data, item, modes)
    if whole(stated) != found or status != ("mobile" if found else "immobile"):
        raise Refused(f"claim: found {str(status)[:20]!r} of dimension {stated}, where dimension {found} is proved")
    return f"{status}, of dimension {found}: proved"


def of_solutions(system, claim, modes, item):
    _, status, _, real, stated = fields(claim, ("verb", "status", "proof", "real"), ("complex",))
    kind = item["kind"]
    if system.size != (7 if system.kinds == "platform" else 6):
        raise Refused(f"closure: {system.size} unknowns, where this checker proves loops of six")
    if kind == "distance":
        fields(item, ("kind",))
        items(modes, 0)
        complex_, found, counts_all = 0, 0, False
        if not distance(system):
            raise Refused("proof: distance: no length exceeds the others together")
    else:
        complex_, found = proved_modes(system, modes)
        counts_all = kind in SOLUTIONS
        _, value, *aid = fields(item, ("kind", "value", "aid") if kind in ("eliminant", "real-zeros") else ("kind", "value"))
        bound = (SOLUTIONS if counts_all else REAL_SOLUTIONS)[kind](system, *aid)
        if bound is None or whole(value) != bound:
            raise Refused(f"proof: {kind}: the value is {value}, where the bound is {'not known' if bound is None else bound}")
        if complex_ != bound or not counts_all and found != bound:
            raise Refused(f"proof: {kind}: at most {bound} solutions, and {complex_} modes are proved, {found} of them real")
    if whole(real) != found or (whole(stated) if counts_all else stated) != (complex_ if counts_all else None):
        raise Refused(f"claim: real is {real} and complex {stated}, where {found} real ones of {complex_} are proved")
    if status != ("complete" if found else "unreachable"):
        raise Refused(f"claim: the status is {str(status)[:40]!r}, where {found} real solutions are proved")
    if kind == "distance":
        return "no real solution: proved"
    return f"{complex_} solutions, {found} of them real: complete, proved" if counts_all else f"{found} real solutions: complete, proved"


def refuse_constant(text):
    raise Unreadable(f"found {text[:40]}, expected a number as text")


def distinct(pairs):
    table = dict(pairs)
    if len(table) != len(pairs):
        raise Unreadable("found a key twice in one object")
    return table


def parse(text):
    if len(text) > LONGEST:
        raise Unreadable(f"found more than {LONGEST} bytes in one certificate")
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
            line = 0
            while text := file.readline(LONGEST + 1):
                line += 1
                if line == 1 and not text.strip().endswith(b"}"):
                    text += file.read(LONGEST + 1)
                if text.strip():
                    yield line, parse(text.decode())
    except OSError as error:
        raise Unreadable(error.strerror or "cannot be read") from None
    except UnicodeDecodeError:
        raise Unreadable("found bytes that are no UTF-8") from None


def main(arguments):
    is_help, several, code = arguments[:1] in (["-h"], ["--help"]), 0, 0
    if is_help or len(arguments) != 1 and not (len(arguments) == 3 and arguments[1] == "--file"):
        print(__doc__.strip(), file=sys.stdout if is_help else sys.stderr)
        return 0 if is_help else 1
    path, file = arguments[0], (lambda has_input: of_file(arguments[2], has_input)) if len(arguments) == 3 else None
    try:
        for line, certificate in certificates(path):
            several += 1
            try:
                print(f"{path}:{line}: holds: {check(certificate, file)}")
            except Refused as refusal:
                print(f"{path}:{line}: refused: {refusal}")
                code = 2
        if not several:
            raise Unreadable("found no certificate")
    except Unreadable as error:
        print(f"error: {path}: {error}", file=sys.stderr)
        return 1
    except FAULTS as error:
        print(f"error: {path}: found what is no certificate: {type(error).__name__}: {str(error)[:80]}", file=sys.stderr)
        return 1
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
