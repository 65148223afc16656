"""What a cluster needs: the same versions everywhere."""

import pytest

from skyline_viz.running.clusters import requirements as module
from skyline_viz.running.clusters.requirements import ClusterError


def test_a_cluster_of_other_versions_is_refused():
    told = {"tcp://w:1": {**module.versions(), "skyline-viz": "0.0"}}
    with pytest.raises(ClusterError, match=r"^the worker tcp://w:1 has skyline-viz 0\.0, and this"):
        module.check(told)
    missing = ModuleNotFoundError("No module named 'skyline_viz'", name="skyline_viz")
    with pytest.raises(ClusterError, match=r"^the worker tcp://w:1 has no skyline_viz; install"):
        module.check({"tcp://w:1": missing})


def test_a_worker_says_so_where_a_program_has_other_versions():
    module.check_here(module.versions())
    with pytest.raises(ClusterError, match=r"^a worker has numpy .*, and this program 1\.0; "):
        module.check_here({**module.versions(), "numpy": "1.0"})
