#!/usr/bin/env python3
"""Checks certificates of looproot: docs/certificate.md has the format and the theorems.
Exit code 0: every item holds; 2: one does not, which is named; 1: the certificate cannot be read."""
import argparse
import functools
import json
import re
import sys

import needs  # says what is missing
import eliminant
from closures import SLIDE, THREE_JOINTS, Platform, proved_modes
from conditions import four_joints
from curve import curve
from distance import distance
from documents import object_at
from double import with_doubles
from files import is_about
from geometry import geometry
from kernel import kernel
from one_form import is_in_one_form
from polynomial import derived
from quantities import Refused, expect, fields, items, require, whole
from real_zeros import real_zeros
from short_loops import lengthened, own_modes
from sweep import swept, system_of

LARGEST = 128 << 20  # characters of a file
GENERAL = {0: 16, 1: 16, 2: 8, 3: 2}  # solutions of six rotations and translations, by the number of translations


def check(certificate, file):
    """The claim of a certificate in words, if it is what the proof shows, and the data are those of a case of the file."""
    form, version, data, claim, modes, proof, _ = fields(
        certificate, ("format", "version", "data", "claim", "modes", "proof"), ("info",))
    expect(form == "looproot-certificate" and whole(version) == 1, (form, version), "looproot-certificate, version 1")
    verb = claim["verb"]
    require(verb in VERBS and items(proof), "claim: only answers of solve, derive, mobility, sweep and conditions with a proof are covered")
    system = system_of(data) if verb != "conditions" else None  # those are about no mechanism
    require(is_in_one_form(data), "data: the numbers are not written in the one form that docs/certificate.md gives them")
    require(file is None or is_about(system, file, verb), "file: the data of the certificate are those of no case of the file")
    found = {"verb": verb, "proof": "proved", **VERBS[verb](system, data, claim, modes, *proof)}
    plain = lambda value: json.dumps(value, sort_keys=True)  # where 1, 1.0 and true differ
    require(plain(found) == plain(claim), f"claim: found {plain(claim)[:200]}, where {plain(found)[:200]} is proved")
    return ", ".join(f"{key} {value}" for key, value in claim.items() if not isinstance(value, list))


def solved(system, data, claim, modes, item, *others):
    """As many solutions are proved as there are at most, theorems 8, 9 and 11 count some of the modes; or they form a curve: theorem 6."""
    kind = item["kind"]
    if kind == "curve" and not others:
        return {"status": "self-motion", "self_motion": curve(system, data, item, modes)}
    if [other["kind"] for other in others] == ["double"]:
        found = with_doubles(system, modes, BOUNDS.get(kind), item, *others)
    else:
        all_ones = LISTS[kind](system, modes, item) if kind in LISTS else all_modes(lengthened(system), modes, BOUNDS[kind], item)
        found = own_modes(system, all_ones, item, *others)
    real, total = sum(mode.multiplicity for mode in found if mode.is_real), sum(mode.multiplicity for mode in found)
    return {"status": "complete" if real else "unreachable", "real": real, **({} if kind in ("distance", "real-zeros") else {"complex": total})}


def all_modes(system, values, bound, item):
    """The modes, where they are as many as the item says there are at most."""
    _, stated, *aid = fields(item, ("kind", "value", *["aid"] * ("aid" in item)))
    most, modes = bound(system, *aid), proved_modes(system, values)
    require(most == whole(stated) == len(modes), f"proof: {item['kind']}: the bound is {most}, {stated} is stated, and {len(modes)} modes are proved")
    return modes


def general(system):
    """Theorem 2."""
    return 40 if isinstance(system, Platform) else [GENERAL, THREE_JOINTS, {}][min(len(system.spherical), 2)].get(system.kinds.count(SLIDE))


def moving(system, data, claim, modes, item, *others):
    """Theorems 5 to 7: whether a loop moves, and in how many dimensions."""
    require(not others and data["mechanism"]["kind"] == "loop" and "input" not in data, "proof: one item shows whether a loop without input moves")
    dimension = MOTIONS[item["kind"]](system, data, item, modes)
    return {"status": "mobile" if dimension else "immobile", "mobility": dimension}


def immobile(system, data, item, modes):
    """Theorem 5: the loop, or the longer one, has as many solutions as theorem 2 allows."""
    all_modes(lengthened(system), modes, general, item)
    return 0


def regular(system, data, item, modes):
    """Theorem 7: with one unknown of seven held a real solution is simple."""
    held = system_of({**data, "input": [fields(item, ("kind", "held"))[1]]})
    require(held.size == 6 and proved_modes(held, items(modes, 1))[0].is_real, "mode 1: a real configuration of seven unknowns is asked for")
    return 1


# Items that bound the number of all solutions; that have a list of their own; that decide whether a loop moves.
BOUNDS = {"general-bound": general, "geometry-bound": geometry, "eliminant": eliminant.most_solutions}
LISTS = {"own-eliminant": eliminant.own_eliminant, "distance": distance, "real-zeros": real_zeros, "kernel": kernel}
MOTIONS = {"general-bound": immobile, "eliminant": eliminant.immobile, "regular": regular, "curve": curve}
VERBS = {"solve": solved, "derive": functools.partial(derived, solved), "mobility": moving, "sweep": swept, "conditions": four_joints}


def certificates(path):
    """The objects of a file, one behind the other."""
    with open(path, encoding="utf-8") as file:
        text = file.read(LARGEST + 1)
    expect(len(text) <= LARGEST, "more", f"a file of at most {LARGEST} characters")
    space, at = re.compile(r"[ \t\n\r]*"), 0
    while (at := space.match(text, at).end()) < len(text):
        certificate, at = object_at(text, at)
        yield certificate


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = lambda message: sys.exit(f"error: {message}")
    parser.add_argument("certificate")
    parser.add_argument("--file", help="the mechanism that the certificate has to be about")
    arguments, code, number = parser.parse_args(), 0, 0
    try:
        for number, certificate in enumerate(certificates(arguments.certificate), 1):
            try:
                print(f"{arguments.certificate}:{number}: holds: {check(certificate, arguments.file)}")
            except Refused as refusal:
                print(f"{arguments.certificate}:{number}: refused: {refusal}")
                code = 2
        expect(number, "nothing", "a certificate")
    except Exception as error:  # Python finds at many places that a text is no certificate
        sys.exit(f"error: {arguments.certificate}: {type(error).__name__}: {str(error)[:200]}")
    sys.exit(code)


if __name__ == "__main__":
    main()
