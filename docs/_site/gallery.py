"""A card for every entry of the library: its picture by `looproot view --svg`, its kind, its counts and its source."""

from __future__ import annotations

import html
import json
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

# One picture ends within seconds.
SECONDS = 120
# What is no mechanism with bodies in space has an answer, but no figure.
WITHOUT_FIGURE = {"conditions", "displacement", "gearing", "lines", "motion", "synthesis"}


def entries(app: Sphinx) -> list[dict[str, Any]]:
    """The library, read once for all pages."""
    if not hasattr(app, "looproot_entries"):
        done = subprocess.run([app.config.looproot, "list", "--json"], capture_output=True, text=True, check=True)
        app.looproot_entries = json.loads(done.stdout)
    return app.looproot_entries


class Gallery(SphinxDirective):
    """The entries of one folder of the library."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        folder = self.arguments[0]
        found = [entry for entry in entries(self.env.app) if entry["name"].startswith(folder + "/")]
        if not found:
            raise ExtensionError(f"{self.env.docname}: found no entry of the library in {folder}, expected one at least")
        pictures: list[str | None] = [None] * len(found)
        if folder not in WITHOUT_FIGURE and self.config.gallery_pictures:
            with ThreadPoolExecutor(os.cpu_count()) as pool:
                pictures = list(pool.map(self.picture, (entry["name"] for entry in found)))
        cards = "".join(self.card(entry, picture) for entry, picture in zip(found, pictures, strict=True))
        missing = sum(picture is None for picture in pictures)
        self.config.gallery_log.append((folder, len(found), len(found) - missing))
        return [nodes.raw("", f'<div class="gallery">{cards}</div>', format="html")]

    def relative(self, path: str) -> str:
        return os.path.relpath(path, Path(self.env.docname).parent)

    def picture(self, name: str) -> str | None:
        """The picture's place in the site, or nothing where `view` has none."""
        place = Path("gallery") / (name.replace("/", "-") + ".svg")
        target = Path(self.env.app.outdir) / place
        target.parent.mkdir(parents=True, exist_ok=True)
        command = [self.config.looproot, "view", name, "--svg", "--real", "--threads", "1", "-o", str(target)]
        if name.startswith("framework/"):
            command.remove("--real")
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            raise ExtensionError(f"found no picture of {name}, expected one within {SECONDS} s") from None
        if done.returncode not in (0, 2, 3) or not target.is_file():
            return None
        return self.relative(str(place))

    def card(self, entry: dict[str, Any], picture: str | None) -> str:
        name = entry["name"]
        text = html.escape
        figure = ""
        if picture:
            figure = f'<a class="figure" href="{picture}"><img src="{picture}" loading="lazy" alt="{text(entry["title"])}"></a>'
        expected = entry.get("expected", {})
        facts = [str(entry.get("type", ""))]
        facts += [f"{', '.join(map(str, expected[key]))} {key}" for key in ("complex", "real") if expected.get(key)]
        source = entry.get("source", {})
        file = self.relative(f"_files/{name}.toml")
        return (
            f'<div class="card" id="{name.replace("/", "-")}">{figure}<div class="text"><code>{text(name)}</code>'
            f'<span class="title">{text(entry["title"])}</span>'
            f'<span class="facts">{text("; ".join(filter(None, facts)))}<br>'
            f'{text(source.get("key", ""))} · <a href="{file}">file</a></span></div></div>'
        )


def copy(app: Sphinx, error: Exception | None) -> None:
    """The files that the cards link to."""
    if error is not None:
        return
    for entry in entries(app):
        source = Path(app.srcdir) / "equations" / (entry["name"] + ".toml")
        target = Path(app.outdir) / "_files" / (entry["name"] + ".toml")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(source.read_bytes())
    for folder, count, drawn in app.config.gallery_log:
        print(f"gallery of {folder}: {count} entries, {drawn} pictures")


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_config_value("gallery_log", [], "", list)
    app.add_config_value("gallery_pictures", True, "", bool)
    app.add_directive("gallery", Gallery)
    app.connect("build-finished", copy)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
