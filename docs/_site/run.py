"""Blocks of a page that are run while it is built: commands, Python, files, and what they draw.

Every page has a folder of its own, in which its blocks run one after the other. A block that ends with another exit code than the one it
states fails the build.
"""

from __future__ import annotations

import contextlib
import io
import os
import shutil
import subprocess
import sys
import time
import traceback
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.parsers.rst import directives
from pygments.lexer import RegexLexer, bygroups
from pygments.token import Generic, Text
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective

# A command of a page ends within seconds; one that does not is at fault, and the build should say which.
SECONDS = 120


class Transcript(RegexLexer):
    """Commands behind a prompt, all else is what they print."""

    name = "transcript"
    tokens = {"root": [(r"^([$>] )(.*\n)", bygroups(Generic.Prompt, Text)), (r".*\n", Generic.Output)]}


class Runs(SphinxDirective):
    """What all blocks share: the folder of the page, and how a fault is told."""

    has_content = True

    @property
    def folder(self) -> Path:
        folder = Path(self.config.run_folder) / self.env.docname
        if self.env.temp_data.get("run_folder") != str(folder):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            # Commands that read the library's files find them as in the folder of the checkout.
            (folder / "equations").symlink_to(Path(self.env.srcdir) / "equations")
            self.env.temp_data["run_folder"] = str(folder)
        return folder

    def fault(self, text: str) -> None:
        """Told as a warning, which ends the build when every page has been read."""
        logging.getLogger(__name__).warning("%s", text, location=(self.env.docname, self.lineno))

    def published(self, path: Path) -> str:
        """The link to a copy of a file in the site."""
        place = Path("pages") / self.env.docname.replace("/", "-") / path.name
        target = Path(self.env.app.outdir) / place
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)
        return os.path.relpath(place, Path(self.env.docname).parent)

    def block(self, text: str, language: str) -> nodes.literal_block:
        node = nodes.literal_block(text, text, language=language)
        self.set_source_info(node)
        return node


def exits(argument: str) -> list[int]:
    return [directives.nonnegative_int(word) for word in argument.split()]


class Run(Runs):
    """Commands, one a line, each followed by what it prints."""

    option_spec = {
        # The exit code of every command, or one for each of them.
        "exit": exits,
        # As many lines of every output are shown.
        "lines": directives.positive_int,
        # From the first line on that contains this text.
        "from": directives.unchanged,
        "quiet": directives.flag,
    }

    def run(self) -> list[nodes.Node]:
        shown: list[str] = []
        lines = "\n".join(self.content).replace("\\\n", "\\\0").split("\n")
        commands = [line.replace("\\\0", "\\\n") for line in lines if line.strip()]
        expected = self.options.get("exit", [0])
        if len(expected) == 1:
            expected = expected * len(commands)
        if len(expected) != len(commands):
            self.fault(f"found {len(expected)} exit codes of {len(commands)} commands, expected one or as many")
            return []
        for command, code in zip(commands, expected):
            shown.append("$ " + command.replace("\n", "\n> "))
            output = self.output(command, code)
            if "quiet" not in self.options:
                shown.extend(output)
        return [self.block("\n".join(shown), "transcript")]

    def output(self, command: str, expected: int) -> list[str]:
        place = Path(self.config.looproot)
        environment = {
            **os.environ,
            "PATH": os.pathsep.join([str(place.parent), str(Path(sys.executable).parent), os.environ["PATH"]]),
            "NO_COLOR": "1",
            "COLUMNS": "100",
        }
        began = time.monotonic()
        try:
            ended = subprocess.run(
                ["bash", "-c", command],
                cwd=self.folder,
                env=environment,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                timeout=SECONDS,
                text=True,
            )
        except subprocess.TimeoutExpired:
            self.fault(f"found no end of `{command}`, expected one within {SECONDS} s")
            return []
        self.config.run_log.append((time.monotonic() - began, self.env.docname, command))
        if ended.returncode != expected:
            self.fault(f"found exit code {ended.returncode} of `{command}`, expected {expected}:\n{ended.stdout}")
        lines = ended.stdout.rstrip("\n").split("\n") if ended.stdout else []
        if text := self.options.get("from"):
            first = next((index for index, line in enumerate(lines) if text in line), None)
            if first is None:
                self.fault(f"found no line with {text!r} in the output of `{command}`:\n{ended.stdout}")
                first = 0
            lines = ["…"] * (first > 0) + lines[first:]
        limit = self.options.get("lines", len(lines))
        return lines[:limit] + ["…"] * (len(lines) > limit)


