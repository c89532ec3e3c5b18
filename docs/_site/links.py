"""Follows every link within the site that is built, and every link of pages that are read on a code host, to the place that it names."""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parent.parent.parent
# What `looproot view` has written: these pages hold no links, and their scripts are no text of the site.
ANSWERS = "pages"


class Page(HTMLParser):
    """The links of a page with their lines, and the places in it that a link may name."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[tuple[int, str]] = []
        self.places: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append((self.getpos()[0], value))
            elif (name == "id" or (tag, name) == ("a", "name")) and value:
                self.places.add(value)


def within(site: Path) -> tuple[int, list[str]]:
    """How many links lead from page to page of the site, and the faults."""
    pages = {path: Page(path) for path in sorted(site.rglob("*.html")) if path.relative_to(site).parts[0] != ANSWERS}
    count, faults = 0, []
    for path, page in pages.items():
        for line, link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            place = f"{path.relative_to(site)}:{line}"
            if not target.is_file():
                faults.append(f"{place}: found a link to {link}, expected a file of the site")
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].places:
                faults.append(f"{place}: found a link to {link}, expected a place of that page")
    return count, faults


def without() -> tuple[int, list[str]]:
    """The same of pages that are no part of the site: what they name stands in the repository."""
    count, faults = 0, []
    for path in [ROOT / "README.md", *sorted((ROOT / "assets").rglob("*.md")), *sorted((ROOT / "verify").rglob("*.md"))]:
        for number, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
            for link in re.findall(r"\]\(([^)\s]+)\)", line):
                parts = urlsplit(link)
                if parts.scheme or not parts.path:
                    continue
                count += 1
                if not (path.parent / unquote(parts.path)).exists():
                    faults.append(f"{path.relative_to(ROOT)}:{number}: found a link to {link}, expected a file of the repository")
    return count, faults


def main() -> int:
    site = ROOT / "target" / "docs" / "html"
    (inner, faults), (outer, others) = within(site), without()
    print(f"{inner} links within the site and {outer} of pages beside it followed")
    print("\n".join(faults + others))
    return bool(faults or others)


if __name__ == "__main__":
    sys.exit(main())
