"""Links of a built site: each must lead to a file of the site, and to an anchor that it has. Scripts and styles need nothing outside of it."""
from __future__ import annotations

import html.parser
import pathlib
import re
import sys
import urllib.parse
from collections.abc import Iterator


class Page(html.parser.HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.targets: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if name in ("href", "src") and value is not None:
                self.targets.append(value)


def broken_links(site: pathlib.Path) -> Iterator[str]:
    pages = {file: Page(file.read_text(encoding="utf-8")) for file in sorted(site.rglob("*.html")) if "mathjax" not in file.parts}
    for file, page in pages.items():
        for target in sorted(set(page.targets)):
            if re.match(r"(https?|mailto|data):", target):
                if target.startswith("http") and re.search(r"\.(js|css|woff2?)(\?|$)", target):
                    yield f"{file}: needs the network: {target}"
                continue
            path, _, anchor = target.partition("#")
            path = urllib.parse.unquote(path.partition("?")[0])
            place = (file.parent / path).resolve() if path else file
            if place.is_dir():
                place /= "index.html"
            if not place.exists():
                if "mathjax" not in path:  # copied afterwards
                    yield f"{file}: there is no {target}"
            elif anchor and place in pages and urllib.parse.unquote(anchor) not in pages[place].anchors:
                yield f"{file}: {place.name} has no anchor {anchor}"


def needs_of_theme(site: pathlib.Path) -> Iterator[str]:
    """Scripts that import others, which a browser refuses of a page on a disk, and styles with paths from the root."""
    for file in sorted(site.rglob("*.js")):
        if "mathjax" not in file.parts and re.search(r"^import\b", file.read_text(encoding="utf-8", errors="replace"), re.M):
            yield f"{file}: imports another script"
    for file in sorted(site.rglob("*.css")):
        for path in re.findall(r"url\([\"']?(/[^)\"']+)", file.read_text(encoding="utf-8", errors="replace")):
            yield f"{file}: needs {path}"


if __name__ == "__main__":
    site = pathlib.Path(sys.argv[1]).resolve()
    sentences = [*broken_links(site), *needs_of_theme(site)]
    print("\n".join(sentences))
    sys.exit(bool(sentences))
