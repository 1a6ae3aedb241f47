"""Sphinx: the pages of mixedlub, built without network. `make docs` runs it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

from mixedlub.running.version import installed_version

project = "mixedlub"
author = "The mixedlub authors"
copyright = "the mixedlub authors, MIT licence"
release = version = installed_version()

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "short_signatures",
    "run_blocks",
    "svg_equations",
    "generated",
    "no_network",
]
exclude_patterns = ["extensions", "made"]
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath", "substitution"]
myst_heading_anchors = 3
default_role = "code"

autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
toc_object_entries_show_parents = "hide"
nitpicky = True
nitpick_ignore = [("py:func", "extreme_limit"), ("py:func", "roughness.filters.gaussian_mean_line")]
"""Functions that docstrings name and that no page lists."""

html_theme = "furo"
html_title = f"mixedlub {version}"
html_math_renderer = "svg"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
