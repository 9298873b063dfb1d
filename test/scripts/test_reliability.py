"""The fit behind scripts/fit_reliability: regression, what is usual, figures and terms."""

import math
import re
import sys
import unittest
from pathlib import Path

import numpy as np

PACKAGE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PACKAGE / "scripts"))

from benchmark_lib.programs import BenchmarkError  # after the path that it is found on
from reliability_lib import regression, terms, usual


def known_problem(rows=40000, seed=3):
    """Terms of very different units, and labels drawn with intercept -1 and weights 2 and -0.05."""
    rng = np.random.default_rng(seed)
    drawn = np.c_[rng.normal(0.5, 1, rows), rng.normal(100, 20, rows)]
    probability = 1 / (1 + np.exp(-(-1 + 2 * drawn[:, 0] - 0.05 * (drawn[:, 1] - 100))))
    return drawn, (rng.random(rows) < probability).astype(float)


class FitTest(unittest.TestCase):
    def test_finds_the_weights_that_labels_were_drawn_with(self):
        drawn, labels = known_problem()
        model = regression.fit(drawn, labels, np.ones(len(labels)), (1, -1))
        np.testing.assert_allclose(model.weights, (2, -0.05), rtol=0.05)
        self.assertAlmostEqual(model.intercept, -1 + 0.05 * 100, delta=0.25)

    def test_its_gradient_vanishes_where_no_sign_binds(self):
        drawn, labels = known_problem(rows=500)
        model = regression.fit(drawn, labels, np.ones(500), (1, -1))
        residual = labels - model.predict(drawn)
        deviation = drawn.std(axis=0)
        gradient = ((drawn - drawn.mean(axis=0)) / deviation).T @ residual
        self.assertAlmostEqual(residual.sum(), 0, delta=1e-2)
        penalty = regression.PENALTY * model.weights * deviation
        np.testing.assert_allclose(gradient, penalty, atol=1e-2)

    def test_a_weight_of_the_wrong_sign_is_none_and_the_others_are_those_without_it(self):
        drawn, labels = known_problem(rows=2000)
        weights = np.ones(len(labels))
        model = regression.fit(drawn, labels, weights, (1, 1))
        alone = regression.fit(drawn[:, :1], labels, weights, (1,))
        self.assertEqual(model.weights[1], 0)
        np.testing.assert_allclose(model.weights[0], alone.weights[0], rtol=1e-3)

    def test_a_sample_of_weight_two_counts_as_two(self):
        drawn, labels = known_problem(rows=300)
        doubled = np.where(np.arange(300) < 100, 2.0, 1.0)
        weighted = regression.fit(drawn, labels, doubled, (1, -1))
        twice = np.r_[np.arange(300), np.arange(100)]
        repeated = regression.fit(drawn[twice], labels[twice], np.ones(400), (1, -1))
        np.testing.assert_allclose(weighted.weights, repeated.weights, rtol=1e-3)

    def test_units_do_not_matter(self):
        drawn, labels = known_problem(rows=300)
        weights = np.ones(300)
        one = regression.fit(drawn, labels, weights, (1, -1)).predict(drawn)
        scaled = drawn * (1000, 0.001)
        other = regression.fit(scaled, labels, weights, (1, -1)).predict(scaled)
        np.testing.assert_allclose(one, other, atol=1e-5)

    def test_a_constant_term_gets_no_weight(self):
        drawn, labels = known_problem(rows=300)
        drawn[:, 1] = 7
        self.assertEqual(regression.fit(drawn, labels, np.ones(300), (1, 1)).weights[1], 0)


def scenes_of_a_sensor(scenes=60, seed=5):
    """Terms of scenes of twenty poses, twelve of them right. What is looked through of a wrong pose is 0.05 more than of a
    right one, and of all poses of every other scene a further 0.03. All else says nothing. Returns terms, labels, scenes.
    """
    rng = np.random.default_rng(seed)
    drawn = rng.normal(0, 0.02, (20 * scenes, len(terms.TERMS)))
    labels = np.tile(np.repeat([1.0, 0.0], (12, 8)), scenes)
    numbers = np.repeat(np.arange(scenes), 20)
    shares = 0.05 * (1 - labels) + 0.03 * (numbers % 2) + rng.normal(0, 0.01, len(labels))
    drawn[:, usual.LOOKED_THROUGH] = np.maximum(shares, 0)
    return drawn, labels, numbers