class File(Runs):
    """A file that the commands of the page read, with its name above it."""

    required_arguments = 1
    option_spec = {"folded": directives.flag}

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0]
        text = "\n".join(self.content) + "\n"
        (self.folder / name).write_text(text, encoding="utf-8")
        language = {"toml": "toml", "urdf": "xml", "py": "python", "json": "json"}.get(name.rpartition(".")[2], "text")
        block = self.block(text.rstrip("\n"), language)
        box = nodes.container("", literal_block=True, classes=["literal-block-wrapper"])
        link = self.published(self.folder / name)
        box += nodes.caption(name, "", nodes.literal(name, name), nodes.Text(" "), nodes.reference("", "download", refuri=link))
        box += block
        if "folded" not in self.options:
            return [box]
        summary = f"<details><summary><code>{name}</code>: show the file</summary>"
        return [nodes.raw("", summary, format="html"), box, nodes.raw("", "</details>", format="html")]


class Python(Runs):
    """Python, and what it prints. The blocks of a page share their names."""

    def run(self) -> list[nodes.Node]:
        code = "\n".join(self.content)
        names: dict[str, Any] = self.env.temp_data.setdefault("run_names", {"__name__": "page"})
        printed = io.StringIO()
        before = Path.cwd()
        began = time.monotonic()
        try:
            os.chdir(self.folder)
            with contextlib.redirect_stdout(printed):
                exec(compile(code, f"{self.env.docname}:{self.lineno}", "exec"), names)
        except Exception:
            self.fault(traceback.format_exc())
        finally:
            os.chdir(before)
        self.config.run_log.append((time.monotonic() - began, self.env.docname, "python"))
        found: list[nodes.Node] = [self.block(code, "python")]
        if text := printed.getvalue().rstrip("\n"):
            found.append(self.block(text, "text"))
        return found


class Made(Runs):
    """A picture or a page that a block before this one has written. The text of the block says what is seen."""

    required_arguments = 1
    option_spec = {"width": directives.unchanged}

    def run(self) -> list[nodes.Node]:
        path = self.folder / self.arguments[0]
        if not path.is_file():
            self.fault(f"found no file {self.arguments[0]}, expected one that a block before this one has written")
            return []
        text = " ".join(self.content)
        if path.suffix == ".html":
            return [self.page(path, text)]
        image = nodes.image(uri="/" + os.path.relpath(path, self.env.srcdir), alt=text, width=self.options.get("width", "100%"))
        figure = nodes.figure("", image, classes=["made"])
        self.set_source_info(figure)
        if text:
            found, _ = self.state.inline_text(text, self.lineno)
            figure += nodes.caption(text, "", *found)
        return [figure]

    def page(self, path: Path, text: str) -> nodes.Node:
        link = self.published(path)
        return nodes.raw(
            "",
            f'<figure class="made"><iframe src="{link}" title="{text}" loading="lazy"></iframe>'
            f'<figcaption><p>{text} <a href="{link}">Open the page alone.</a></p></figcaption></figure>',
            format="html",
        )


def report(app: Sphinx, error: Exception | None) -> None:
    """Says which commands took longest, so that a slow page is noticed."""
    log = app.config.run_log
    if error is None and log:
        print(f"{len(log)} blocks run in {sum(seconds for seconds, _, _ in log):.0f} s; the slowest:")
        for seconds, page, command in sorted(log, reverse=True)[:5]:
            print(f"  {seconds:5.1f} s  {page}: {command}")


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_config_value("looproot", None, "", str)
    app.add_config_value("run_folder", None, "", str)
    app.add_config_value("run_log", [], "", list)
    app.add_lexer("transcript", Transcript)
    app.add_directive("run", Run)
    app.add_directive("file", File)
    app.add_directive("python", Python)
    app.add_directive("made", Made)
    app.connect("build-finished", report)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
