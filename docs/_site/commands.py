"""Runs the commands of pages whose blocks are no directives: those that people read on a code host, too.

Every line of a block of text or shell that begins with `looproot` is run in a folder with the files that pages name. It must end with one
of the exit codes of an answer, and where a page shows what is printed, the first line must still be that, times apart. Every other line of a
block of shell must be one that a check runs elsewhere, or be left out for a reason that stands here.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PAGES = ["README.md", "equations/README.md", "python/README.md", "c/README.md", "CONTRIBUTING.md"]
# The build itself runs the blocks that are directives, such as those of tutorials and how-tos.
FOLDERS = ["docs"]
SECONDS = 300
# The answers of a verdict. A command that shows a mistake stands in MISTAKES.
ANSWERS = {0, 2, 3}

# Counts that take minutes on a page, and what the check takes in their place.
SMALLER = {
    "--count 20000": "--count 20",
    "--count 5000": "--count 3",
    "--set all --count 100": "--set all --count 1",
    "bench accuracy --set loops --exact": "bench accuracy --set loops --exact --count 1",
    "bench accuracy --set special-loops --exact": "bench accuracy --set special-loops --exact --count 1",
    "bench accuracy --json": "bench accuracy --count 10 --json",
    "--repeats 51": "--repeats 3 --count 2",
    "--count 60 --repeats 15": "--count 2 --repeats 3",
    "--columns 200": "--columns 20",
}
# With `bench speed` alone, whose counts are made for figures.
SPEED = "--count 1 --repeats 1"
# What the check leaves out, and why.
LEFT_OUT = {
    "eaik": "needs another solver",
    "--live": "needs web/build; .ci/web tests it",
    "PATH...": "stands for paths",
    "--atlas": "derives the whole library, which takes minutes",
    "conditions 6R": "searches for minutes",
    "bench speed --set robots": "times a hundred robots: minutes without optimisation",
    "bench speed --set special-loops": "minutes without optimisation",
}
# Lines of shell that build, install or test, by their first words, with the check that runs the same.
ELSEWHERE = {
    "apt-get install -y m4 make gcc": ".ci/run",
    ".ci/run": ".ci/run",
    "pip wheel ./python --no-deps -w dist": ".ci/wheel",
    'pip install "pytest>=8"': ".ci/python",
    "pip install dask distributed": ".ci/python",
    "python python/examples/workspace.py": ".ci/python",
    "cargo build --release -p looproot-c": ".ci/c",
    "cmake -S c -B target/c": ".ci/c",
    "target/c/every_posture": ".ci/c",
    "web/build": ".ci/module",
    "cd assets/viewer && npm ci": ".ci/view",
}
NOT_RUN = {
    "cargo install --path crates/cli": "compiles everything a second time, in one more profile",
    "cargo build --release": "the same",
    "python3 -m venv venv && venv/bin/pip install python-flint symbolica": "needs other systems for algebra",
    "venv/bin/python benches/algebra/compare.py": "the same",
    "python benches/peers/answers_eaik.py": "needs another solver",
}
# Pages show what a mistake is answered with.
MISTAKES = {
    'looproot poly expand "x + 2y"',
    'looproot poly expand "alpha + bta" --vars alpha,beta',
    'looproot poly expand "(x + 1"',
    'looproot poly expand "x^2/(x - x)"',
    'looproot poly expand "(a + b + c + d + 1)^1000"',
}
FILES = {
    "poses.csv": "x,y,z,qw,qx,qy,qz\n0.4,0.1,0.3,0,1,0,0\n0.4,0.15,0.3,0,1,0,0\n",
    "path.csv": "x,y,z,roll_deg,pitch_deg,yaw_deg\n0.4,0.1,0.4,180,0,0\n0.4,0.15,0.4,180,0,0\n0.4,0.2,0.4,180,0,0\n",
    "loop.toml": (ROOT / "equations/overconstrained/bennett_a.toml").read_text(),
    "arm.toml": (ROOT / "equations/arm/general_08real.toml").read_text(),
}


@dataclass
class Command:
    page: str
    line: int
    text: str
    shown: str | None
    """The first line that the page shows as its output."""


def commands(page: str) -> list[Command]:
    found: list[Command] = []
    block: str | None = None
    lines = (ROOT / page).read_text().split("\n")
    for number, line in enumerate(lines, 1):
        if fence := re.match(r"\s*```(\S*)", line):
            block = None if block is not None else fence[1]
        elif block in ("", "sh", "text", "console") and (match := re.match(r"\s*(\$ )?(looproot [a-z].*)", line)):
            prompt, text = match.groups()
            text = re.sub(r"\s{2,}#? ?[^|;\"]*$" if not prompt else r"^$", "", text)
            after = lines[number] if prompt else None
            found.append(Command(page, number, text.strip(), after))
    return found


def files(page: str) -> dict[str, str]:
    """The files that a page shows: the first line of such a block is a comment with the name alone."""
    return dict(re.findall(r"^```toml\n# (\w+\.toml)\n(.*?)^```", (ROOT / page).read_text(), re.M | re.S))


def others(page: str) -> list[str]:
    """Lines of shell that no check is known to run."""
    faults = []
    block: str | None = None
    for number, line in enumerate((ROOT / page).read_text().split("\n"), 1):
        if fence := re.match(r"\s*```(\S*)", line):
            block = None if block is not None else fence[1]
        elif block in ("sh", "console") and line.strip():
            text = line.strip().removeprefix("$ ")
            known = [*ELSEWHERE, *NOT_RUN, "looproot "]
            if block == "sh" or line.lstrip().startswith("$ "):
                if not any(text.startswith(first) for first in known):
                    faults.append(f"{page}:{number}: found `{text}`, expected a line that a check runs")
    return faults


def plain(line: str) -> str:
    """A line without times, which differ from run to run, and without what depends on them."""
    return re.sub(r"\d[\d.]* (us|ms|s|min)\b", "0 s", line).rstrip(" …")


def run(command: Command, place: Path, program: str) -> tuple[float, str | None]:
    """How long it took, and the fault."""
    text = command.text
    for long, short in SMALLER.items():
        text = text.replace(long, short)
    if text.startswith("looproot bench speed") and "--count" not in text:
        text += " " + SPEED
    environment = {**os.environ, "PATH": f"{Path(program).parent}{os.pathsep}{os.environ['PATH']}", "NO_COLOR": "1"}
    began = time.monotonic()
    try:
        ended = subprocess.run(
            ["bash", "-c", text], cwd=place, env=environment, capture_output=True, text=True, timeout=SECONDS
        )
    except subprocess.TimeoutExpired:
        return SECONDS, f"found no end of `{text}` within {SECONDS} s"
    took = time.monotonic() - began
    expected = {1} if command.text in MISTAKES else ANSWERS
    if ended.returncode not in expected:
        return took, f"found exit code {ended.returncode} of `{text}`, expected one of {sorted(expected)}:\n{ended.stderr}"
    printed = ended.stdout + ended.stderr
    if command.shown is not None and text == command.text:
        first = printed.split("\n")[0]
        if plain(command.shown) != plain(first):
            return took, f"found the first line\n  {first}\nof `{text}`, expected that of the page:\n  {command.shown}"
    return took, None


def main() -> int:
    program = os.environ["LOOPROOT"]
    place = ROOT / "target" / "docs" / "commands"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    (place / "equations").symlink_to(ROOT / "equations")
    shutil.copy(ROOT / "web" / "robot.urdf", place)
    for name, text in FILES.items():
        (place / name).write_text(text)
    pages = PAGES + [str(path.relative_to(ROOT)) for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.md"))]
    for page in pages:
        for name, text in files(page).items():
            (place / name).write_text(text)
    found = [command for page in pages for command in commands(page)]
    chosen = [command for command in found if not any(word in command.text for word in LEFT_OUT)]
    # Commands of one page follow each other: one may read what another has written.
    by_page: dict[str, list[Command]] = {}
    for command in chosen:
        by_page.setdefault(command.page, []).append(command)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        done = pool.map(lambda page: [(command, *run(command, place, program)) for command in by_page[page]], by_page)
    results = [result for page in done for result in page]
    faults = [f"{command.page}:{command.line}: {fault}" for command, _, fault in results if fault]
    faults += [fault for page in pages for fault in others(page)]
    faults += [f"found no {check}, expected the check that runs `{line}`" for line, check in ELSEWHERE.items() if not (ROOT / check).is_file()]
    slowest = sorted(results, key=lambda result: -result[1])[:5]
    print(f"{len(results)} commands of {len(by_page)} pages run, {len(found) - len(chosen)} left out; the slowest:")
    for command, took, _ in slowest:
        print(f"  {took:5.1f} s  {command.page}:{command.line}: {command.text}")
    print("\n".join(faults))
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
