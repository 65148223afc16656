"""What causes cost, as a picture."""

from skyline_viz.evaluation.cause_bars import MOST, CauseBar, write_cause_bars
from skyline_viz.photo import read_photo


def picture(folder, count):
    file = folder / f"{count}.png"
    bars = [CauseBar(f"cause {at}", at, 9.0 / at, "v $ 1") for at in range(1, count + 1)]
    write_cause_bars(file, bars, "a $ set")
    return read_photo(file)


def test_each_cause_has_a_bar_up_to_a_number(tmp_path):
    heights = [len(picture(tmp_path, count)) for count in (1, 3, MOST, MOST + 5)]
    assert heights[0] < heights[1] < heights[2] == heights[3]


def test_the_first_bar_stands_out(tmp_path):
    drawn = picture(tmp_path, 2)
    magenta = (drawn == (0xFF, 0x2D, 0x95)).all(axis=2)
    grey = (drawn == (0x59, 0x59, 0x59)).all(axis=2)
    assert magenta.any(axis=0).sum() > 1.5 * grey.any(axis=0).sum() > 0


def test_a_data_set_without_a_cause_is_an_empty_picture(tmp_path):
    assert picture(tmp_path, 0).std() < 60
