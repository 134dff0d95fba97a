"""Cases, their errors, and runs: the same answers as the program gives."""

import json
import os
import pickle
import subprocess
import tempfile
import unittest
from pathlib import Path

import millstand as ms
import numpy as np
from support import CASES, PROGRAM, lumped_run


class Cases(unittest.TestCase):
    def test_a_value_is_read_set_and_checked_like_one_of_the_file(self):
        case = ms.new("four-high")
        case["backup_roll.crown"] = "150 um"
        self.assertEqual(case["backup_roll.crown"], "150 um")
        case["backup_roll.crown"] = (0.1, "mm")
        self.assertEqual(case["backup_roll.crown"], "0.1 mm")
        case.check()

    def test_a_key_without_a_value_gives_its_default_or_none(self):
        case = ms.load(CASES / "four-high-1400.toml")
        self.assertEqual(case["backup_roll.bending_model"], "solid")
        self.assertEqual(case["strip.friction"], 0.2)
        self.assertIsNone(case["contact.upper.friction"])

    def test_a_roll_of_a_stack_has_its_own_saddles_and_the_window_its_defaults(self):
        case = ms.load(CASES / "stack-twenty-high.toml")
        self.assertEqual(case["roll.7.saddles.shaft_diameter"], "130 mm")
        case["roll.7.saddles.shaft_diameter"] = "120 mm"
        case["roll.1.shift"] = "20 mm"
        self.assertEqual(case["roll.7.saddles.shaft_diameter"], "120 mm")
        self.assertEqual(case["roll.6.saddles.shaft_diameter"], "130 mm")
        self.assertEqual(case["window.points"], 9)
        case.check()

    def test_an_unknown_key_is_refused_at_once_with_the_nearest_one(self):
        case = ms.load(CASES / "four-high-1400.toml")
        with self.assertRaises(ms.InputError) as caught:
            case["backup_roll.crwn"] = "1 um"
        self.assertIn("did you mean 'crown'", str(caught.exception))
        self.assertEqual(case.sets, [])

    def test_a_value_outside_its_range_is_refused_with_value_and_range(self):
        case = ms.load(CASES / "four-high-1400.toml")
        with self.assertRaises(ms.InputError) as caught:
            case["work_roll.barrel_diameter"] = "14500 mm"
        (problem,) = caught.exception.problems
        self.assertEqual(problem.value, "14500 mm")
        self.assertIn("2500 mm", problem.remedy)
        self.assertEqual(case["work_roll.barrel_diameter"], "420 mm")

    def test_every_error_of_a_file_has_its_place_value_and_remedy(self):
        text = (CASES / "chatter-tandem.toml").read_text()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "wrong.toml"
            path.write_text(text.replace("entry_distance", "entry_distanec", 1))
            with self.assertRaises(ms.InputError) as caught:
                ms.load(path).check()
        problem = caught.exception.problems[0]
        self.assertEqual(problem.place.file, str(path))
        self.assertGreater(problem.place.line, 1)
        self.assertGreaterEqual(problem.place.column, 1)
        self.assertIn("entry_distance", problem.remedy)
        self.assertTrue(str(problem).startswith(f"{path}:{problem.place.line}:{problem.place.column}: "))
        self.assertEqual(pickle.loads(pickle.dumps(caught.exception)).problems, caught.exception.problems)

    def test_what_is_missing_or_no_case_is_an_error_and_no_end_of_the_process(self):
        with self.assertRaises(ms.InputError):
            ms.load("no-such-file.toml")
        with self.assertRaises(ms.InputError):
            ms.new("five-high")
        case = ms.load(CASES / "four-high-1400.toml")
        for wrong in (None, object(), 3 + 4j):
            with self.assertRaises(TypeError):
                case["backup_roll.crown"] = wrong
        with self.assertRaises(ms.InputError):
            case["backup_roll.crown"] = float("nan")

    def test_a_copy_and_a_pickle_keep_what_was_set(self):
        case = ms.load(CASES / "published-1400.toml")
        case["dynamics.modal_damping"] = "2 %"
        other = case.copy()
        other["dynamics.modal_damping"] = "3 %"
        self.assertEqual(case["dynamics.modal_damping"], "2 %")
        self.assertEqual(pickle.loads(pickle.dumps(case))["dynamics.modal_damping"], "2 %")

    def test_a_text_of_digits_is_a_text_where_the_key_takes_texts(self):
        case = ms.load(CASES / "published-1400.toml")
        for text in ("12", "true", "1979-05-27", "two words"):
            case["title"] = text
            self.assertEqual(case["title"], text)
            self.assertEqual(case.title, text)
        case = ms.load(CASES / "four-high-1400.toml")
        case["strip.friction"] = "0.3"  # a number stays one
        self.assertEqual(case["strip.friction"], 0.3)

    def test_a_relative_path_stays_that_of_the_folder_in_which_it_was_given(self):
        text = (CASES / "published-1400.toml").read_text().replace('"data/', f'"{CASES}/data/')
        lines = [line for line in text.splitlines(keepends=True) if not line.startswith("title")]
        here = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            for name in ("one", "two"):
                (Path(folder) / name).mkdir()
                (Path(folder) / name / "stand.toml").write_text("".join([f'title = "{name}"\n', *lines]))
            try:
                os.chdir(Path(folder) / "one")
                case = ms.load("stand.toml")
                run = case.modes(out="out")
                table = ms.sweep(case, {"dynamics.modal_damping": ["1 %", "2 %"]}, ["f1"], model="quick", out="table")
                os.chdir(Path(folder) / "two")
                case["dynamics.modal_damping"] = "2 %"
                self.assertEqual(case.title, "one")
                self.assertEqual(pickle.loads(pickle.dumps(run)).case.title, "one")
                self.assertTrue(Path(run.report("copy")).samefile(Path(folder) / "two" / "copy" / "report.html"))
                self.assertTrue((Path(table.folder) / "sweep.json").is_file())
            finally:
                os.chdir(here)

    def test_a_value_with_a_comma_is_one_value_of_a_list(self):
        case = ms.load(CASES / "published-1400.toml")
        table = ms.sweep(case, {"title": ["a,b", "c\\d,e", "f]", "g"]}, ["f1"], model="quick")
        self.assertEqual(len(table), 4)
        self.assertEqual(table.failures, [""] * 4)
        with self.assertRaisesRegex(ms.InputError, "1,5 %"):  # a decimal comma is not two values
            ms.sweep(case, {"dynamics.modal_damping": ["1,5 %", "2 %"]}, ["f1"], model="quick")
        with self.assertRaisesRegex(ms.InputError, "too early"):
            ms.sweep(case, {"title": ['a",b', "c"]}, ["f1"], model="quick")

    def test_a_saved_case_runs_to_the_same_results(self):
        case = ms.load(CASES / "published-1400.toml")
        case["dynamics.modal_damping"] = "2 %"
        with tempfile.TemporaryDirectory() as folder:
            case.save(Path(folder) / "saved.toml")
            self.assertEqual(ms.load(Path(folder) / "saved.toml")["dynamics.modal_damping"], "2 %")
            a, b = case.modes(), ms.load(Path(folder) / "saved.toml").modes()
        self.assertEqual([r.value for r in a.values()], [r.value for r in b.values()])


