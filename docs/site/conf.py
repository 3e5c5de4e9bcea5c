# SPDX-License-Identifier: Apache-2.0
# How Sphinx builds the pages that make_pages.py writes. Debian: python3-sphinx python3-myst-parser furo.
project = "msq"
author = "the msq authors"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
html_theme = "furo"
html_title = "msq"
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
language = "en"
highlight_language = "text"
pygments_style = "friendly"
