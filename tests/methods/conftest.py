"""What tests of methods share: four rendered photos on the disk, and PyTorch on one thread."""

import pytest

from skyline_viz.datasets.layouts import open_dataset
from skyline_viz.rendering import render, write_scenes


@pytest.fixture(scope="session")
def items(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scenes")
    scenes = [render(kind, seed, 160, 96) for kind in ("clear", "hazy") for seed in (1, 2)]
    list(write_scenes(scenes, folder))
    return open_dataset(folder).items


@pytest.fixture
def one_thread():
    import torch  # noqa: PLC0415

    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield torch
    torch.set_num_threads(threads)
