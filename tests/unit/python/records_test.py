"""Records as Python gives them to the program: what several of them share, and what each has by itself."""

import tempfile
import unittest
from pathlib import Path

import millstand as ms
import numpy as np
from support import CASES

RATE = 4000  # Hz
SECONDS = 6  # the check is the last third, which has to be a second at least


def measured(seed):
    """Force and accelerations of both work rolls of the published stand under a random force."""
    force = 976e3 + 3e3 * np.random.default_rng(seed).standard_normal(SECONDS * RATE)
    case = ms.load(CASES / "published-1400.toml")
    case["dynamics.force_meaning"] = "measured"
    response = case.modes().chain.simulate(force, rate=RATE)
    return [response["time"], response["force"], response["upper work roll"], response["lower work roll"]]


def written(path, names, columns):
    heads = ",".join(f"{name} [{unit}]" for name, unit in zip(names, ("s", "N", "m/s2", "m/s2")))
    np.savetxt(path, np.column_stack(columns), delimiter=",", header=heads, comments="", fmt="%.9g")
    return path


def fitted(records):
    calibration = ms.load(CASES / "published-1400.toml").calibrate(records, free="K1")
    return [(unknown["name"], unknown["shown"]["value"]) for unknown in calibration.content["unknowns"]]


class Records(unittest.TestCase):
    def test_what_the_program_takes_once_for_all_records_may_not_differ(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [Path(folder) / name for name in ("r1.csv", "r2.csv")]
            for path in paths:
                path.write_text("a1\n1\n")
            case = ms.load(CASES / "published-1400.toml")
            for name, values in {
                "rate": ("2 kHz", "4 kHz"),
                "zone": ("Europe/Berlin", "Asia/Tokyo"),
                "units": ({"a1": "g"}, {"a1": "m/s2"}),
                "scales": ({"a1": "50 mV/g"}, None),
                "between": ("smooth", "lines"),
            }.items():
                records = [ms.record(path, **{name: value}) for path, value in zip(paths, values)]
                with self.assertRaisesRegex(ms.InputError, f"one `{name}` for all its records"):
                    case.calibrate(records)

    def test_a_column_of_one_name_is_another_sensor_in_another_record(self):
        one, two = measured(1), measured(2)
        with tempfile.TemporaryDirectory(prefix="millstand-\U0001f600-") as folder:  # beyond the first 65536 characters
            place = Path(folder)
            named = ("time", "force", "upper_work_roll", "lower_work_roll")
            plain = fitted([
                ms.record(written(place / f"n{i}.csv", named, columns), between="lines")
                for i, columns in enumerate((one, two))
            ])
            first = written(place / "c1.csv", ("time", "force", "A", "B"), one)
            second = written(place / "c2.csv", ("time", "force", "B", "A"), two)
            upper_is_a = {"A": "upper_work_roll", "B": "lower_work_roll"}
            upper_is_b = {"B": "upper_work_roll", "A": "lower_work_roll"}
            mapped = fitted([ms.record(first, channels=upper_is_a, between="lines"),
                             ms.record(second, channels=upper_is_b, between="lines")])
            mistaken = fitted([ms.record(path, channels=upper_is_a, between="lines") for path in (first, second)])
        self.assertGreater(len(plain), 0)
        self.assertEqual(mapped, plain)  # the same samples at the same places
        self.assertNotEqual(mistaken, plain)

    def test_a_name_that_is_not_utf_8_is_refused_with_a_sentence(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "r\udcff.csv"  # the byte 0xff, as Python writes it
            path.write_text("a1\n1\n")
            with self.assertRaisesRegex(ms.InputError, "not UTF-8"):
                ms.load(CASES / "published-1400.toml").calibrate([path])


if __name__ == "__main__":
    unittest.main()
