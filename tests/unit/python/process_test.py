"""The module as part of a process: start, threads, Ctrl-C, memory, stubs."""

import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import millstand as ms
import numpy as np
from support import CACHE, CASES, coarse_stand


def resident_memory():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


class Process(unittest.TestCase):
    def test_it_imports_numpy_alone_and_no_finite_elements(self):
        text = ("import sys, millstand; loaded = open('/proc/self/maps').read(); "
                "print('matplotlib' in sys.modules, 'libdeal' in loaded, 'libgmsh' in loaded)")
        out = subprocess.run([sys.executable, "-c", text], check=True, capture_output=True, text=True).stdout
        self.assertEqual(out.split(), ["False", "False", "False"])

    def test_two_runs_in_two_threads_give_what_one_gives(self):
        alone = coarse_stand().stiffness(cache=CACHE)
        runs, here = [None, None], os.getcwd()

        def work(i):
            runs[i] = coarse_stand().stiffness(cache=CACHE)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for run in runs:
            self.assertEqual({r.name: r.value for r in run.values()}, {r.name: r.value for r in alone.values()})
            np.testing.assert_array_equal(run.curves["contact-upper"], alone.curves["contact-upper"])
        self.assertEqual(os.getcwd(), here)

    def test_other_threads_work_while_a_run_does(self):
        counted = []
        ended = threading.Event()

        def count():
            while not ended.wait(0.005):
                counted.append(time.perf_counter())

        thread = threading.Thread(target=count)
        thread.start()
        start = time.perf_counter()
        coarse_stand().stiffness(cache=CACHE)
        seconds = time.perf_counter() - start
        ended.set()
        thread.join()
        self.assertGreater(len(counted), 0.3 * seconds / 0.005)

    def test_ctrl_c_ends_a_run_within_a_second_and_the_next_one_works(self):
        begun = []

        def interrupt(stage, share):
            if not begun:
                begun.append(time.perf_counter())
                os.kill(os.getpid(), signal.SIGINT)

        case = coarse_stand()
        with self.assertRaises(KeyboardInterrupt):
            case.run(progress=interrupt, fresh=True, cache=CACHE + "-interrupted")
        self.assertLess(time.perf_counter() - begun[0], 1.0)
        self.assertIn("f1", ms.load(CASES / "published-1400.toml").modes())

    def test_verbs_that_leave_a_folder_show_how_far_they_are(self):
        case = ms.load(CASES / "published-1400.toml")
        vary = {"given.K1": "normal(1 %)"}
        with tempfile.TemporaryDirectory() as folder:
            record = Path(folder) / "noise.csv"
            noise = np.random.default_rng(1).standard_normal(4000)
            record.write_text("time [s],a1 [g]\n" + "".join(f"{i / 2000},{a}\n" for i, a in enumerate(noise)))
            verbs = {
                "sweep": lambda p: ms.sweep(case, {"given.K1": ["6 MN/mm", "7 MN/mm"]}, ["f1"], model="quick", progress=p),
                "study": lambda p: ms.study(case, vary, ["f1"], samples=8, model="quick", run=False, progress=p),
                "study run": lambda p: ms.study(case, vary, ["f1"], samples=8, model="quick").run(progress=p),
                "analyse": lambda p: ms.record(record).analyse(progress=p),
            }
            for name, verb in verbs.items():
                shown = []
                verb(lambda stage, fraction: shown.append((stage, fraction)))
                fractions = [fraction for stage, fraction in shown]
                if name in ("sweep", "analyse"):
                    self.assertGreater(len(shown), 0, name)
                self.assertEqual(fractions, sorted(fractions), name)
                self.assertTrue(all(0 <= fraction <= 1 and stage for stage, fraction in shown), name)

    def test_what_the_command_line_checks_is_checked_here(self):
        case, vary = ms.load(CASES / "published-1400.toml"), {"given.K1": "normal(1 %)"}
        for wrong, words in (
            ({"method": "morris"}, "method 'morris' is not known; there are grid"),
            ({"model": "fast"}, "model 'fast' is not known; there are quick, full"),
            ({"engine": "condor"}, "engine 'condor' is not known"),
            ({"samples": 10**30}, "a whole number is needed"),
            ({"jobs": -1}, "a number that is not negative is needed"),
        ):
            with self.assertRaisesRegex(ms.InputError, words):
                ms.study(case, vary, ["f1"], **{"samples": 4, "model": "quick", **wrong})
        with self.assertRaisesRegex(ms.InputError, "sweep needs a key"):
            ms.sweep(case, {}, ["f1"], model="quick")
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "bytes.toml").write_bytes(b'schema = 1\nkind = "\xff"\n')
            with self.assertRaisesRegex(ms.InputError, "bytes.toml:2:"):
                ms.load(Path(folder) / "bytes.toml").check()

    def test_an_exception_of_progress_ends_the_verb_and_ctrl_c_works_afterwards(self):
        class Enough(Exception):
            pass

        def raise_it(stage, fraction):
            raise Enough

        case = ms.load(CASES / "published-1400.toml")
        with self.assertRaises(Enough):
            ms.study(case, {"given.K1": "normal(1 %)"}, ["f1"], samples=2000, model="quick", progress=raise_it)
        with self.assertRaises(KeyboardInterrupt):  # the handler of the interpreter is still there
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(1)

    def test_memory_stays_after_many_cases_and_errors(self):
        def one(i):
            case = ms.load(CASES / "published-1400.toml")
            case["dynamics.modal_damping"] = f"{1 + i % 7} %"
            try:
                case["dynamics.modal_damping"] = "400 %"
            except ms.InputError:
                pass
            run = case.modes()
            return run["K3"].value + run.curves["modes"][0][0]

        for i in range(12):
            one(i)
        before = resident_memory()
        for i in range(int(os.environ.get("MILLSTAND_CASES", "24"))):  # the long form takes a thousand
            one(i)
        self.assertLess(resident_memory() - before, 4e6)  # byte; one leaked run is 1e5

    def test_the_stubs_agree_with_the_module(self):
        here = Path(__file__).parent
        done = subprocess.run(
            ["/usr/bin/stubtest", "millstand", "--ignore-missing-stub", "--allowlist", here / "stubtest.allow",
             "--mypy-config-file", here / "stubtest.ini"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
