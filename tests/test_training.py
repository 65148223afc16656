"""Training: sums that add up, seeds, flipped samples, the normal equations, pooling."""

from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.bins import Bins
from skyline_viz.config import DetectorConfig, TrainingConfig
from skyline_viz.detector import Detector
from skyline_viz.edges import candidate_edges
from skyline_viz.evaluation.metrics import a_err
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.training import (
    GramMatrices,
    gather,
    pooled,
    regress,
    smoothness_form,
    solve,
    together,
    train,
)
from testing.samples import (
    AS_PUBLISHED,
    COARSE,
    CONFIG,
    all_pixels,
    lonely,
    mountains,
    same_sums,
    shares,
    slow_sums,
    sum_of_both,
    targets,
)


@pytest.fixture(scope="module")
def grams():
    return [gather(*mountains(seed), 0, CONFIG) for seed in range(4)]


# Gathering


@pytest.mark.parametrize("reach", [0, 2])
@pytest.mark.parametrize("size", [3, 7, 9])
@pytest.mark.parametrize("bins", [COARSE, Bins(), Bins(1, 2, 8)], ids=["few", "published", "other"])
def test_sums_are_those_of_the_photo_and_of_its_flipped_twin(size, bins, reach):
    config = TrainingConfig(bins=bins, filter_size=size, reach=reach)
    photo, truth = lonely()
    pixels = all_pixels(photo, truth, config)
    assert 90 < len(pixels) < 180  # fewer negatives than positives: all are drawn
    flipped_pixels = [(row, 89 - column, target) for row, column, target in pixels]
    flipped_photo = np.ascontiguousarray(photo[:, ::-1])
    here, there = slow_sums(photo, pixels, config), slow_sums(flipped_photo, flipped_pixels, config)
    found = gather(photo, truth, 0, config)
    assert np.array_equal(found.samples, here[1] + there[1])
    assert np.array_equal(found.sums, here[0] + there[0])
    assert np.array_equal(found.weights, found.samples)
    assert found.images == 1


def test_positives_are_the_edges_nearest_to_a_truth_that_is_a_little_off():
    photo, truth = lonely()
    near = gather(photo, Skyline(truth.rows + 2), 0, CONFIG)
    off = gather(photo, Skyline(truth.rows + 2), 0, AS_PUBLISHED)
    pixels = all_pixels(photo, Skyline(truth.rows + 2), CONFIG)
    rows, columns = np.array([pixel[:2] for pixel in pixels if pixel[2] == 255]).T
    edges, _ = candidate_edges(photo, CONFIG.detector)
    assert edges[rows, columns].all()
    assert np.array_equal(near.sums, sum_of_both(photo, pixels))
    assert not np.array_equal(near.sums, off.sums)


def test_columns_without_an_edge_near_the_truth_have_no_positive():
    photo, truth = lonely()
    rows = truth.rows.copy()
    rows[30:50] = 5  # in the middle of the sky
    assert targets(gather(photo, Skyline(rows), 0, CONFIG))[0] == 2 * 70
    assert targets(gather(photo, Skyline(rows), 0, AS_PUBLISHED))[0] == 2 * 90


def test_there_are_as_many_negatives_as_positives(grams):
    for gram in grams:
        assert targets(gram) == (2 * 140, 2 * 140)


def test_the_draw_is_among_all_possible_samples():
    photo, truth = mountains()
    one_bin = TrainingConfig(bins=Bins(1, 1, 1))
    pixels = all_pixels(photo, truth, one_bin)
    assert len(pixels) > 3 * 140
    found = gather(photo, truth, 0, one_bin)
    positives = slow_sums(photo, pixels[:140], one_bin)[0][0]
    mirrored = np.append(np.arange(49).reshape(7, 7)[:, ::-1].ravel(), 49)
    negatives = found.sums[0] - positives - positives[np.ix_(mirrored, mirrored)]
    assert negatives[-1, -1] == 280 * 127.5**2
    everything = slow_sums(photo, pixels[140:], one_bin)[0][0]
    everything += everything[np.ix_(mirrored, mirrored)]
    assert (np.diag(negatives) <= np.diag(everything)).all()
    assert not np.array_equal(negatives, everything)


