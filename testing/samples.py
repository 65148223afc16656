"""Photos to train filters on, and their Gram matrices sample by sample, for tests of training."""

import cv2
import numpy as np

from skyline_viz.bins import Bins
from skyline_viz.config import TrainingConfig
from skyline_viz.edges import candidate_edges, edge_pixels, to_grey
from skyline_viz.skyline import Skyline
from skyline_viz.tensor import tensor_at

COARSE = Bins(coherences=2, strengths=3, orientations=4)
CONFIG = TrainingConfig(bins=COARSE)
AS_PUBLISHED = TrainingConfig(bins=COARSE, reach=0, smoothness=100, pooling=0)


def mountains(seed=0, height=96, width=140):
    """Photo of a ridge with rocks below a plain sky, and its true skyline."""
    rng = np.random.default_rng(seed)
    columns = np.arange(width)
    rows = height * 0.4 + 9 * np.sin(columns / 17 + seed) + 4 * np.sin(columns / 6 + seed)
    truth = Skyline(np.round(rows))
    rocks = rng.uniform(20, 130, (height // 6, width // 6, 3))
    rocks = cv2.resize(rocks, (width, height), interpolation=cv2.INTER_NEAREST)
    photo = np.where(truth.to_mask(height)[:, :, None], (170, 190, 225), rocks)
    photo = cv2.GaussianBlur(photo, (0, 0), 0.6) + rng.normal(0, 1, photo.shape)
    return np.clip(photo, 0, 255).astype(np.uint8), truth


def lonely(height=60, width=90):
    """Like `mountains`, with so few edges off the line that every one of them is drawn."""
    columns = np.arange(width)
    truth = Skyline(np.round(22 + 4 * np.sin(columns / 8)))
    photo = np.where(truth.to_mask(height)[:, :, None], (170, 190, 225), (70, 75, 60))
    photo[45:52, 12:20] = (120, 110, 30)
    return cv2.GaussianBlur(photo.astype(np.uint8), (0, 0), 0.6), truth


def on_edges(photo, truth, config):
    """The positives of a reach above 0, pixel by pixel."""
    edges, _ = candidate_edges(photo, config.detector)
    pixels = []
    for column, row in enumerate(truth.rows.astype(int)):
        near = [one for one in np.flatnonzero(edges[:, column]) if abs(one - row) <= config.reach]
        if near:
            pixels.append((min(near, key=lambda one: (abs(one - row), one)), column, 255.0))
    return pixels


def slow_sums(photo, pixels, config):
    """Gram matrices of (row, column, target) samples, one by one."""
    size = config.filter_size
    length = size * size + 1
    sums = np.zeros((config.bins.count, length, length))
    samples = np.zeros(config.bins.count, int)
    grey = np.pad(to_grey(photo), size // 2, mode="edge")
    rows, columns = (np.array([pixel[axis] for pixel in pixels], np.int32) for axis in (0, 1))
    bins = config.bins.of(tensor_at(photo, rows, columns))
    for (row, column, target), own in zip(pixels, bins, strict=True):
        patch = grey[row : row + size, column : column + size].astype(float)
        sample = np.append(patch.ravel(), target)
        sums[own] += np.outer(sample, sample)
        samples[own] += 1
    return sums, samples


def sum_of_both(photo, pixels):
    """Gram matrices of samples and of their flipped twins, with `CONFIG`."""
    flipped = [(row, photo.shape[1] - 1 - column, target) for row, column, target in pixels]
    here = slow_sums(photo, pixels, CONFIG)
    there = slow_sums(np.ascontiguousarray(photo[:, ::-1]), flipped, CONFIG)
    return here[0] + there[0]


def all_pixels(photo, truth, config):
    """Every possible sample: the true line, and all edges away from it."""
    pixels = (
        on_edges(photo, truth, config)
        if config.reach
        else [
            (int(row), column, 255.0)
            for column, row in enumerate(truth.rows)
            if truth.visible[column]
        ]
    )
    edges, _ = candidate_edges(photo, config.detector)
    for row, column in zip(*edge_pixels(edges), strict=True):
        if truth.visible[column] and abs(row - truth.rows[column]) > config.band:
            pixels.append((int(row), int(column), 127.5))
    return pixels


def same_sums(one, other):
    return np.array_equal(one.sums, other.sums) and np.array_equal(one.samples, other.samples)


def shares(gram):
    """Sums over samples that together count for one."""
    return gram.sums / gram.samples.sum()


def targets(gram):
    """Numbers of positives and negatives, told from the sums of squared targets."""
    squares = gram.sums[:, -1, -1].sum()
    count = gram.samples.sum()
    positives = (squares - count * 127.5**2) / (255**2 - 127.5**2)
    return positives, count - positives