class Runs(unittest.TestCase):
    def test_results_are_those_of_the_program(self):
        run = lumped_run()
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            subprocess.run([PROGRAM, "run", CASES / "published-1400.toml", "-o", out, "--quiet"], check=True)
            stored = json.loads((out / "results.json").read_text())
            header, *rows = (out / "curves" / "modes.csv").read_text().splitlines()
        of_program = {name: result["value"] for name, result in stored["values"].items()}
        self.assertGreater(len(of_program), 20)
        for name, value in of_program.items():
            self.assertEqual(run[name].value, value, name)
        modes = run.curves["modes"]
        self.assertEqual(len(modes), len(rows))
        self.assertEqual(modes[modes.dtype.names[0]][0], float(rows[0].split(",")[0]))

    def test_a_result_has_unit_error_source_checks_and_meaning(self):
        k3 = lumped_run()["K3"]
        self.assertEqual(k3.unit, "N/m")
        self.assertEqual(k3.source, "published")
        self.assertEqual(k3.to("kN/mm") * 1e6, k3.value)
        self.assertIn("kN/mm", str(k3))
        self.assertTrue(k3.meaning)
        self.assertIsInstance(k3.checks, list)
        with self.assertRaises(ms.InputError):
            k3.to("Hz")

    def test_an_unknown_result_or_curve_names_the_nearest(self):
        run = lumped_run()
        with self.assertRaisesRegex(KeyError, "did you mean"):
            run["K33"]
        with self.assertRaisesRegex(KeyError, "no curve"):
            run.curves["nothing of this name"]

    def test_a_curve_is_a_view_without_a_copy_that_outlives_its_run(self):
        run = ms.load(CASES / "published-1400.toml").modes()
        a, b = run.curves["modes"], run.curves["modes"]
        self.assertTrue(np.shares_memory(a, b))
        self.assertFalse(a.flags.owndata)
        self.assertFalse(a.flags.writeable)
        values = a.copy()
        self.assertEqual(set(run.curves.units("modes")), set(a.dtype.names))
        del run, b
        np.testing.assert_array_equal(a, values)

    def test_warnings_have_parts_and_the_same_words(self):
        run = lumped_run()
        self.assertEqual([str(warning) for warning in run.warning_records], run.warnings)
        rate = next(warning for warning in run.warning_records if warning.id == "output-rate")
        self.assertEqual(rate.key, "dynamics.output_rate")
        self.assertEqual(rate.remedy, "74 kHz would show them")
        self.assertEqual(pickle.loads(pickle.dumps(run)).warning_records, run.warning_records)

    def test_a_run_pickles_with_results_and_curves(self):
        run = lumped_run()
        other = pickle.loads(pickle.dumps(run))
        self.assertEqual(list(other), list(run))
        self.assertEqual(str(other["K3"]), str(run["K3"]))
        self.assertEqual(other.verdict, run.verdict)
        np.testing.assert_array_equal(other.curves["modes"], run.curves["modes"])
        with self.assertRaisesRegex(ms.InputError, "pickle"):
            other.report("nowhere")

    def test_the_page_is_published_by_the_rules_of_the_program(self):
        run = lumped_run()
        with tempfile.TemporaryDirectory() as folder:
            page = Path(run.report(Path(folder) / "out"))
            self.assertIn("<html", page.read_text()[:200])
            self.assertTrue((Path(folder) / "out" / "results.json").exists())
            (Path(folder) / "mine").mkdir()
            (Path(folder) / "mine" / "letter.txt").write_text("kept")
            with self.assertRaises(ms.InputError):
                run.report(Path(folder) / "mine")

    def test_a_report_into_the_folder_of_the_run_is_there_and_one_inside_of_it_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            run = ms.load(CASES / "published-1400.toml").modes(out=out)
            (out / "letter.txt").write_text("of somebody else")
            files = sorted(out.rglob("*"))
            self.assertTrue(Path(run.report(run.folder)).is_file())
            with self.assertRaisesRegex(ms.InputError, "inside of the folder of the run"):
                run.report(out / "curves" / "copy")
            self.assertEqual(sorted(out.rglob("*")), files)
            run.report(Path(folder) / "copy")
            self.assertFalse((Path(folder) / "copy" / "letter.txt").exists())
            self.assertEqual((Path(folder) / "copy" / "results.json").read_text(), (out / "results.json").read_text())

    def test_progress_is_called_and_its_exception_ends_the_run(self):
        seen = []
        ms.load(CASES / "published-1400.toml").run(progress=lambda stage, share: seen.append((stage, share)))
        self.assertTrue(all(0 <= share <= 1 for _, share in seen))

        def refuse(stage, share):
            raise RuntimeError("enough")

        if seen:
            with self.assertRaisesRegex(RuntimeError, "enough"):
                ms.load(CASES / "published-1400.toml").run(progress=refuse)


if __name__ == "__main__":
    unittest.main()
