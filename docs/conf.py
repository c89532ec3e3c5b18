"""The site of the documentation. Its source folder is that of the repository, so that links lead where they lead on a code host."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs" / "_site"))
# The Python package with its compiled part, put together by docs/build.
sys.path.insert(0, os.environ["LOOPROOT_PYTHON"])

project = "looproot"
author = "the looproot developers"
copyright = "MIT or Apache-2.0"
language = "en"
root_doc = "docs/index"

extensions = ["myst_parser", "sphinx.ext.autodoc", "run", "gallery"]
include_patterns = [
    "docs/*.md",
    "docs/**/*.md",
    "equations/*.md",
    "python/README.md",
    "c/README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "ARCHITECTURE.md",
]
exclude_patterns = ["target", "**/node_modules", "docs/_site"]

myst_enable_extensions = ["deflist", "fieldlist"]
myst_heading_anchors = 4

# The program of this checkout, and the folder in which the blocks of every page run.
looproot = os.environ["LOOPROOT"]
run_folder = str(ROOT / "target" / "docs" / "run")

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
python_use_unqualified_type_names = True

# Links to other sites are looked up by `docs/build --links` only.
linkcheck_timeout = 20
linkcheck_workers = 4

html_theme = "furo"
html_title = "looproot"
html_static_path = ["_site/static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
# Pages are read from a disk, too: nothing is fetched.
html_theme_options = {"sidebar_hide_name": False}
