r"""Training: Gram matrices gathered photo by photo, then one small linear system a bin.

The filter of a bin solves a regularised linear regression (equation 17 of the paper). The rows of
$\mathbf{A}$ are patches, $\mathbf{b}$ holds their targets, $\mathbf{Q}$ keeps the filter smooth:

$$
\mathbf{h} = (\mathbf{Q} + \mathbf{A}^T \mathbf{A})^{-1} \mathbf{A}^T \mathbf{b}
$$

A Gram matrix is a plain sum over training samples (equations 18 and 19), so the work can be spread
over photos, processes and machines and added up. Patches are whole numbers and targets whole or
half ones, so the float64 sums are exact: the order of adding does not matter.

Many bins see few samples. Ours, not the paper's: each bin also takes the samples of all bins of its
orientation $o$, $N_o$ in number, scaled down so that together they count for $k$ samples:

$$
\mathbf{h} = \left(\mathbf{Q} + \mathbf{A}^T \mathbf{A}
+ \frac{k}{N_o} \mathbf{A}_o^T \mathbf{A}_o\right)^{-1}
\left(\mathbf{A}^T \mathbf{b} + \frac{k}{N_o} \mathbf{A}_o^T \mathbf{b}_o\right)
$$
"""

import math
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from operator import add

import numpy as np
import numpy.typing as npt

from skyline_viz._version import __version__
from skyline_viz.arrays import F64, U8, Bool, Int, check_photo
from skyline_viz.bins import Bins
from skyline_viz.config import TrainingConfig
from skyline_viz.datasets.item import Item, photo_and_truth
from skyline_viz.edges import candidate_edges, edge_pixels, to_grey
from skyline_viz.filter_bank import FilterBank, Provenance
from skyline_viz.skyline import Skyline, SkylineError
from skyline_viz.system.fingerprints import fingerprint, telling
from skyline_viz.tensor import tensor_at

POSITIVE_TARGET = 255.0
"""What a filter should give on the skyline."""

NEGATIVE_TARGET = 127.5
"""What a filter should give on other edges."""


@dataclass(frozen=True)
class GramMatrices:
    """Sums over training samples, bin by bin; two of them add up."""

    sums: F64
    """``(K, n * n + 1, n * n + 1)`` sums of outer products of (patch, target)."""

    samples: npt.NDArray[np.int64]
    """``(K,)`` number of samples, flipped ones included."""

    weights: F64
    """``(K,)`` for how many samples they count; see `together`."""

    images: int
    """Number of photos."""

    seen: tuple[str, ...] = ()
    """Fingerprints of the photos."""

    def cropped(self, size: int) -> "GramMatrices":
        """Sums for smaller filters: the middle of a patch is a patch, and its sums are in there.

        Args:
            size: Pixels a side of the smaller filter.
        """
        own = math.isqrt(self.sums.shape[1] - 1)
        rim = (own - size) // 2
        taps = np.arange(own * own).reshape(own, own)[rim : own - rim, rim : own - rim]
        kept = np.append(taps, own * own)  # and the target
        return replace(self, sums=self.sums[:, kept[:, None], kept])

    def counted(self, factor: float) -> "GramMatrices":
        """The same samples, each of which counts `factor` times."""
        return replace(self, sums=self.sums * factor, weights=self.weights * factor)

    @classmethod
    def empty(cls, config: TrainingConfig) -> "GramMatrices":
        """Sums over no sample."""
        length = config.filter_size**2 + 1
        count = config.bins.count
        sums = np.zeros((count, length, length))
        return cls(sums, np.zeros(count, np.int64), np.zeros(count), 0)

    def __add__(self, other: "GramMatrices") -> "GramMatrices":
        """Sums over both sets of samples."""
        return GramMatrices(
            self.sums + other.sums,
            self.samples + other.samples,
            self.weights + other.weights,
            self.images + other.images,
            self.seen + other.seen,
        )


