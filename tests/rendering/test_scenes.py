"""Rendered scenes: the same bytes from the same seed, and a truth that lies on the drawn line."""

import io

import numpy as np
import pytest
from PIL import Image

from skyline_viz.photo import read_photo
from skyline_viz.rendering import KINDS, SAMPLES, picture, render, sample_scenes, write_scenes
from skyline_viz.rendering import scenes as rendering
from skyline_viz.rendering.camera import Camera
from skyline_viz.skyline import Skyline

WIDTH, HEIGHT = 320, 180
SAMPLED = tuple(dict.fromkeys(kind for kind, *_ in SAMPLES))


@pytest.fixture(scope="module")
def scenes():
    return {kind: render(kind, 1, WIDTH, HEIGHT) for kind in KINDS}


@pytest.mark.parametrize("kind", KINDS)
def test_equal_arguments_give_equal_bytes(scenes, kind):
    again = render(kind, 1, WIDTH, HEIGHT)
    assert again.jpeg == scenes[kind].jpeg
    assert again.truth == scenes[kind].truth


@pytest.mark.parametrize("kind", KINDS)
def test_another_seed_is_another_place(scenes, kind):
    other = render(kind, 2, WIDTH, HEIGHT)
    assert other.truth != scenes[kind].truth
    assert np.abs(other.photo.astype(int) - scenes[kind].photo).mean() > 2


@pytest.mark.parametrize("kind", KINDS)
def test_the_truth_is_whole_rows_inside_the_photo(scenes, kind):
    scene = scenes[kind]
    assert scene.photo.shape == (HEIGHT, WIDTH, 3)
    assert scene.photo.dtype == np.uint8
    assert scene.truth.width == WIDTH
    assert (scene.truth.rows == np.floor(scene.truth.rows)).all()
    rows = scene.truth.rows[scene.truth.visible]
    assert len(rows) > WIDTH / 2
    assert rows.min() >= 1
    assert rows.max() < HEIGHT
    if kind in SAMPLED:
        assert scene.truth.visible.all()
        assert rows.min() >= 3
        assert rows.max() < HEIGHT - 3


@pytest.mark.parametrize("kind", KINDS)
def test_the_photo_changes_more_at_the_truth_than_just_above_it(scenes, kind):
    scene = scenes[kind]
    grey = scene.photo.mean(axis=2)
    rows, columns = scene.truth.pixel_rows(HEIGHT), np.arange(WIDTH)

    def steps(shift):
        below, above = rows + 1 + shift, rows - 2 + shift
        ok = (above >= 0) & (below < HEIGHT)
        return np.abs(grey[below[ok], columns[ok]] - grey[above[ok], columns[ok]])

    assert steps(0).mean() > 1.4 * steps(-6).mean()


@pytest.mark.parametrize("kind", ["clear", "spires", "desert", "rover"])
def test_the_strongest_step_of_most_columns_is_within_a_pixel_of_the_truth(kind):
    scene = render(kind, 3, WIDTH, HEIGHT)
    rows = scene.truth.pixel_rows(HEIGHT)
    photo = scene.photo.astype(float)
    change = np.abs(np.diff(photo, axis=0)).sum(axis=2)  # [r] between r and r + 1
    near = np.stack([change[rows - 1 + shift, np.arange(WIDTH)] for shift in range(-3, 4)])
    assert np.mean(np.abs(near.argmax(axis=0) - 3) <= 1) > 0.6


def test_nothing_but_the_sky_lies_above_the_truth(monkeypatch):
    """With the terrain painted black before lens and film, the truth cuts black from sky."""
    exposed = {}

    def keep(camera, photo, *args, **options):
        exposed["photo"] = photo.copy()
        return original(camera, photo, *args, **options)

    def black(terrain, photo):
        terrain.colour[:] = 0
        return project(terrain, photo)

    original, project = Camera.expose, picture.project
    monkeypatch.setattr(Camera, "expose", keep)
    monkeypatch.setattr(picture, "project", black)
    for kind in (*SAMPLED, "blue", "overcast"):
        scene = render(kind, 4, WIDTH, HEIGHT)
        sky = scene.truth.to_mask(HEIGHT)
        brightness = exposed["photo"].min(axis=2)
        assert (brightness[~sky] < 0.5).all()
        above = np.roll(sky, 1, axis=0)
        assert (brightness[~sky & ~above & ~np.roll(above, 1, axis=0)] == 0).all()
        assert brightness[sky].min() > 0.02


def test_a_rover_sees_grey(scenes):
    photo = scenes["rover"].photo
    assert (photo == photo[..., :1]).all()
    assert Image.open(io.BytesIO(scenes["rover"].jpeg)).mode == "L"


def test_spires_are_steep():
    steps = np.abs(np.diff(render("spires", 1).truth.rows))
    assert (steps >= 10).sum() >= 5
    assert (steps > 1).mean() > 0.3


def test_the_desert_is_flat(scenes):
    assert np.ptp(scenes["desert"].truth.rows) < 0.2 * HEIGHT


