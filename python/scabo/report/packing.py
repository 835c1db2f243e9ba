"""Arrays as text in a page: bytes of equal significance together, compressed by zlib, in base64. The page takes them apart again
(report/src/arrays.ts)."""
import base64
import html
import zlib

import numpy as np

KINDS = {"f4": "<f4", "u4": "<u4", "u1": "u1"}
LEVEL = 5  # of zlib: a twentieth larger than its best, in a third of the time


def pack(values, kind):
    """Text of an array of one kind: `f4`, `u4` (as differences of neighbours) or `u1`."""
    values = np.ascontiguousarray(values, dtype=KINDS[kind]).reshape(-1)
    if kind == "u4" and len(values):
        values = np.diff(values, prepend=np.zeros(1, dtype="<u4"))  # modulo 2^32, as the page adds them
    planes = values.view("u1").reshape(-1, values.dtype.itemsize).T  # first bytes of all values, then the second ones
    return base64.b64encode(zlib.compress(planes.tobytes(), LEVEL)).decode()


class Arrays:
    """The arrays of a page by their names."""

    def __init__(self):
        self.texts = {}
        self.size = 0  # bytes in the page

    def add(self, name, values, kind="f4"):
        self.put(name, kind, np.size(values), pack(values, kind))

    def put(self, name, kind, count, text):
        self.texts[name] = (kind, count, text)
        self.size += len(text)

    def elements(self):
        """Elements of the page that a browser does not show. Names are ours; escaped all the same."""
        for name, (kind, count, text) in self.texts.items():
            yield f'<script type="text/plain" id="{html.escape(name)}" data-kind="{kind}" data-count="{count}">{text}</script>\n'
