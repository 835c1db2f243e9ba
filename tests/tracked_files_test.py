"""What git tracks is text and small: no file above 1 MB, and no binary but the kinds below. Skipped outside a checkout."""
import pathlib
import shutil
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
LARGEST = 1_000_000  # bytes
# Kinds of binary files that may be tracked, by the end of the name and the first bytes.
KINDS = {".png": b"\x89PNG\r\n\x1a\n", ".hdf5": b"\x89HDF\r\n\x1a\n", ".state": b"scabo_end\n"}
# Inputs that are binary on purpose: files for readers, which must meet them.
INPUTS = ("tests/fuzz/corpus/", "tests/input/bad/")


def complaint(name: str, content: bytes) -> str:
    """Why this file is not to be tracked; empty if it may be."""
    if len(content) > LARGEST:
        return f"{name} has {len(content)} bytes, more than {LARGEST}"
    if b"\0" not in content or name.startswith(INPUTS):
        return ""
    if any(name.endswith(end) and content.startswith(first) for end, first in KINDS.items()):
        return ""
    return f"{name} is a binary file: only pictures (.png), problems (.hdf5) and states (.state) may be"


class TrackedFiles(unittest.TestCase):
    def test_are_small_and_text(self):
        if not (ROOT / ".git").exists() or not shutil.which("git"):
            self.skipTest("not a checkout")
        listed = subprocess.run(["git", "-c", "safe.directory=*", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
        files = [name for name in listed.split("\0") if name and (ROOT / name).is_file()]
        self.assertGreater(len(files), 1000)
        self.assertEqual([sentence for name in files if (sentence := complaint(name, (ROOT / name).read_bytes()))], [])

    def test_a_program_a_large_file_and_a_false_picture_are_refused(self):
        self.assertIn("binary", complaint("program", b"\x7fELF\x02\0\0"))
        self.assertIn("binary", complaint("picture.png", b"\x7fELF\x02\0\0"))
        self.assertIn("bytes", complaint("table.csv", b"1," * LARGEST))
        self.assertEqual(complaint("picture.png", KINDS[".png"] + b"\0\0"), "")
        self.assertEqual(complaint("tests/fuzz/corpus/read_vtu/raw", b"<VTKFile>\0"), "")
        self.assertEqual(complaint("text.md", "Müller\n".encode()), "")


if __name__ == "__main__":
    unittest.main()