def test_halves_add_up_to_the_whole(grams):
    halves = (grams[0] + grams[1]) + (grams[2] + grams[3])
    whole = GramMatrices.empty(CONFIG)
    for gram in (grams[3], grams[1], grams[0], grams[2]):
        whole += gram
    assert same_sums(halves, whole)
    assert halves.images == whole.images == 4
    assert (halves.samples >= grams[0].samples).all()
    one, other = solve(halves, 0, CONFIG), train([mountains(seed) for seed in range(4)], 0, CONFIG)
    assert np.array_equal(one.filters, other.filters)
    assert np.array_equal(one.samples, other.samples)
    assert one.provenance == other.provenance


def test_the_place_in_the_list_does_not_matter(grams):
    examples = [mountains(seed) for seed in range(4)]
    one, other = train(examples, 0, CONFIG), train(examples[::-1], 0, CONFIG)
    assert np.array_equal(one.filters, other.filters)
    assert np.array_equal(one.samples, other.samples)


def test_a_seed_repeats_the_draw(grams):
    photo, truth = mountains()
    assert same_sums(gather(photo, truth, 0, CONFIG), grams[0])
    other = gather(photo, truth, 1, CONFIG)
    assert not np.array_equal(other.sums, grams[0].sums)
    assert targets(other) == targets(grams[0])
    examples = [mountains(seed) for seed in range(2)]
    banks = [train(examples, seed, CONFIG) for seed in (5, 5, 6)]
    assert np.array_equal(banks[0].filters, banks[1].filters)
    assert not np.array_equal(banks[0].filters, banks[2].filters)


def test_nothing_outside_is_random(grams):
    np.random.seed(1)  # noqa: NPY002
    assert same_sums(gather(*mountains(), 0, CONFIG), grams[0])


def test_invisible_columns_teach_nothing():
    photo, truth = mountains()
    visible = np.ones(140, bool)
    visible[30:90] = False
    rows = truth.rows.copy()
    rows[30:90] = 3
    hidden = gather(photo, Skyline(rows, visible), 0, CONFIG)
    assert targets(hidden) == (2 * 80, 2 * 80)
    rows[30:90] = 90
    assert same_sums(gather(photo, Skyline(rows, visible), 0, CONFIG), hidden)
    one_bin = TrainingConfig(bins=Bins(1, 1, 1))
    photo, truth = lonely()
    visible = np.arange(90) > 25  # the only other edges lie left of column 25
    assert targets(gather(photo, Skyline(truth.rows, visible), 0, one_bin)) == (2 * 64, 0)


def test_columns_that_are_all_sky_teach_nothing():
    photo, truth = mountains()
    rows = truth.rows.copy()
    rows[:20] = 96
    assert targets(gather(photo, Skyline(rows), 0, CONFIG))[0] == 2 * 120


def test_nothing_visible_at_all():
    photo, truth = mountains()
    gram = gather(photo, Skyline(truth.rows, np.zeros(140, bool)), 0, CONFIG)
    assert not gram.sums.any()
    assert gram.samples.sum() == 0
    with pytest.raises(ValueError, match="at least one photo with a visible true skyline"):
        solve(gram, 0, CONFIG)


@pytest.mark.parametrize("band", [0, 10, 1000])
def test_negatives_lie_outside_the_band(band):
    photo, truth = lonely()
    config = TrainingConfig(bins=COARSE, band=band)
    expected = sum(target < 200 for *_, target in all_pixels(photo, truth, config))
    assert targets(gather(photo, truth, 0, config))[1] == 2 * min(expected, 90)
    assert (expected == 0) == (band == 1000)


def test_training_sees_the_detectors_edges():
    photo, truth = mountains()
    sparse = DetectorConfig(low_threshold=1e5, high_threshold=1e5, fit_thresholds=False)
    gram = gather(photo, truth, 0, replace(AS_PUBLISHED, detector=sparse))
    assert targets(gram) == (2 * 140, 0)
    gram = gather(photo, truth, 0, replace(CONFIG, detector=sparse))
    assert targets(gram) == (0, 0)


def test_fractional_rows_are_rounded():
    photo, truth = lonely()
    moved = Skyline(truth.rows + np.float32(0.4))
    assert same_sums(gather(photo, moved, 0, CONFIG), gather(photo, truth, 0, CONFIG))


def test_views_and_read_only_photos(grams):
    photo, truth = mountains()
    photo.setflags(write=False)
    wide = np.zeros((96, 280, 3), np.uint8)
    wide[:, ::2] = photo
    assert same_sums(gather(photo, truth, 0, CONFIG), grams[0])
    assert same_sums(gather(wide[:, ::2], truth, 0, CONFIG), grams[0])