class UsualTest(unittest.TestCase):
    def setUp(self):
        self.drawn, self.labels, self.numbers = scenes_of_a_sensor()
        self.gates = np.ones(len(self.labels), bool)

    def test_is_the_median_of_the_others_that_show_it_and_of_five_zeros(self):
        shares = np.array([0.03, 0.01, 0.02, 0.01, 0.012, 0.014, 0.016, 0.9])
        found = usual.usual_shares(shares, np.arange(8) < 7)
        for i, share in enumerate(found):
            known = sorted([shares[k] for k in range(7) if k != i] + 5 * [0])
            self.assertEqual(share, known[(len(known) - 1) // 2])
        self.assertEqual(found[7], 0.01)

    def test_of_few_poses_is_nothing_and_of_many_no_more_than_the_most(self):
        np.testing.assert_array_equal(usual.usual_shares(np.full(6, 0.1), np.ones(6, bool)), 0)
        much = usual.usual_shares(np.full(20, 0.4), np.ones(20, bool))
        np.testing.assert_array_equal(much, usual.MOST_USUAL)

    def test_scenes_do_not_mix_and_other_terms_stay(self):
        model = regression.Model(5.0, np.zeros(self.drawn.shape[1]))  # sure of all
        beyond = usual.without_usual(model, self.drawn, self.gates, self.numbers)
        column = usual.LOOKED_THROUGH
        np.testing.assert_array_equal(
            np.delete(beyond, column, axis=1), np.delete(self.drawn, column, axis=1)
        )
        alone = usual.without_usual(model, self.drawn[:20], self.gates[:20], self.numbers[:20])
        np.testing.assert_array_equal(beyond[:20], alone)
        less = self.drawn[20:40, column] - beyond[20:40, column]
        self.assertGreater(less.mean(), 0.02)

    def test_improbable_poses_and_those_that_fail_a_gate_show_nothing(self):
        doubt = regression.Model(0.0, np.zeros(self.drawn.shape[1]))
        sure = regression.Model(5.0, np.zeros(self.drawn.shape[1]))
        for model, gates in ((doubt, self.gates), (sure, ~self.gates)):
            beyond = usual.without_usual(model, self.drawn, gates, self.numbers)
            np.testing.assert_array_equal(beyond, self.drawn)

    def test_the_fit_without_what_is_usual_predicts_better(self):
        # another term tells some as well, or in every other scene no pose would be probable
        self.drawn[:, 1] += 0.05 * self.labels
        weights = np.ones(len(self.labels))
        plain = regression.fit(self.drawn, self.labels, weights, terms.SIGNS)
        given = (self.gates, self.numbers)
        model = usual.fit(self.drawn, self.labels, weights, *given, terms.SIGNS)
        beyond = usual.without_usual(model, self.drawn, *given)
        self.assertLess(
            self.loss(model.predict(beyond)), 0.6 * self.loss(plain.predict(self.drawn))
        )

    def loss(self, predicted):
        """Of the labels, by what was predicted."""
        return -np.log(np.where(self.labels == 1, predicted, 1 - predicted)).sum()

    def test_each_gate_stops_a_pose(self):
        fine = {**TermsTest.POSE, "margin": 0.5, "pierced": 0.1, "outline_broken": 0.2, "hold": 0.1}
        self.assertTrue(usual.passes_gates(fine))
        for name, value in (
            ("spread", 2),
            ("outline_broken", 0.9),
            ("pierced", 0.4),
            ("margin", 0),
            ("score", 0.3),
            ("visible_fraction", 0),
            ("confirmed_px", 0),
        ):
            self.assertFalse(usual.passes_gates({**fine, name: value}), name)
        self.assertTrue(usual.passes_gates({**fine, "slide_share": 1}))
        self.assertFalse(usual.passes_gates({**fine, "slide_share": 1, "hold": 0.01}))

    def test_the_detector_has_the_same_numbers(self):
        header = (PACKAGE / "include/ppf_bin_picking/core/reliability.hpp").read_text()
        source = (PACKAGE / "src/core/reliability.cpp").read_text()
        self.assertIn(f"kShowsUsual = {usual.SHOWS_USUAL};", header)
        self.assertIn(f"kZeros = {usual.ZEROS};", source)
        self.assertIn(f"kMostUsual = {usual.MOST_USUAL};", source)
        for term in terms.TERMS:
            self.assertIn(f"{{{term.code}, ", " ".join(source.split()))

    def test_the_detector_has_the_weights_of_the_page(self):
        source = "".join((PACKAGE / "src/core/reliability.cpp").read_text().split())
        page = (PACKAGE / "docs/reliability.md").read_text()
        (code,) = re.findall(r"```cpp\n(.*?)```", page, re.DOTALL)
        lines = [line for line in code.splitlines() if line]
        self.assertEqual(len(lines), 2 + len(terms.TERMS))
        for line in lines:
            self.assertIn("".join(line.split()), source)

    def test_the_detector_has_no_other_gates(self):
        verdict = (PACKAGE / "src/core/pose_verdict.cpp").read_text()
        gates = set(re.findall(r"config\.(\w+)", verdict))
        used = set(re.findall(r'limit\["(\w+)"\]', Path(usual.__file__).read_text()))
        self.assertEqual(gates - used, {"clustering", "mismatch_test", "min_reliability"})
        self.assertEqual(used - gates, set())


class LeftOutTest(unittest.TestCase):
    def test_what_is_predicted_of_a_group_ignores_its_own_labels(self):
        drawn, labels, numbers = scenes_of_a_sensor()
        groups = np.array(["a", "b", "c"])[numbers % 3]
        weights = np.ones(len(labels))
        given = (weights, groups, np.ones(len(labels), bool), numbers, terms.SIGNS)
        before = usual.predict_left_out(drawn, labels, *given)
        labels[groups == "b"] = 1 - labels[groups == "b"]
        after = usual.predict_left_out(drawn, labels, *given)
        np.testing.assert_array_equal(before[groups == "b"], after[groups == "b"])
        self.assertGreater(np.abs(before - after)[groups == "a"].max(), 0.01)


class FiguresTest(unittest.TestCase):
    def test_kept_share_and_precision_count_the_threshold_itself(self):
        predicted, labels = np.array([0.9, 0.8, 0.8, 0.1]), np.array([1, 1, 0, 1])
        kept, precision = regression.kept_and_precision(predicted, labels, 0.8)
        self.assertAlmostEqual(kept, 2 / 3)
        self.assertAlmostEqual(precision, 2 / 3)

    def test_bins_hold_all_poses_with_their_means(self):
        predicted = np.array([0.0, 0.11, 0.19, 0.95, 1.0])
        labels, weights = np.array([0, 1, 0, 1, 1]), np.array([1, 3, 1, 1, 1])
        bins = regression.reliability_bins(predicted, labels, weights)
        self.assertEqual([entry.count for entry in bins], [1, 2] + 8 * [0] + [1, 0, 1])
        self.assertAlmostEqual(bins[1].predicted, (3 * 0.11 + 0.19) / 4)
        self.assertAlmostEqual(bins[1].observed, 0.75)
        self.assertTrue(math.isnan(bins[5].observed))


class TermsTest(unittest.TestCase):
    POSE = {
        "score": 0.5,
        "margin": 0.3,
        "hold": 0.01,
        "slide_share": 0.7,
        "spread": 0.4,
        "looked_through": 0.02,
        "goes_on": 0.05,
        "claimed": 0.03,
        "confirmed_px": 1000,
        "visible_fraction": 0.6,
    }

    def test_values_are_those_of_the_result_in_their_scales(self):
        row = terms.terms_of([self.POSE], "here")[0]
        np.testing.assert_allclose(
            row, [0, 0.3, -2, 0.7, 0.4, 0.02, 0.05, 0.03, 3, 0.6], atol=1e-12
        )

    def test_extremes_are_clamped(self):
        low = {**self.POSE, "score": 0, "margin": -1, "hold": 0, "confirmed_px": 0}
        high = {**self.POSE, "score": 1, "margin": 1, "spread": 9, "visible_fraction": 1.5}
        low_row, high_row = terms.terms_of([low, high], "here")
        np.testing.assert_allclose(low_row[[0, 1, 2, 8]], [-np.log(4), -0.2, -3, np.log10(30)])
        np.testing.assert_allclose(high_row[[0, 1, 4, 9]], [np.log(49), 0.5, 2, 1])

    def test_a_pose_without_a_value_is_refused_with_its_name_and_place(self):
        pose = {**self.POSE, "claimed": None}
        with self.assertRaisesRegex(BenchmarkError, "here.*claimed"):
            terms.terms_of([self.POSE, pose], "here")

    def test_no_pose_is_no_row(self):
        self.assertEqual(terms.terms_of([], "here").shape, (0, len(terms.TERMS)))

    def test_the_code_has_a_line_a_term_with_weight_and_mean(self):
        model = regression.Model(-1.5, np.arange(len(terms.TERMS)) / 8)
        other = regression.Model(2, np.arange(len(terms.TERMS)) / 4)
        means = np.arange(len(terms.TERMS)) * 10.0
        lines = terms.code_of([(model, means), (other, -means)]).splitlines()
        self.assertEqual(lines[0], "constexpr double kInterceptInRegion = -1.500;")
        self.assertEqual(lines[1], "constexpr double kInterceptInWholeCloud = 2.000;")
        self.assertEqual(
            lines[4],
            "      {std::clamp(pose.margin, -0.2, 0.5), ReliabilityTerm::kMargin, {0.125, 10.000}, {0.250, -10.000}},",
        )
        self.assertEqual(len(lines), 3 + len(terms.TERMS))


if __name__ == "__main__":
    unittest.main()
