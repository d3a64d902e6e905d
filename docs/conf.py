"""Settings of Sphinx; ``make docs`` builds the site into build/docs."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

from sphinx.application import Sphinx

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_extensions"))

project = "Gazelle"
author = "the authors of Gazelle"
html_title = "Gazelle"
html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["tables.css"]
exclude_patterns = ["_build", "_extensions"]
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "bundled_lists",
    "command_lines",
    "search_terms",
]
search_must_find = ["cmd_vel", "libgazebo_ros_diff_drive", "make_vec", "MoveGroupCommander"]
myst_heading_anchors = 4
# Types of the same name in several packages: their texts stand without a link.
suppress_warnings = ["ref.python"]
toc_object_entries = False
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_inherit_docstrings = False
python_use_unqualified_type_names = True
maximum_signature_line_length = 100


def setup(app: Sphinx) -> dict[str, bool]:
    """Import the public names that packages import on first use, for autodoc to see them."""
    del app
    for page in (HERE / "reference" / "api").glob("*.md"):
        name = page.stem if page.stem == "gazelle" else f"gazelle.{page.stem}"
        module = importlib.import_module(name)
        for each in module.__all__:
            getattr(module, each)
    return {"parallel_read_safe": True}
