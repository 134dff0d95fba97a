"""What the tests share: places, and cases and runs that several of them look at."""

import functools
import os
import tempfile
from pathlib import Path

import millstand as ms

SOURCE = Path(os.environ["MILLSTAND_SOURCE_DIR"])
CASES = SOURCE / "cases"
PROGRAM = os.environ["MILLSTAND_PROGRAM"]
CACHE = os.environ.get("MILLSTAND_TEST_CACHE", str(Path(tempfile.gettempdir()) / "millstand-python-cache"))


_load = ms.load  # a test of the documents gives readers another one


@functools.lru_cache(maxsize=None)
def lumped_run():
    return ms.load(CASES / "published-1400.toml").run()


def coarse_stand():
    """The demo stand of tests/support/coarse_run.h: quick to condense."""
    case = _load(CASES / "four-high-1400.toml")
    for contact in ("upper", "lower"):
        case[f"contact.{contact}.elements_per_half_width"] = 2
        case[f"contact.{contact}.samples"] = 7
    case["bite.method"] = "slab"
    case["dynamics.output_rate"] = "5 kHz"
    case["bearing.trb.roller_law"] = "iso"
    case["bearing.trb.rings"] = "rigid"
    return case
