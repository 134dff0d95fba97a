"""Parts of a stand: roll pairs, bearings, the chain, chatter.  Each against the run of the program or a closed form."""

import math
import unittest

import millstand as ms
import numpy as np
from support import CACHE, CASES, coarse_stand, lumped_run


class RollPairs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = coarse_stand()
        cls.pair = cls.case.roll_pair("upper", cache=CACHE)

    def test_the_secant_is_that_of_a_run(self):
        case = coarse_stand()
        case["pass.0.load"] = "976 kN"
        run = case.stiffness(cache=CACHE)
        state = self.pair.solve(force="976 kN")
        self.assertAlmostEqual(state.secant.value / run["K3.secant"].value, 1, delta=1e-9)  # the same solved load
        self.assertEqual(state.secant.unit, "N/m")
        # The run takes the slope of a fitted curve, the pair that of the nodes in contact.
        self.assertAlmostEqual(state.tangent.value / run["K3.tangent"].value, 1, delta=0.05)

    def test_the_line_load_is_in_equilibrium_with_the_force(self):
        state = self.pair.solve(force=(976, "kN"))
        z, q = state.z, state.line_load
        half = np.sum(0.5 * (q[1:] + q[:-1]) * np.diff(z))
        self.assertAlmostEqual(2 * half / state.force.value, 1, delta=0.02)  # trapezoids along quadratic elements
        self.assertEqual(state.touching.shape[0], len(z))
        self.assertTrue(state.touching[:, 0].all())

    def test_a_crown_gathers_the_load_at_mid_length_and_another_pair_of_that_crown_agrees(self):
        flat = self.pair.solve(force="976 kN", crown="0 um")
        crowned = self.pair.solve(force="976 kN", crown="100 um")
        self.assertGreater(crowned.line_load[0], flat.line_load[0])
        self.assertLess(crowned.secant.value, flat.secant.value)
        again = self.pair.solve(force="976 kN", crown="0 um")
        np.testing.assert_array_equal(again.line_load, flat.line_load)
        case = coarse_stand()
        case["backup_roll.crown"] = "100 um"
        other = case.roll_pair("upper", cache=CACHE).solve(force="976 kN")
        self.assertAlmostEqual(other.secant.value / crowned.secant.value, 1, delta=1e-9)

    def test_wrong_questions_are_refused(self):
        for wrong in ("0 kN", "-5 kN", "1e9 kN", "976", "976 mm", "much"):
            with self.assertRaises(ms.InputError, msg=wrong):
                self.pair.solve(force=wrong)
        with self.assertRaisesRegex(ms.InputError, "mirrored"):
            self.pair.solve(force="976 kN", held="by hand")
        with self.assertRaisesRegex(ms.InputError, "upper"):
            self.case.roll_pair("middle", cache=CACHE)
        with self.assertRaisesRegex(ms.InputError, "no pair of rolls"):
            ms.load(CASES / "published-1400.toml").roll_pair("upper", cache=CACHE)


class Bearings(unittest.TestCase):
    def test_the_rollers_carry_the_load_and_the_stiffness_is_its_derivative(self):
        bearing = coarse_stand().bearing("work", cache=CACHE)
        state = bearing.solve(radial="488 kN", tilt="0.2 mrad")
        self.assertEqual(state.roller_loads.shape, (4, 39))
        self.assertEqual(state.stiffness.shape, (5, 5))
        np.testing.assert_allclose(state.stiffness, state.stiffness.T, rtol=0, atol=1e-6 * abs(state.stiffness).max())
        self.assertAlmostEqual(state.load[0] / 488e3, 1, delta=1e-8)  # equilibrium of the solver
        self.assertGreater(state.L10mr.value, 0)
        self.assertEqual(state.L10mr.unit, "1")
        more = bearing.solve(radial="488.1 kN", tilt="0.2 mrad")
        slope = 100 / (more.motion[0] - state.motion[0])
        # x and y are free, the others are held: the slope is that of the condensed matrix, to the step of 0.02 %.
        free = state.stiffness[:2, :2]
        condensed = np.linalg.det(free) / free[1, 1]
        self.assertAlmostEqual(slope / condensed, 1, delta=1e-3)

    def test_names_and_rolls_lead_to_the_same_bearing_and_others_are_refused(self):
        case = coarse_stand()
        self.assertEqual(case.bearing("backup").name, case.bearing("crb").name)
        with self.assertRaisesRegex(ms.InputError, "it has trb, crb|it has crb, trb"):
            case.bearing("front")