def train(
    examples: Iterable[tuple[U8, Skyline]],
    seed: int = 0,
    config: TrainingConfig | None = None,
    dataset: str = "",
) -> FilterBank:
    """Learn a filter bank from photos and their true skylines.

    Args:
        examples: Pairs of a photo ``(H, W, 3)`` uint8 RGB and its skyline; read one at a time.
        seed: Seed of the negative samples; the same seed and examples give the same bank.
        config: How samples are drawn and filters are solved.
        dataset: Name for the bank's provenance.

    Raises:
        ValueError: No example, or one whose photo and skyline differ in width.

    Examples:
        Every column is a positive sample, once as it is and once flipped.

        >>> photo = np.full((40, 60, 3), 200, np.uint8)
        >>> photo[25:] = 60
        >>> bank = train([(photo, Skyline(rows=np.full(60, 25)))])
        >>> int(bank.samples.sum())
        120
    """
    config = config or TrainingConfig()
    gram = GramMatrices.empty(config)
    for photo, truth in examples:
        gram += gather(photo, truth, seed, config)
    if gram.images == 0:
        raise ValueError("training needs at least one photo with a true skyline")
    return solve(gram, seed, config, dataset)


def gather(
    photo: U8, truth: Skyline, seed: int, config: TrainingConfig, name: str = ""
) -> GramMatrices:
    """Gram matrices of one photo.

    Positives are the edge pixels on the true line, or its pixels as they are with a reach of 0.
    Negatives are as many edge pixels away from it. All of them count a second time, flipped
    left-right.

    Args:
        photo: ``(H, W, 3)`` uint8 RGB.
        truth: Its true line.
        seed: Seed of the negatives.
        config: What is learned, and how.
        name: What the photo is called, which may tell of its clip, see `fingerprint`.

    Raises:
        SkylineError: The photo and the truth differ in width.
    """
    check_photo(photo)
    height, width = photo.shape[:2]
    if truth.width != width:
        raise SkylineError(f"the truth has {truth.width} columns, the photo {width}")
    truth_rows = truth.pixel_rows(height).astype(np.int32)
    columns = np.flatnonzero(truth.visible & (truth_rows < height)).astype(np.int32)
    rows = truth_rows[columns]
    edges, _ = candidate_edges(photo, config.detector)
    if config.reach:
        rows, columns = _on_edges(edges, rows, columns, config.reach)
    edge_rows, edge_columns = edge_pixels(edges)
    off_line = np.abs(edge_rows - truth_rows[edge_columns]) > config.band
    negatives = np.flatnonzero(off_line & truth.visible[edge_columns])
    # the draw depends on the photo, not on its place in the list: halves add up to the whole
    rng = np.random.default_rng([seed, zlib.crc32(photo.tobytes())])
    drawn = rng.permutation(negatives)[: len(rows)]
    rows = np.concatenate([rows, edge_rows[drawn]])
    targets = np.repeat([POSITIVE_TARGET, NEGATIVE_TARGET], [len(columns), len(drawn)])
    columns = np.concatenate([columns, edge_columns[drawn]])
    index = config.bins.of(tensor_at(photo, rows, columns))
    patches = _patches(to_grey(photo), rows, columns, config.filter_size)
    sums, samples = _summed(np.column_stack([patches, targets]), index, config.bins)
    return GramMatrices(sums, samples, samples.astype(np.float64), 1, (fingerprint(photo, name),))


def gather_item(config: TrainingConfig, seed: int, item: Item) -> GramMatrices:
    """Gram matrices of a photo of a data set.

    Raises:
        PhotoError: The photo cannot be read.
        SkylineError: It has no truth, or one that does not fit.
    """
    return gather(*photo_and_truth(item), seed, config, item.name)


def together(datasets: Sequence[GramMatrices]) -> GramMatrices:
    """Sums over several data sets, of which each counts as much as each other one.

    A data set is a camera and a kind of landscape, and its photos resemble each other: more of
    them, or larger ones, say less than their number. All count together for as many samples as
    they are. One data set alone stays as it is.

    Args:
        datasets: Sums over each data set, at least one; those without a sample do not count.
    """
    sizes = [int(one.samples.sum()) for one in datasets]
    share = sum(sizes) / max(1, sum(size > 0 for size in sizes))
    return reduce(
        add,
        [
            one.counted(share / size) if size else one
            for one, size in zip(datasets, sizes, strict=True)
        ],
    )


