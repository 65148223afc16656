"""What several labels of a photo have in common."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from annotate.agreement.consensus import common
from testing.examples import examples
from testing.labels import made

WIDTH = 12
lines = st.lists(
    st.tuples(
        st.lists(st.integers(0, 9), min_size=WIDTH, max_size=WIDTH),
        st.lists(st.sampled_from([True, True, True, False]), min_size=WIDTH, max_size=WIDTH),
        st.lists(st.integers(0, 3), min_size=WIDTH, max_size=WIDTH),
    ),
    min_size=1,
    max_size=5,
)


def labels_of(told):
    return [
        made(rows, f"p{place}", visible=np.array(visible), origin=origin)
        for place, (rows, visible, origin) in enumerate(told)
    ]


def inside(found):
    """Columns in which they do not agree."""
    mask = np.zeros(WIDTH, bool)
    for first, last in found.apart:
        mask[first : last + 1] = True
    return mask


@examples(300)
@given(lines, st.integers(0, 4))
def test_where_they_agree_it_is_their_median_and_elsewhere_somebodys_line(told, within):
    labels = labels_of(told)
    found = common(labels, within)
    rows = np.array([one.skyline.rows for one in labels])
    visible = np.array([one.skyline.visible for one in labels])
    line, apart = found.line.skyline, inside(found)
    alike = visible.all(axis=0) & (np.ptp(rows, axis=0) <= within) | ~visible.any(axis=0)
    np.testing.assert_array_equal(apart, ~alike)
    np.testing.assert_array_equal(line.rows[alike], np.floor(np.median(rows, axis=0) + 0.5)[alike])
    np.testing.assert_array_equal(line.visible[alike], visible.all(axis=0)[alike])
    for first, last in found.apart:
        span = slice(first, last + 1)
        assert any(
            np.array_equal(line.rows[span], one.skyline.rows[span])
            and np.array_equal(line.visible[span], one.skyline.visible[span])
            for one in labels
        )


@examples(300)
@given(lines, st.integers(0, 4))
def test_each_column_has_the_origin_of_a_label_that_agrees(told, within):
    labels = labels_of(told)
    found = common(labels, within)
    for column in range(WIDTH):
        far = [abs(one.skyline.rows[column] - found.line.skyline.rows[column]) for one in labels]
        origins = {
            int(one.origin[column])
            for one, away in zip(labels, far, strict=True)
            if away <= max(within, min(far))
        }
        assert int(found.line.origin[column]) in origins
        assert (found.line.origin[column] == 0) == (origins == {0})  # nobody has changed it


@examples(100)
@given(lines, st.integers(0, 4), st.randoms())
def test_the_order_of_labels_does_not_matter_where_they_agree(told, within, random):
    labels = labels_of(told)
    found = common(labels, within)
    random.shuffle(labels)
    again = common(labels, within)
    assert again.apart == found.apart
    alike = ~inside(found)
    np.testing.assert_array_equal(again.line.skyline.rows[alike], found.line.skyline.rows[alike])


def test_one_label_alone_is_the_consensus():
    label = made([3, 4, 5])
    found = common([label])
    assert found.line.skyline == label.skyline
    assert (found.apart, found.worst) == ((), 0.0)


def test_of_three_the_two_that_agree_make_the_line_between():
    far = np.full(1000, 10)
    far[500:600] = 300
    found = common([made(far, "bob"), made([10] * 1000), made([11] * 1000, "eve")])
    assert found.apart == ((500, 599),)
    assert found.worst == 290
    assert found.line.skyline.rows.max() <= 11


def test_differences_near_each_other_are_one_span():
    other = np.full(1000, 10)
    other[500:510], other[515:520], other[600] = 90, 90, 90
    assert common([made([10] * 1000), made(other, "bob")]).apart == ((500, 519), (600, 600))
