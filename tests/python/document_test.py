"""The code of docs/python.md and README.md runs as it stands, block after block."""
import os
import re
import tempfile
import unittest
from pathlib import Path

import softscope

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.S | re.M)


def blocks(document):
    return BLOCK.findall((ROOT / document).read_text(encoding="utf-8"))


class Documents(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.before = os.getcwd()
        os.chdir(self.folder.name)

    def tearDown(self):
        os.chdir(self.before)
        self.folder.cleanup()

    def run_all(self, code):
        names = {}
        for number, block in enumerate(code, start=1):
            exec(compile(block, f"block {number}", "exec"), names)
        return names

    def test_docs_python(self):
        code = blocks("docs/python.md")
        self.assertGreater(len(code), 3)
        names = self.run_all(code)
        self.assertLess(names["evaluation"].surface.observed.p95_mm, 1)

    def test_readme(self):
        softscope.simulate("clip", {"frames": 3, "pictures": "mp4"}, width_px=240, height_px=180)
        os.chdir("clip")
        names = self.run_all(blocks("README.md"))
        self.assertGreater(len(names["reconstructor"].model()), 1000)


if __name__ == "__main__":
    unittest.main()