def solve(gram: GramMatrices, seed: int, config: TrainingConfig, dataset: str = "") -> FilterBank:
    """Filters of all bins (equation 17), each drawn towards that of all bins of its orientation.

    Args:
        gram: Sums over all training photos.
        seed: Seed with which they were gathered, for the provenance.
        config: The same as for `gather`.
        dataset: Name for the provenance.

    Raises:
        ValueError: There is not a single sample.
    """
    if gram.samples.sum() == 0:
        raise ValueError("training needs at least one photo with a visible true skyline")
    share = config.pooling / np.maximum(pooled(gram.weights, config.bins), 1.0)
    sums = gram.sums + share[:, None, None] * pooled(gram.sums, config.bins)
    return FilterBank(
        filters=regress(sums, config.smoothness).astype(np.float32),
        samples=gram.samples,
        bins=config.bins,
        seen=tuple(sorted({*telling(gram.seen)})),
        provenance=Provenance(
            dataset=dataset,
            images=gram.images,
            seed=seed,
            edges=config.detector.edge_source,
            reach=config.reach,
            smoothness=config.smoothness,
            pooling=config.pooling,
            package=__version__,
            detector=config.detector,
        ),
    )


def regress(sums: F64, smoothness: float) -> F64:
    """Filters ``(K, n, n)`` that solve the regularised least squares of each Gram matrix."""
    size = math.isqrt(sums.shape[1] - 1)
    # a trace of the unit matrix keeps a bin without any sample solvable: its filter is zero
    regulariser = smoothness * smoothness_form(size) + 1e-3 * np.eye(size * size)
    system = sums[:, :-1, :-1] + regulariser
    filters = np.linalg.solve(system, sums[:, :-1, -1:])
    return filters.reshape(-1, size, size).astype(np.float64, copy=False)


def pooled(sums: F64, bins: Bins, over: tuple[int, ...] = (0, 1)) -> F64:
    """Sums in which each bin holds that of all bins which differ from it in `over`.

    Args:
        sums: ``(K, ...)``.
        bins: Their bins.
        over: 0 pools coherence, 1 strength, 2 orientation.
    """
    grid = sums.reshape(*bins.shape, *sums.shape[1:])
    return np.broadcast_to(grid.sum(axis=over, keepdims=True), grid.shape).reshape(sums.shape)


def smoothness_form(size: int) -> F64:
    """``Q``: the sum of squared differences of neighbouring taps, ``(n * n, n * n)``.

    Examples:
        A filter whose taps are all alike is perfectly smooth.

        >>> smoothness_form(3) @ np.ones(9)
        array([0., 0., 0., 0., 0., 0., 0., 0., 0.])
    """
    line = np.diff(np.eye(size), axis=0)
    chain = line.T @ line  # Laplacian of taps in a row
    return np.kron(chain, np.eye(size)) + np.kron(np.eye(size), chain)


def _on_edges(edges: Bool, rows: Int, columns: Int, reach: int) -> tuple[Int, Int]:
    """The edge pixels nearest to others in their columns; pixels without one are left out."""
    steps = np.array(sorted(range(-reach, reach + 1), key=abs), np.int32)
    near = rows[:, None] + steps
    inside = (near >= 0) & (near < len(edges))
    hit = inside & edges[np.clip(near, 0, len(edges) - 1), columns[:, None]]
    found = np.flatnonzero(hit.any(axis=1))
    return near[found, hit[found].argmax(axis=1)], columns[found]


def _summed(samples: F64, index: Int, bins: Bins) -> tuple[F64, npt.NDArray[np.int64]]:
    """Gram matrices of samples ``(m, n * n + 1)`` and of their left-right flipped twins.

    Flipping permutes the taps of a patch and moves its bin to the mirrored one, nothing else.
    """
    length = samples.shape[1]
    sums = np.zeros((bins.count, length, length))
    order = np.argsort(index, kind="stable")
    found, starts = np.unique(index[order], return_index=True)
    counts = np.bincount(index, minlength=bins.count)
    size = math.isqrt(length - 1)
    taps = np.append(np.arange(size * size).reshape(size, size)[:, ::-1].ravel(), size * size)
    mirrored = bins.mirrored()
    for bin_index, members in zip(found, np.split(order, starts[1:]), strict=False):
        product = samples[members].T @ samples[members]
        sums[bin_index] += product
        sums[mirrored[bin_index]] += product[taps[:, None], taps]
    return sums, counts + counts[mirrored]


def _patches(grey: U8, rows: Int, columns: Int, size: int) -> F64:
    """Patches around pixels as rows of a matrix, ``(m, n * n)``; the border is repeated."""
    padded = np.pad(grey, size // 2, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (size, size))
    return windows[rows, columns].reshape(len(rows), size * size).astype(np.float64)