def test_haze_and_snow_hide_the_line_that_clear_air_shows(scenes):
    def contrast(kind):
        photo, rows = scenes[kind].photo.astype(float), scenes[kind].truth.pixel_rows(HEIGHT)
        columns = np.arange(WIDTH)
        return np.median(np.abs(photo[rows + 2, columns] - photo[rows - 3, columns]).sum(axis=1))

    assert contrast("hazy") < 0.5 * contrast("clear")
    assert contrast("snow") < 0.7 * contrast("clear")
    assert contrast("hazy") > 3


def test_in_foreground_a_lower_line_is_stronger_than_the_skyline(scenes):
    scene = scenes["foreground"]
    change = np.abs(np.diff(scene.photo.astype(float).mean(axis=2), axis=0))
    rows = scene.truth.pixel_rows(HEIGHT)
    below = np.arange(HEIGHT - 1)[:, None] > rows + 4
    at_line = change[rows - 1, np.arange(WIDTH)]
    assert np.mean(np.where(below, change, 0).max(axis=0) > at_line) > 0.6


@pytest.mark.parametrize(
    ("kind", "width", "height"),
    [
        *((kind, *size) for kind in KINDS for size in ((64, 48), (40, 200), (200, 40))),
        ("clear", 32, 32),
        ("cloudy", 333, 777),
        ("desert", 801, 64),
    ],
)
def test_any_size_can_be_rendered(kind, width, height):
    scene = render(kind, 5, width, height)
    assert scene.photo.shape == (height, width, 3)
    assert scene.truth.rows.min() >= 0
    assert scene.truth.rows.max() <= height
    assert scene.truth.rows[scene.truth.visible].max(initial=0) < height


@pytest.mark.parametrize("kind", ["clear", "spires", "desert"])
def test_a_scene_keeps_its_shape_at_another_size(kind):
    small, large = render(kind, 1, 160, 90), render(kind, 1, 480, 270)
    from_large = large.truth.rows.reshape(160, 3).mean(axis=1) / 3
    assert np.abs(small.truth.rows - from_large).mean() < 2


@pytest.mark.parametrize("kind", KINDS)
def test_any_camera_takes_a_scene_that_has_another_name(kind):
    scene = render(kind, 6, 90, 60, camera="any")
    assert scene.name == f"{kind}-6-any"
    assert scene.photo.shape == (60, 90, 3)
    assert scene.truth.rows[scene.truth.visible].max(initial=0) < 60
    assert render(kind, 6, 90, 60, camera="any").jpeg == scene.jpeg
    assert render(kind, 6, 90, 60).jpeg != scene.jpeg


def test_cameras_differ_in_how_they_are_held():
    rows = [render("desert", seed, 90, 60, camera="any").truth.rows for seed in range(12)]
    falls = [abs(row[:10].mean() - row[-10:].mean()) for row in rows]
    middles = [row.mean() for row in rows]
    assert max(falls) > 10
    assert np.ptp(middles) > 15


def test_hikers_hide_the_line_and_do_not_move_it():
    hidden = 0
    for seed in range(8):
        scene = render("hikers", seed, 96, 64)
        hidden += np.count_nonzero(~scene.truth.visible)
        assert np.abs(np.diff(scene.truth.rows)).max() < 24
    assert hidden > 10


def test_scenes_are_frozen(scenes):
    scene = scenes["clear"]
    assert scene.name == "clear-1"
    with pytest.raises(ValueError, match="read-only"):
        scene.photo[0, 0] = 0


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("foggy", 1), "clear, hazy"),
        (("clear", -1), "0 or more"),
        (("clear", 1, 16, 100), "at least 32"),
    ],
)
def test_bad_arguments_are_refused(arguments, reason):
    with pytest.raises(ValueError, match=reason):
        render(*arguments)


def test_samples_are_written_the_same_every_time(tmp_path, monkeypatch):
    assert len(SAMPLES) == 12
    assert set(SAMPLED) == set(KINDS[:8])
    assert len({(kind, seed) for kind, seed, *_ in SAMPLES}) == 12
    small = tuple((kind, seed, 96, 64) for kind, seed, *_ in SAMPLES[:4])
    monkeypatch.setattr(rendering, "SAMPLES", small)
    photos = list(write_scenes(sample_scenes(), tmp_path / "a"))
    list(write_scenes(sample_scenes(), tmp_path / "b"))
    files = sorted(file for file in (tmp_path / "a").rglob("*") if file.is_file())
    assert len(files) == 8
    for file in files:
        assert (tmp_path / "b" / file.relative_to(tmp_path / "a")).read_bytes() == file.read_bytes()
    for path, (kind, seed, width, height) in zip(photos, small, strict=True):
        scene = render(kind, seed, width, height)
        assert path.name == f"{scene.name}.jpg"
        assert np.array_equal(read_photo(path), scene.photo)
        mask = np.array(Image.open(tmp_path / "a" / "masks" / f"{scene.name}.png"))
        assert set(np.unique(mask)) == {0, 255}
        assert Skyline.from_mask(mask == 0) == scene.truth
