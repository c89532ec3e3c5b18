"""Theorems 2, 5 and 7 of docs/certificate.md: how many solutions a mechanism of a kind can have, and whether a loop moves."""
from closures import SLIDE, Platform, proved_modes
from mechanism import Reader
from quantities import Refused, fields, items, whole
from short_loops import lengthened

THREE_JOINTS = {0: 4, 1: 4, 2: 2, 3: 1}  # the ways in which they bring a point to its place, by their number of translations
GENERAL = {0: 16, 1: 16, 2: 8, 3: 2}


def general(system):
    """Theorem 2."""
    slides = system.kinds.count(SLIDE)
    known = [GENERAL, THREE_JOINTS, {}][min(len(system.spherical), 2)]
    return 40 if isinstance(system, Platform) else known.get(slides)


def immobile(system, data, item, modes):
    """Theorem 5: the longer loop has as many solutions as theorem 2 allows, and those of the loop are among them."""
    longer = lengthened(system)
    stated = whole(fields(item, ("kind", "value"))[1])
    if not general(longer) == stated == len(proved_modes(longer, modes)):
        raise Refused(f"modes: {general(longer)} solutions of the longer loop would prove that it does not move")
    return 0


def regular(system, data, item, modes):
    """Theorem 7: with one unknown of seven held a real solution is simple."""
    _, held = fields(item, ("kind", "held"))
    system = Reader().system({**data, "input": [held]})
    if system.size != 6:
        raise Refused("proof: regular: only loops of seven unknowns are covered")
    if [is_real for *_, is_real in proved_modes(system, items(modes, 1))] != [True]:
        raise Refused("mode 1: a real configuration is asked for")
    return 1
