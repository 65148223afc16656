"""Fixtures of all commands."""

import pytest

from skyline_viz import rendering


@pytest.fixture
def _few_samples(monkeypatch):
    """Two small scenes instead of the samples, which take a while to render."""

    def scenes():
        for seed in (1, 2):
            yield rendering.render("clear", seed, 96, 64)

    monkeypatch.setattr(rendering, "sample_scenes", scenes)