def test_tiny_photos():
    for shape in ((2, 2), (2, 30), (30, 2), (9, 9)):
        photo = np.random.default_rng(0).integers(0, 256, (*shape, 3), dtype=np.uint8)
        bank = train([(photo, Skyline(np.ones(shape[1])))], 0, CONFIG)
        assert np.isfinite(bank.filters).all()


# Solving


def test_filters_solve_the_normal_equations(grams):
    sums = sum(grams[1:], grams[0]).sums
    filters = regress(sums, 250.0).reshape(COARSE.count, 49)
    assert filters.dtype == np.float64
    form = smoothness_form(7)
    for own, taps in zip(sums, filters, strict=True):
        gradient = own[:-1, :-1] @ taps - own[:-1, -1] + 250 * form @ taps
        assert np.abs(gradient).max() <= 1e-3 * np.abs(taps).max() + 1e-8 * np.abs(own).max()


def test_filters_reach_the_targets_of_simple_samples():
    rng = np.random.default_rng(0)
    taps = rng.normal(size=9)
    patches = rng.integers(0, 256, (500, 9)).astype(float)
    samples = np.column_stack([patches, patches @ taps])
    found = regress((samples.T @ samples)[None], 0.0)
    assert found.shape == (1, 3, 3)
    assert np.allclose(found.ravel(), taps, atol=1e-6)


def test_a_larger_weight_gives_smoother_filters(grams):
    form = smoothness_form(7)
    roughness = []
    for weight in (0, 1e2, 1e4, 1e6, 1e8):
        taps = regress(grams[0].sums, weight).reshape(COARSE.count, 49)
        roughness.append(np.einsum("ki,ij,kj->k", taps, form, taps))
    trained = grams[0].samples > 0
    assert (np.diff(roughness, axis=0)[:, trained] < 0).all()


def test_bins_without_samples_have_zero_filters():
    assert not regress(np.zeros((3, 50, 50)), 100.0).any()


@pytest.mark.parametrize("size", [3, 7, 15])
def test_smoothness_is_the_sum_of_squared_differences(size):
    form = smoothness_form(size)
    taps = np.random.default_rng(size).normal(size=(size, size))
    expected = (np.diff(taps, axis=0) ** 2).sum() + (np.diff(taps, axis=1) ** 2).sum()
    assert taps.ravel() @ form @ taps.ravel() == pytest.approx(expected)
    assert np.array_equal(form, form.T)
    assert (np.linalg.eigvalsh(form) > -1e-9).all()


@pytest.mark.parametrize("over", [(0,), (1,), (2,), (0, 1), (0, 1, 2)])
def test_pooling(over):
    bins = Bins(2, 3, 4)
    sums = np.random.default_rng(0).normal(size=(24, 5, 5))
    found = pooled(sums, bins, over)
    for index, own in enumerate(np.ndindex(2, 3, 4)):
        like = [
            other
            for other, place in enumerate(np.ndindex(2, 3, 4))
            if all(place[axis] == own[axis] for axis in range(3) if axis not in over)
        ]
        assert np.allclose(found[index], sums[like].sum(axis=0))


def test_each_bin_takes_its_orientation_for_so_many_samples(grams):
    gram = sum(grams[1:], grams[0])
    bank = solve(gram, 0, replace(CONFIG, pooling=70))
    for index in (0, 5, 23):
        like = np.arange(index % 4, COARSE.count, 4)
        pool = gram.sums[like].sum(axis=0) * 70 / gram.samples[like].sum()
        (expected,) = regress((gram.sums[index] + pool)[None], CONFIG.smoothness)
        assert np.allclose(bank.filters[index], expected, atol=1e-6)


def test_without_pooling_each_bin_is_alone_as_published(grams):
    gram = sum(grams[1:], grams[0])
    bank = solve(gram, 0, AS_PUBLISHED)
    assert np.array_equal(bank.filters, regress(gram.sums, 100.0).astype(np.float32))
    assert not bank.filters[gram.samples == 0].any()


def test_bins_without_samples_take_the_filter_of_their_orientation(grams):
    gram = sum(grams[1:], grams[0])
    bare = gram.samples == 0
    bank = solve(gram, 0, CONFIG)
    assert 0 < bare.sum() < COARSE.count
    assert np.abs(bank.filters[bare]).max(axis=(1, 2)).all()


