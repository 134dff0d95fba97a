"""Every Python block of the pages for users runs as it is written, and so do the examples.

Blocks ```python of one page share their names.  Stands have coarse meshes and the cache of the tests, so that a page
takes seconds.
"""

import contextlib
import io
import os
import runpy
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import millstand as ms
from support import CACHE, CASES, SOURCE, coarse_stand


def blocks_of(page):
    blocks, inside = [], None
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if inside is None and line == "```python":
            inside = [number]
        elif inside is not None and line.startswith("```"):
            blocks.append((inside[0], "\n".join(inside[1:])))
            inside = None
        elif inside is not None:
            inside.append(line)
    return blocks


def pages():
    folders = (SOURCE, SOURCE / "docs", SOURCE / "docs" / "howto")
    return [page for folder in folders for page in sorted(folder.glob("*.md")) if blocks_of(page)]


@contextlib.contextmanager
def place_of_a_reader():
    """A folder with the cases of the tree; ms.load() of the demo stand gives it with coarse meshes."""
    load, home, cache = ms.load, os.getcwd(), os.environ.get("XDG_CACHE_HOME")

    def load_coarse(path):
        return coarse_stand() if Path(path).name == "four-high-1400.toml" else load(path)

    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(CASES, Path(folder) / "cases")
        os.chdir(folder)
        os.environ["XDG_CACHE_HOME"] = CACHE
        ms.load = load_coarse
        try:
            yield Path(folder)
        finally:
            ms.load = load
            os.chdir(home)
            os.environ.pop("XDG_CACHE_HOME")
            if cache is not None:
                os.environ["XDG_CACHE_HOME"] = cache


class Documents(unittest.TestCase):
    def test_every_block_runs(self):
        self.assertTrue(pages(), "no page has a block of Python any more")
        for page in pages():
            with self.subTest(page=page.name), place_of_a_reader():
                names = {}
                for number, text in blocks_of(page):
                    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                        exec(compile("\n" * number + text, str(page), "exec"), names)

    def test_every_example_leaves_its_picture(self):
        examples = SOURCE / "docs" / "examples"
        wanted = {
            "crown_study.py": ["cases/four-high-1400.toml"],
            "stand_tolerances.py": ["cases/published-1400.toml", "64"],
            "record_to_model.py": ["cases/published-1400.toml", "20"],
        }
        for name, (case, *more) in wanted.items():
            with self.subTest(example=name), place_of_a_reader() as folder:
                before = sys.argv
                sys.argv = [name, case, str(folder / "picture.png"), *more]
                try:
                    with contextlib.redirect_stdout(io.StringIO()) as said:
                        runpy.run_path(str(examples / name), run_name="__main__")
                finally:
                    sys.argv = before
                self.assertTrue(said.getvalue())
                if name == "record_to_model.py":  # the record was made with a spring that is 12 % softer
                    self.assertRegex(said.getvalue(), r"'K1': '-12\.[01]")
                self.assertEqual((folder / "picture.png").read_bytes()[1:4], b"PNG")


if __name__ == "__main__":
    unittest.main()
