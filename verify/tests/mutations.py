"""Changes every number of certificates in one of its first three digits, and counts what both checkers still accept.

usage: LOOPROOT=target/release/looproot verify/tests/mutations.py CERTIFICATES...

What stands under `aid` may be accepted, and radii and centres that stay valid. Anything else makes the exit code 1.
"""
import collections
import copy
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.environ.get("VERIFY", str(pathlib.Path(__file__).resolve().parents[1] / "verify.py"))))
import verify

FREE = {"aid", "radius", "centre"}
NUMBER = re.compile(r"\d+(?:\.\d+)?")


def leaves(value, path=()):
    """All texts and whole numbers (no words such as `true`) but those of `info`, with the keys that lead to them."""
    if isinstance(value, dict):
        for key, own in value.items():
            if path or key != "info":
                yield from leaves(own, (*path, key))
    elif isinstance(value, list):
        for at, own in enumerate(value):
            yield from leaves(own, (*path, at))
    elif isinstance(value, (str, int)) and not isinstance(value, bool):
        yield path, value


def replaced(certificate, path, value):
    other = copy.deepcopy(certificate)
    place = other
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return other


def changed(certificate):
    """(place, certificate with one digit changed) for every number."""
    for path, value in leaves(certificate):
        text = str(value)
        for at, number in enumerate(NUMBER.finditer(text)):
            digits = [k for k in range(number.start(), number.end()) if text[k].isdigit()][:3]
            digit = digits[(at + len(path)) % len(digits)]
            own = text[:digit] + str((int(text[digit]) + 3) % 10) + text[digit + 1:]
            is_free = lambda key: key in FREE and path[0] != "data"
            name = next((str(key) for key in path if is_free(key)), "/".join(str(k) for k in path if isinstance(k, str)))
            yield name, replaced(certificate, path, type(value)(own))


def tables(value, path=()):
    """All tables, with the keys that lead to them."""
    if isinstance(value, dict):
        yield path, value
    for key, own in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from tables(own, (*path, key))


def renamed(certificate):
    """The certificate with one digit changed of every number that is a key, such as those of bodies and joints of linkages."""
    for path, table in tables({key: own for key, own in certificate.items() if key != "info"}):
        for key in filter(str.isdigit, table):
            other = str((int(key[0]) + 3) % 10) + key[1:]
            place = "keys of " + "/".join(str(k) for k in path if not str(k).isdigit())
            yield place, replaced(certificate, path, {other if name == key else name: own for name, own in table.items()})


def turned(certificate):
    """The certificate with one sign of a polynomial changed, for every sign of the families."""
    for path, value in leaves(certificate):
        for sign in re.finditer("[+-]", value if "families" in path else ""):
            own = value[:sign.start()] + ("-" if sign.group() == "+" else "+") + value[sign.end():]
            yield f"signs of {path[-2]}", replaced(certificate, path, own)


def accepted_by_python(certificate):
    try:
        verify.check(certificate, None)
        return True
    except Exception:  # refused, or no certificate any more
        return False


def accepted_by_rust(certificates):
    """Which of them `looproot verify` accepts; where it cannot read one it stops, and goes on with the next."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "changed")
        while len(found) < len(certificates):
            rest = certificates[len(found):len(found) + 400]
            with open(path, "w") as file:
                file.writelines(json.dumps(one) + "\n" for one in rest)
            answer = subprocess.run([os.environ["LOOPROOT"], "verify", path], capture_output=True, text=True)
            found += [": holds: " in line for line in answer.stdout.splitlines()]
            found += [False] if answer.returncode == 1 else []
    return found


def table(paths):
    """(place, checker) to how many changes were made and accepted."""
    counts = collections.Counter()
    for path in paths:
        for certificate in verify.certificates(path):
            assert accepted_by_python(certificate) and accepted_by_rust([certificate]) == [True], path
            is_symbolic = certificate["claim"]["verb"] == "conditions"
            places, others = zip(*changed(certificate), *renamed(certificate), *(turned(certificate) if is_symbolic else ()))
            answers = {"python": map(accepted_by_python, others), "rust": accepted_by_rust(others)}
            for checker, accepted in answers.items():
                for place, one in zip(places, accepted):
                    counts[place, checker, "changed"] += 1
                    counts[place, checker, "accepted"] += one
    return counts


def main(paths):
    counts = table(paths)
    print(f"{'place':44}{'changed':>9}{'python accepts':>16}{'rust accepts':>14}")
    for place in sorted({place for place, *_ in counts}):
        made, *accepted = counts[place, "rust", "changed"], counts[place, "python", "accepted"], counts[place, "rust", "accepted"]
        print(f"{place:44}{made:9}{accepted[0]:16}{accepted[1]:14}")
    return int(any(count and what == "accepted" and place not in FREE for (place, _, what), count in counts.items()))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
