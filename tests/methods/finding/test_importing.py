"""Classes of somebody's: from modules here, from packages, and what may go wrong with them."""

from importlib.metadata import EntryPoint

import pytest

import skyline_viz as sv
from skyline_viz.cli import main
from skyline_viz.method import MethodError
from skyline_viz.methods.finding import importing, plugins
from skyline_viz.methods.finding.method_files import load_method, save_method
from testing.methods import own_folder, write_module

DROP = """
class Drop:
    name = "drop"

    def __init__(self, blur: float = 2.0):
        self.blur = blur

    def detect(self, photo):
        return [3] * photo.shape[1]
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    with own_folder(tmp_path, monkeypatch) as folder:
        yield folder


@pytest.mark.parametrize(
    ("code", "says"),
    [
        ("x = (", r"mine:Mine failed in mine.py, line 1: SyntaxError"),
        ("import sys\n1 / 0", r"mine:Mine failed in mine.py, line 2: ZeroDivisionError"),
        ("import nothing_there", r"failed in mine.py, line 1: ModuleNotFoundError: No module"),
        ("class Min: pass", r"mine has no class Mine; did you mean Min\?"),
        ("class Mine: pass", r"mine:Mine is no method: it has no detect\(photo\)"),
        ("Mine = 3", r"mine:Mine is no method"),
        (
            "class Mine:\n    detect = print\n    def __init__(self):\n        raise KeyError('k')",
            r"mine:Mine failed in mine.py, line 4: KeyError: 'k'",
        ),
    ],
)
def test_a_module_that_fails_is_one_sentence_with_the_line(here, code, says, capsys):
    place = write_module(here, code)
    with pytest.raises(MethodError, match=says):
        sv.find_method(place)
    assert main(["detect", "a.jpg", "--method", place]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_an_installed_package_offers_a_method_by_name(here, monkeypatch):
    write_module(here, DROP, "drop")
    point = EntryPoint("darker", "drop:Drop", importing.GROUP)
    monkeypatch.setattr(importing, "entry_points", lambda group: [point])
    assert sv.find_method("darker:blur=6").inner.blur == 6.0
    with pytest.raises(MethodError, match=r"did you mean darker\?"):
        sv.find_method("darkr")
    save_method(sv.find_method("darker"), here / "m.npz")
    monkeypatch.setattr(plugins, "_named", set())
    assert load_method(here / "m.npz").name == "drop"
