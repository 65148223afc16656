"""Packages of extras: imported when needed, and named when they are missing."""

import sys

import pytest

from skyline_viz.method import MethodError
from skyline_viz.methods import extras
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
    assert f"-m pip install {package}" in str(caught.value).replace("'", "")


def test_the_versions_are_those_of_the_extra(monkeypatch):
    wanted = ["numpy>=1", "torch>=2.4; extra == 'deep'", "torch-vision>=1; extra == 'methods'"]
    monkeypatch.setattr(extras, "requires", lambda _: wanted)
    monkeypatch.setitem(sys.modules, "torch", None)
    monkeypatch.setattr(sys, "executable", "/a place/python")
    with pytest.raises(MethodError, match=r"'/a place/python' -m pip install 'torch>=2\.4'$"):
        needed("torch", "deep", "fcn-8s")
    with pytest.raises(MethodError, match=r"pip install torch$"):
        needed("torch", "methods", "fcn-8s")
