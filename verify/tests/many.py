"""Draws random mechanisms, solves them with certificates, and counts what both checkers say of these, with their files.

usage: LOOPROOT=target/release/looproot verify/tests/many.py --arms 10000 --loops 1000 --platforms 300 --linkages 1000 --sets 10
                                                             [--python 20] [--seed 1] [--keep FOLDER]

The options say how many problems of each kind are drawn, and how many of every set of `looproot bench accuracy`. The checker in Python takes the first
certificate of each kind and every 20th behind it. A certificate that a checker refuses, or does not decide in two minutes, is kept with its file, and makes the exit code 1.
"""
import argparse
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from draws import Draw, of_problem

LOOPROOT = os.environ["LOOPROOT"]
VERIFY = os.environ.get("VERIFY", str(pathlib.Path(__file__).resolve().parents[1] / "verify.py"))
KINDS = {"arms": "arm", "loops": "loop", "platforms": "platform", "linkages": "linkage"}
SETS = ("general structured near-singular badly-scaled calibrated loops special-loops platform platform-planar-base platform-planar-plate "
        "platform-planar-both platform-near-planar platform-hexapod platform-6-5 platform-6-4 platform-6-4-triple platform-6-3 platform-6-3-triple "
        "platform-5-5-a platform-5-5-b platform-5-4-a platform-5-4-b platform-5-3 platform-4-4-a platform-4-4-b platform-4-4-c platform-3-3 "
        "platform-affine platform-similar platform-congruent platform-similar-planar").split()
SECONDS = 120  # of one command


def run(*command):
    """The exit code and all that was printed; no exit code where two minutes are not enough."""
    try:
        answer = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=SECONDS)
        return answer.returncode, answer.stdout + answer.stderr
    except subprocess.TimeoutExpired:
        return None, "no answer in two minutes"


def problems(options, folder):
    """(name of the kind or set, mechanism) of every problem."""
    for kind, method in KINDS.items():
        draw = Draw(f"{kind} {options.seed}")
        for _ in range(getattr(options, kind)):
            yield kind, getattr(draw, method)()
    for name in SETS if options.sets else ():
        path = folder / "problems"
        code, text = run(LOOPROOT, "bench", "accuracy", "--set", name, "--count", options.sets, "--seed", options.seed, "--export", path)
        if code != 0:
            sys.exit(f"error: {name}: {text}")
        for line in filter(None, path.read_text().splitlines()[1:]):
            yield name, of_problem(json.loads(line))


def checked(options, folder, kind, mechanism, counts):
    """What the checkers refuse of one problem, which is counted."""
    file, certificate = folder / "mechanism.json", folder / "certificate"
    certificate.unlink(missing_ok=True)
    file.write_text(json.dumps(mechanism))
    code, text = run(LOOPROOT, "solve", file, "-q", "--certificate", certificate)
    counts[kind, "problems"] += 1
    if not certificate.exists():
        lines = [line for line in text.splitlines() if line.startswith(("note: no certificate", "error: "))]
        reason = re.sub(r"note: no certificate[^:]*: ", "", lines[0]) if lines else text.strip() or f"exit code {code}"
        counts[kind, "no certificate: " + reason.replace(str(file), "FILE").splitlines()[0][:110]] += 1
        return []
    counts[kind, "certificates"] += 1
    checkers = {"rust": [LOOPROOT, "verify"]}
    if (counts[kind, "certificates"] - 1) % options.python == 0:
        checkers["python"] = [sys.executable, VERIFY]
    refused = []
    for checker, command in checkers.items():
        code, text = run(*command, certificate, "--file", file)
        counts[kind, f"accepted by {checker}" if code == 0 else f"REFUSED by {checker}"] += 1
        refused += [(checker, text.strip())] if code != 0 else []
    return refused


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in (*KINDS, "sets"):
        parser.add_argument(f"--{name}", type=int, default=0)
    parser.add_argument("--python", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("refused"))
    options, counts, refusals = parser.parse_args(), collections.Counter(), 0
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        for number, (kind, mechanism) in enumerate(problems(options, folder), 1):
            for checker, text in checked(options, folder, kind, mechanism, counts):
                own = options.keep / f"{kind}-{number}-{checker}"
                own.mkdir(parents=True, exist_ok=True)
                for name in "mechanism.json", "certificate":
                    shutil.copy(folder / name, own)
                print(f"{own}: {text}", flush=True)
                refusals += 1
    for (kind, what), count in sorted(counts.items()):
        print(f"{kind:24}{count:7}  {what}")
    return int(refusals > 0)


if __name__ == "__main__":
    sys.exit(main())
