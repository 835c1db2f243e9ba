"""Sphinx's settings for the manual. Pages are staged by build.py, which names the folders in the environment."""
import os
import pathlib
import re

ROOT = pathlib.Path(os.environ["SCABO_ROOT"])
SITE = ROOT / "docs" / "site"

project = "Scabo"
author = "The Scabo developers"
version = release = re.search(r"project\(scabo VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "sphinx.ext.mathjax", "sphinx.ext.autodoc"]

myst_enable_extensions = ["dollarmath", "html_image"]
myst_heading_anchors = 5
myst_dmath_double_inline = True
myst_update_mathjax = False  # it is for version 3; what it would set stands in tex2jax below
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML-full"
mathjax2_config = {"showMathMenu": False, "messageStyle": "none",
                   "tex2jax": {"processClass": "tex2jax_process|mathjax_process|math"}, "CommonHTML": {"linebreaks": {"automatic": True}},
                   "TeX": {"equationNumbers": {"autoNumber": "none"}}}

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True, "show-inheritance": True}
add_module_names = False

nitpicky = True
# Types of other libraries, and names inside of types, have no page here.
nitpick_ignore_regex = [(r"py:.*", r".*")]
suppress_warnings = ["myst.header"]  # pages of GitHub may skip a level of headings

html_theme = "furo"
html_title = f"Scabo {release}"
html_static_path = [str(SITE / "static")]
html_css_files = ["manual.css"]
html_show_sourcelink = False
html_show_copyright = False
html_copy_source = False
highlight_language = "none"
pygments_style = "friendly"
pygments_dark_style = "native"
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1f5f8b", "color-brand-content": "#1f5f8b"},
    "dark_css_variables": {"color-brand-primary": "#7db8e0", "color-brand-content": "#7db8e0"},
    "navigation_with_keys": True,
}


def laid_out(app, what, name, object_, options, lines):
    """Docstrings are plain text: what is laid out in columns or indented stays as it is, bars are bars."""
    paragraphs = [part.split("\n") for part in re.split(r"\n\s*\n", "\n".join(lines))]
    out = []
    for paragraph in paragraphs:
        columns = [line for line in paragraph if re.match(r"^\s{8,}\S|^\S+( \S+)* {2,}\S", line)]
        if paragraph[0].startswith("    "):
            columns = paragraph
        if paragraph[0].startswith(">>>"):
            out += [*paragraph, ""]
        elif 2 * len(columns) >= len(paragraph) and any(line.strip() for line in paragraph):
            out += ["::", "", *("    " + line for line in paragraph), ""]
        else:
            out += [re.sub(r"(?<!`)\|", r"\\|", line) for line in paragraph] + [""]
    lines[:] = out


def setup(app):
    app.connect("autodoc-process-docstring", laid_out)
