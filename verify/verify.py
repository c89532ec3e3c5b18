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
    from algebraic import is_one_in, points
    from bounds import distance, general, geometry
    from closure_polynomial import check_polynomial
    from closures import proved_modes
    from eliminants import most_solutions
    from mechanism import FAULTS, Reader, is_same, of_file
    from mobility import curve, immobile, regular
    from motions import IDENTITY
    from quantities import Refused, Unreadable, Whole, fields, is_exact, items, whole
    from real_zeros import most_real
except ImportError as error:
    sys.exit(f"error: {error}; python-flint is needed: pip install python-flint")

LONGEST = 4 << 20  # bytes of one certificate
# The items of a proof, and the theorem of each: of `solve` the most solutions that there are, with complex ones or without, from the
# system and what is under `aid`; of `mobility` the dimension of the motion.
SOLUTIONS = {"general-bound": general, "geometry-bound": geometry, "eliminant": most_solutions, "own-eliminant": most_solutions}
REAL_SOLUTIONS = {"real-zeros": most_real, "distance": distance}
MOTIONS = {"eliminant": immobile, "general-bound": immobile, "curve": curve, "regular": regular}


def check(certificate, file):
    """What a certificate proves, in words. `file` returns the systems of a mechanism file, with or without inputs."""
    form, version, data, claim, modes, proof, _ = fields(
        certificate, ("format", "version", "data", "claim", "modes", "proof"), ("info",))
    if form != "looproot-certificate" or whole(version) != 1:
        raise Unreadable(f"found format {str(form)[:40]!r}, version {str(version)[:20]}, expected looproot-certificate, version 1")
    verb, is_motion = claim.get("verb"), claim.get("verb") == "mobility"
    if verb not in ("solve", "mobility", "derive") or claim.get("proof") != "proved":
        raise Refused("claim: only proved answers of solve, mobility and derive are covered")
    system, = Reader(data, True).systems(not is_motion)
    if not items(proof):
        raise Refused("proof: found no item")
    item, *others = proof
    # A second item says which solutions of a longer loop are those of a shorter one, or that they are all roots of a polynomial.
    second = {"solve": "points" if system.size < 6 and others else None, "derive": "membership"}.get(verb)
    if [other.get("kind") for other in others] != [second] * (second is not None):
        raise Refused(f"proof: found {1 + len(others)} items, expected one, and a second one for polynomials and loops of fewer than six unknowns")
    known = MOTIONS if is_motion else {**SOLUTIONS, **REAL_SOLUTIONS}
    if item.get("kind") not in known:
        raise Unreadable(f"proof: found the kind {str(item.get('kind'))[:40]!r}, expected one of {', '.join(known)}")
    if file is not None and not any(is_same(system, own) for own in file(not is_motion)):
        raise Refused("file: the data of the certificate are those of no case of the file")
    if verb == "derive":
        of_polynomial = {key: claim.pop(key) for key in ("unknown", "degree", "polynomial")}
        words = of_solutions(system, claim, modes, item, [])
        if item["kind"] not in SOLUTIONS or system.size < 6:
            raise Refused("proof: the roots of a polynomial are proved by all solutions of a loop of six unknowns")
        check_polynomial(system, modes, of_polynomial, others[0])
        return f"{words}; of the polynomial of degree {of_polynomial['degree']} they are all roots"
    return of_motion(data, claim, modes, item) if is_motion else of_solutions(system, claim, modes, item, others)


def of_motion(data, claim, modes, item):
    _, status, _, stated = fields(claim, ("verb", "status", "proof", "mobility"))
    if data["mechanism"]["kind"] != "loop":
        raise Refused("data: whether it moves is proved of a loop")
    found = MOTIONS[item["kind"]](data, item, modes)
    if whole(stated) != found or status != ("mobile" if found else "immobile"):
        raise Refused(f"claim: found {str(status)[:20]!r} of dimension {stated}, where dimension {found} is proved")
    return f"{status}, of dimension {found}: proved"


def of_solutions(system, claim, modes, item, others):
    kind, has_complex = item["kind"], item["kind"] in SOLUTIONS
    _, status, _, real, *total = fields(claim, ("verb", "status", "proof", "real", *(("complex",) if has_complex else ())))
    size, longer = system.size, system.longer()
    if longer.size != (7 if system.kinds == "platform" else 6) or size < 6 and not has_complex or size > 5 and kind == "own-eliminant":
        raise Refused(f"closure: {size} unknowns, where this checker proves loops of six, and of fewer with all solutions")
    is_of_own = kind == "own-eliminant"
    keys = ("value", "aid") if kind in ("eliminant", "own-eliminant", "real-zeros") else ("value",) * (kind != "distance")
    _, *stated = fields(item, ("kind", *keys))
    found = proved_modes(longer, modes)
    bound = {**SOLUTIONS, **REAL_SOLUTIONS}[kind](system if is_of_own else longer, *stated[1:])
    if bound is None or stated and whole(stated[0]) != bound:
        raise Refused(f"proof: {kind}: the value is {stated[:1]}, where the bound is {'not known' if bound is None else bound}")
    if len(found) != bound or not has_complex and not all(is_real for *_, is_real in found):
        raise Refused(f"proof: {kind}: at most {bound} solutions, and {len(found)} modes are proved, some of them perhaps not real")
    if size < 6:
        # Solutions of the longer loop count where its added rotations are 0.
        exact = exact_solutions(system, others[0]) if others else None
        is_own = lambda mode: is_one_in(exact, system.kinds, mode) if is_of_own and exact else not any(
            longer.differ(k, mode[0][k], mode[1]) for k in range(size, 6))
        own, count = [mode for mode in found if is_own(mode)], exact[0].degree() if exact else 0
        if len(own) != count or is_of_own and len(found) != count:
            raise Refused(f"proof: points: they are {count}, and {len(own)} of the {len(found)} modes may be solutions of the loop")
        found = own
    found_real = sum(is_real for *_, is_real in found)
    if [whole(x) for x in (real, *total)] != [found_real, len(found)][:1 + has_complex]:
        raise Refused(f"claim: found other numbers than {len(found)} solutions, {found_real} of them real")
    if status != ("complete" if found_real else "unreachable"):
        raise Refused(f"claim: the status is {str(status)[:40]!r}, where {found_real} real solutions are proved")
    of_all = f"{len(found)} solutions, {found_real} of them real" if has_complex else f"{found_real or 'no'} real solutions"
    return f"{of_all}: complete, proved"


def exact_solutions(system, item):
    """Theorem 11: the points of an item, at all of which the loop closes."""
    found = points(item, system.kinds)
    if system.spherical or not is_exact(system.constants()) or system.around(found[1]) != IDENTITY:
        raise Refused("proof: points: the loop is not closed there")
    return found


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
