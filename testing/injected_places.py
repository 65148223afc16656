"""What draws a path off its skyline, painted into photos: clouds, haze, wires, snow, frames."""

import numpy as np

_SMOOTH = 31  # columns over which a hand-drawn line changes


def span(random, width, least, most):
    """First and last column of a span."""
    length = int(random.integers(least, most))
    first = int(random.integers(30, width - 30 - length))
    return first, first + length - 1


def cloud_above(random, photo, truth):
    """A dark cloud rests on the ridge: its top is a stronger edge than the ridge below it."""
    columns, line, ground = lines(random, photo, truth, -1)
    pale = ground.mean(axis=1, keepdims=True) + random.integers(22, 36) + np.zeros(3)
    return painted(photo, columns, line, truth.rows, pale), columns


def haze(random, photo, truth):
    """The far ridge has nearly the colour of the sky, down to a near one that is dark."""
    columns, line, ground = lines(random, photo, truth, 1)
    pale = sky_above(photo, truth) - random.integers(2, 8)
    hidden = painted(sharp(photo, truth, columns), columns, truth.rows, line, pale)
    return painted(hidden, columns, line, line + 25, ground * 0.4), columns


def wire(random, photo, truth):
    """A dark wire hangs over the ridge."""
    columns, line, _ = lines(random, photo, truth, -1)
    thick = int(random.integers(2, 5))
    return painted(photo, columns, line, line + thick, np.full(3, 15.0)), columns


def snow(random, photo, truth):
    """Snow under a pale blue sky, down to dark rock."""
    columns, line, ground = lines(random, photo, truth, 1)
    first, last = columns
    blue = np.array([165.0, 192.0, 226.0]) + random.integers(-8, 8)
    white = np.full(3, 206.0) + random.integers(-6, 6)
    above = painted(photo, (first - 12, last + 12), truth.rows - 400, truth.rows, blue)
    snowy = painted(above, columns, truth.rows, line, white)
    return painted(snowy, columns, line, line + 25, ground * 0.3), columns


def frame(random, photo, truth):
    """A white bar above a picture with little contrast."""
    deep = float(random.uniform(0.06, 0.16)) * len(photo)
    deep = min(deep, float(truth.rows.min()) - 12)
    columns = 0, truth.width - 1
    none = np.zeros(truth.width)
    share = float(random.uniform(0.6, 0.8))
    sky = sky_above(photo, truth)[None]
    pale = (photo * (1 - share) + sky * share).round().astype(np.uint8)
    return painted(pale, columns, none, none + deep, np.full(3, 251.0)), columns


def foreground_ridge(random, photo, truth):
    """A pale ridge behind a dark one."""
    columns, line, ground = lines(random, photo, truth, 1)
    pale = sky_above(photo, truth) - random.integers(20, 34)
    far = painted(sharp(photo, truth, columns), columns, truth.rows, line, pale)
    return painted(far, columns, line, line + 25, ground * 0.4), columns


PAINTERS = {
    "cloud above": cloud_above,
    "haze": haze,
    "wire": wire,
    "snow": snow,
    "frame": frame,
    "foreground ridge": foreground_ridge,
}


def lines(random, photo, truth, side):
    """A span, a line beside the ridge that leaves it there and comes back, and the ground's colour.

    Args:
        random: Where its form is drawn from.
        photo: The photo.
        truth: Its ridge.
        side: -1 for a line above the ridge, 1 for one below.
    """
    first, last = span(random, truth.width, 120, 280)
    away = int(random.integers(24, 48))
    at = np.arange(truth.width)
    ends = np.clip(np.minimum(at - first, last - at) / (away / 2), 0, 1)
    waves = np.convolve(random.normal(0, 8, truth.width + _SMOOTH - 1), np.ones(_SMOOTH) / _SMOOTH)
    line = truth.rows + side * ends * (away + waves[_SMOOTH // 2 :][: truth.width])
    return (first, last), np.clip(line, 6, len(photo) - 8), ground_below(photo, truth)


def painted(photo, columns, top, bottom, colour):
    """A photo with one colour, a little noisy, between two lines in some columns."""
    changed = photo.copy()
    noise = np.random.default_rng(len(photo)).integers(-2, 3, photo.shape)
    for column in range(max(columns[0], 0), min(columns[1] + 1, photo.shape[1])):
        rows = slice(max(round(float(top[column])), 0), max(round(float(bottom[column])), 0))
        fill = colour if np.ndim(colour) == 1 else colour[column]
        changed[rows, column] = (fill + noise[rows, column]).clip(0, 255)
    return changed


def sharp(photo, truth, columns):
    """A photo without the soft fringe that its ridge has in the sky."""
    return painted(photo, columns, truth.rows - 4, truth.rows, sky_above(photo, truth))


def sky_above(photo, truth):
    """``(W, 3)`` colour of the sky above the ridge, smooth along it."""
    return smooth(photo, truth.rows.astype(int), range(-9, -3))


def ground_below(photo, truth):
    """``(W, 3)`` colour of the ground below the ridge, smooth along it."""
    return smooth(photo, truth.rows.astype(int), range(4, 16))


def smooth(photo, rows, offsets):
    """``(W, 3)`` mean colour beside a line."""
    at = np.arange(len(rows))
    mean = np.mean([photo[(rows + off).clip(0, len(photo) - 1), at] for off in offsets], axis=0)
    wide = np.pad(mean, ((20, 20), (0, 0)), mode="edge")
    return np.stack([np.convolve(one, np.full(41, 1 / 41), mode="valid") for one in wide.T], axis=1)
