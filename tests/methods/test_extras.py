"""Packages of extras: imported when needed, and named when they are missing."""

import sys

import pytest

from skyline_viz.method import MethodError
from skyline_viz.methods.extras import needed


def test_a_module_that_is_there_is_returned():
    import json  # noqa: PLC0415

    assert needed("json", "methods", "x") is json


@pytest.mark.parametrize(("module", "package"), [("sklearn.svm", "scikit-learn"), ("a.b", "a")])
def test_a_missing_package_is_named_with_its_extra(module, package, monkeypatch):
    for name in ("sklearn", "sklearn.svm"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(MethodError) as caught:
        needed(module, "methods", "svm-dcsi")
    assert str(caught.value).startswith(f"svm-dcsi needs {package} to be trained; install it with")
    assert "skyline-viz[methods]" in str(caught.value)
