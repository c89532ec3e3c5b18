#!/usr/bin/env python3
"""Checks certificates of looproot: docs/certificate.md has the format and the theorems.

usage: verify.py CERTIFICATE [--file MECHANISM]

Exit code 0: every item holds; 2: one does not, which is named; 1: the certificate cannot be read.
"""
import itertools
import json
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.set_int_max_str_digits(4300)
try:
    import bounds
    import eliminant
    from closures import proved_modes
    from conditions import four_joints
    from curve import curve
    from distance import distance
    from files import FAULTS, is_same, of_file
    from geometry import geometry
    from mechanism import Reader
    from polynomial import polynomial_of
    from quantities import Refused, Unreadable, fields, items, whole
    from real_zeros import most_real
    from short_loops import lengthened, own_modes
except ImportError as error:
    sys.exit(f"error: {error}; python-flint is needed: pip install python-flint")

LARGEST = 128 << 20  # characters of a file of certificates
# Items that bound the number of solutions: by what, their keys beside the kind, and whether complex solutions count, too.
BOUNDS = {
    "general-bound": (bounds.general, ("value",), True), "geometry-bound": (geometry, ("value",), True),
    "eliminant": (eliminant.most_solutions, ("value", "aid"), True), "distance": (distance, (), False),
    "own-eliminant": (eliminant.most_solutions, ("value", "aid"), True), "real-zeros": (most_real, ("value", "aid"), False),
}
# Items that decide whether a loop moves.
MOTIONS = {"general-bound": bounds.immobile, "eliminant": eliminant.immobile, "regular": bounds.regular, "curve": curve}


def check(certificate, of_file):
    """The claim of a certificate in words, if it is what the proof shows. `of_file` returns the systems of a mechanism file."""
    form, version, data, claim, modes, proof, _ = fields(
        certificate, ("format", "version", "data", "claim", "modes", "proof"), ("info",))
    if form != "looproot-certificate" or whole(version) != 1:
        raise Unreadable(f"found format {str(form)[:40]!r}, version {str(version)[:20]}, expected looproot-certificate, version 1")
    if claim.get("verb") not in VERBS or not items(proof):
        raise Refused("claim: only answers of solve, derive, mobility and conditions with a proof are covered")
    has_input = claim["verb"] != "mobility"
    system = Reader().system(data, has_input) if claim["verb"] != "conditions" else None  # those are about no mechanism
    if of_file and not (system and any(is_same(system, own) for own in of_file(has_input))):
        raise Refused("file: the data of the certificate are those of no case of the file")
    found = {"verb": claim["verb"], "proof": "proved", **VERBS[claim["verb"]](system, data, claim, modes, *proof)}
    plain = lambda value: json.dumps(value, sort_keys=True)
    if plain(found) != plain(claim):
        raise Refused(f"claim: found {plain(claim)[:200]}, where {plain(found)[:200]} is proved")
    return ", ".join(f"{key} {value}" for key, value in claim.items() if not isinstance(value, list))


def solved(system, data, claim, modes, item, *others):
    """Theorems 2 to 4, 8, 9 and 11: as many solutions are proved as there are at most; theorem 6: they form a curve."""
    if item["kind"] == "curve" and not others:
        return {"status": "self-motion", "self_motion": curve(system, data, item, modes)}
    kind, (bound, keys, has_complex) = item["kind"], BOUNDS[item["kind"]]
    is_short, is_of_own, longer = system.size < 6, kind == "own-eliminant", lengthened(system)
    if is_short and not has_complex or not is_short and (is_of_own or others) or len(others) > 1:
        raise Refused(f"proof: found {1 + len(others)} items, the first of kind {kind}, which prove nothing of {system.size} unknowns")
    found, (_, *stated) = proved_modes(longer, modes), fields(item, ("kind", *keys))
    most = bound(system if is_of_own else longer, *stated[1:])
    if most is None or stated and whole(stated[0]) != most:
        raise Refused(f"proof: {kind}: the value is {stated[:1]}, where the bound is {'not known' if most is None else most}")
    if len(found) != most or not has_complex and not all(is_real for *_, is_real in found):
        raise Refused(f"proof: {kind}: at most {most} solutions, and {len(found)} modes are proved, some of them perhaps not real")
    if is_short:
        found = own_modes(system, found, is_of_own, others)
    real = sum(is_real for *_, is_real in found)
    return {"status": "complete" if real else "unreachable", "real": real, **({"complex": len(found)} if has_complex else {})}


def derived(system, data, claim, modes, item, *others):
    """Theorem 10: beside all solutions the polynomial whose roots they are."""
    if [other.get("kind") for other in others] != ["membership"]:
        raise Refused("proof: the roots of a polynomial are proved by a bound and a membership")
    found = solved(system, data, claim, modes, item)
    if "complex" not in found:
        raise Refused("proof: the roots of a polynomial are proved by all solutions")
    return {**found, **polynomial_of(system, modes, claim, *others)}


def moving(system, data, claim, modes, item, *others):
    """Theorems 5 to 7: whether a loop moves, and in how many dimensions."""
    if others or data["mechanism"]["kind"] != "loop":
        raise Refused("proof: of a loop one item shows whether it moves")
    dimension = MOTIONS[item["kind"]](system, data, item, modes)
    return {"status": "mobile" if dimension else "immobile", "mobility": dimension}


VERBS = {"solve": solved, "derive": derived, "mobility": moving, "conditions": four_joints}


def distinct(pairs):
    table = dict(pairs)
    if len(table) != len(pairs):
        raise Unreadable("found a key twice in one object")
    return table


def certificates(path):
    """The objects of a file, one behind the other, with their numbers from 1."""
    decoder, space, at = json.JSONDecoder(object_pairs_hook=distinct), re.compile(r"\s*"), 0
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read(LARGEST + 1)
        if len(text) > LARGEST:
            raise Unreadable(f"found more than {LARGEST} characters")
        for number in itertools.count(1):
            if (at := space.match(text, at).end()) == len(text):
                break
            certificate, at = decoder.raw_decode(text, at)
            yield number, certificate
    except OSError as error:
        raise Unreadable(error.strerror or "cannot be read") from None
    except (RecursionError, ValueError) as error:
        raise Unreadable(f"found no JSON: {str(error)[:80]}") from None


def main(arguments):
    is_help, code, is_empty = arguments[:1] in (["-h"], ["--help"]), 0, True
    if is_help or len(arguments) != 1 and not (len(arguments) == 3 and arguments[1] == "--file"):
        print(__doc__.strip(), file=sys.stdout if is_help else sys.stderr)
        return 0 if is_help else 1
    path, file = arguments[0], (lambda has_input: of_file(arguments[2], has_input)) if len(arguments) == 3 else None
    try:
        for number, certificate in certificates(path):
            try:
                print(f"{path}:{number}: holds: {check(certificate, file)}")
            except Refused as refusal:
                print(f"{path}:{number}: refused: {refusal}")
                code = 2
            is_empty = False
        if is_empty:
            raise Unreadable("found no certificate")
    except (Unreadable, *FAULTS) as error:
        kind = "" if isinstance(error, Unreadable) else f"found what is no certificate: {type(error).__name__}: "
        print(f"error: {path}: {kind}{str(error)[:200]}", file=sys.stderr)
        return 1
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