class Chains(unittest.TestCase):
    def test_modes_are_those_of_the_matrices_and_of_the_run(self):
        run = lumped_run()
        chain = run.chain
        roots = np.linalg.eigvals(np.linalg.solve(chain.M, chain.K))
        frequencies = np.sort(np.sqrt(roots.real)) / (2 * math.pi)
        np.testing.assert_allclose(chain.modes().frequency, frequencies, rtol=1e-9)
        shape = chain.modes().shape
        np.testing.assert_allclose(shape.T @ chain.M @ shape, np.eye(6), atol=1e-9)

    def test_a_constant_force_leaves_the_chain_at_rest_and_a_step_reaches_its_static_answer(self):
        chain = lumped_run().chain
        still = chain.simulate(np.full(50, 1e6), rate=20e3)
        for label in chain.labels:
            self.assertLess(abs(still[label]).max(), 1e-9)
        self.assertEqual(still.dtype.metadata["units"][chain.labels[0]], "m/s2")

    def test_the_answer_is_linear_in_the_force(self):
        chain = lumped_run().chain
        force = 1e5 * np.random.default_rng(1).standard_normal(200)
        one, two = chain.simulate(force), chain.simulate(2 * force)
        label = chain.labels[2]
        np.testing.assert_allclose(two[label], 2 * one[label], rtol=1e-9, atol=1e-9 * abs(one[label]).max())
        times = np.arange(200) / 20e3
        np.testing.assert_allclose(chain.simulate((times, force))[label], one[label], rtol=0,
                                   atol=1e-6 * abs(one[label]).max())

    def test_wrong_forces_are_refused(self):
        chain = lumped_run().chain
        for wrong in (np.zeros(1), np.array([0, np.nan]), (np.array([1.0, 0.0]), np.zeros(2))):
            with self.assertRaises(ms.InputError):
                chain.simulate(wrong)
        with self.assertRaisesRegex(ms.InputError, "one row of numbers"):
            chain.simulate(np.zeros((3, 3)))
        with self.assertRaisesRegex(ms.InputError, "rate = None is not a rate"):
            chain.simulate(np.zeros(3), rate=None)
        # 1e12 s at 20 kHz are 2e16 samples, more than any machine holds.
        with self.assertRaisesRegex(ms.InputError, "the force lasts 1e\\+12 s"):
            chain.simulate((np.array([0, 1e12]), np.zeros(2)))

    def test_a_rate_is_a_number_of_any_kind_or_a_text(self):
        chain = lumped_run().chain
        force = np.arange(10.0)
        for rate in (20000, np.float32(20000), np.int64(20000), "20 kHz", (20, "kHz")):
            self.assertEqual(len(chain.simulate(force, rate=rate)), 10, rate)


class ChatterOfATandem(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.chatter = ms.load(CASES / "chatter-tandem.toml").chatter()

    def test_critical_speed_interval_and_mode(self):
        speed = self.chatter.critical_speed
        self.assertEqual(speed.unit, "m/s")
        name = self.chatter.passes[0]
        self.assertEqual(speed.value, self.chatter.run[f"chatter.{name}.critical_speed"].value)
        low, high = self.chatter.interval
        self.assertTrue(low < speed.value < high)
        self.assertIn("Hz", self.chatter.mode)
        with self.assertRaisesRegex(ms.InputError, "there are"):
            self.chatter.mode_of("nothing")

    def test_the_border_of_a_map_over_speed_is_the_critical_speed(self):
        speed = self.chatter.critical_speed.value
        near = self.chatter.map("roll_speed", "friction", n=3,
                                x_range=((0.99 * speed, "m/s"), (1.01 * speed, "m/s")), y_range=(0.999, 1.001))
        self.assertLess(near.growth[0, 1], 0)
        self.assertGreater(near.growth[2, 1], 0)
        self.assertAlmostEqual(near.growth[1, 1] / near.growth[2, 1], 0, delta=1e-6)

    def test_a_map_over_reduction_and_friction(self):
        chart = self.chatter.map("reduction", "friction", n=6)
        self.assertEqual(chart.growth.shape, (6, 6))
        self.assertEqual((chart.x_name, chart.y_name), ("reduction", "friction"))
        self.assertTrue(np.isfinite(chart.growth).any())
        for x, y in (("reduction", "reduction"), ("colour", "friction")):
            with self.assertRaises(ms.InputError):
                self.chatter.map(x, y, n=3)


class Studies(unittest.TestCase):
    def test_the_optimum_is_at_the_bounds_of_the_chain(self):
        inputs = {"given.K1": "uniform(4, 8) MN/mm", "given.M2": "uniform(50, 70) t"}
        case = ms.load(CASES / "published-1400.toml")
        study = ms.study(case, inputs, method="optimise", maximise="f1", samples=4, model="quick", cache_limit="1GB")
        optimum = study.report()["optimum"]
        self.assertEqual(optimum["inputs"], [8, 50])  # f1 grows with K1 and falls with M2; the bounds themselves
        with self.assertRaisesRegex(ms.InputError, "belong to --method optimise"):
            ms.study(case, inputs, minimise="f1", samples=4, model="quick")


if __name__ == "__main__":
    unittest.main()