def test_the_more_pooling_the_more_alike(grams):
    gram = sum(grams[1:], grams[0])
    spreads = []
    for pooling in (1, 1e3, 1e6, 1e9):
        filters = solve(gram, 0, replace(CONFIG, pooling=pooling)).filters.reshape(6, 4, -1)
        spreads.append(filters.std(axis=0).mean())
    assert sorted(spreads, reverse=True) == spreads
    assert spreads[-1] < 1e-3 * spreads[0]


# Several data sets


def test_data_sets_count_alike_whatever_their_number_of_photos(grams):
    few, many = grams[0], sum(grams[2:], grams[1])
    both = together([few, many])
    assert np.array_equal(both.samples, few.samples + many.samples)
    assert both.images == 4
    assert both.weights.sum() == pytest.approx(both.samples.sum())
    assert np.allclose(both.sums, both.weights.sum() / 2 * (shares(few) + shares(many)))


def test_a_data_set_alone_is_as_it_is(grams):
    assert same_sums(together(grams[:1]), grams[0])
    empty = GramMatrices.empty(CONFIG)
    assert same_sums(together([grams[0], empty]), grams[0])
    assert together([empty, empty]).samples.sum() == 0


# Whole banks


@pytest.mark.parametrize("size", [7, 9, 11, 13, 15])
@pytest.mark.parametrize("bins", [COARSE, Bins(1, 1, 8)], ids=["2x3x4", "1x1x8"])
def test_other_sizes_and_bins_train_and_detect(size, bins, tmp_path):
    config = TrainingConfig(bins=bins, filter_size=size)
    bank = train([mountains(seed) for seed in range(2)], 0, config, dataset="hills")
    assert bank.filters.shape == (bins.count, size, size)
    assert bank.bins == bins
    assert bank.samples.sum() == 2 * 2 * 2 * 140
    bank.save(tmp_path / "a.npz")
    photo, truth = mountains(seed=7)
    detection = Detector(type(bank).load(tmp_path / "a.npz")).detect(photo)
    assert a_err(detection.skyline, truth) < 1.5
    assert detection.bins.max() < bins.count


def test_scores_are_higher_on_the_skyline():
    bank = train([mountains(seed) for seed in range(6)], 0, CONFIG)
    photo, truth = mountains(seed=9)
    detection = Detector(bank).detect(photo)
    off = np.abs(detection.edge_rows - truth.rows[detection.edge_columns])
    on_line, elsewhere = detection.scores[off <= 1], detection.scores[off > 10]
    assert on_line.mean() > elsewhere.mean() + 0.1


def test_provenance():
    grey = DetectorConfig(edge_source="grey")
    config = replace(CONFIG, smoothness=12.5, detector=grey)
    bank = train(iter([mountains(), mountains(1)]), 3, config, dataset="hills")
    found = bank.provenance
    assert (found.dataset, found.images, found.seed) == ("hills", 2, 3)
    assert (found.edges, found.smoothness) == ("grey", 12.5)
    assert found.package


# What is refused


def test_no_example_is_refused():
    with pytest.raises(ValueError, match="at least one photo"):
        train([], 0)


def test_another_width_is_refused():
    photo, _ = mountains()
    with pytest.raises(SkylineError, match="the truth has 99 columns, the photo 140"):
        train([(photo, Skyline(np.ones(99)))], 0)


def test_a_visible_row_outside_is_refused():
    photo, truth = mountains()
    with pytest.raises(SkylineError, match="outside"):
        gather(photo, Skyline(truth.rows + 100), 0, CONFIG)


@pytest.mark.parametrize("photo", [np.zeros((9, 9, 3)), None])
def test_what_is_no_photo_is_refused(photo):
    with pytest.raises(TypeError, match="uint8"):
        gather(photo, Skyline(np.ones(9)), 0, CONFIG)


@pytest.mark.parametrize("size", [3, 7, 15])
def test_the_sums_of_small_filters_are_in_those_of_large_ones(size):
    largest = gather(*mountains(), 0, replace(CONFIG, filter_size=15))
    own = gather(*mountains(), 0, replace(CONFIG, filter_size=size))
    cropped = largest.cropped(size)
    assert np.array_equal(cropped.sums, own.sums)
    assert np.array_equal(cropped.samples, own.samples)
