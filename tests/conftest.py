"""What holds for all tests: nothing is kept in the home of whoever runs them."""

import pytest

from skyline_viz.cli import main
from skyline_viz.running.warming import warm_up
from testing.programs.commands import write_scenes


@pytest.fixture(autouse=True, scope="session")
def state_of_their_own(tmp_path_factory):
    """Addresses of folders are kept elsewhere, by this process and by those that it starts."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield


@pytest.fixture(autouse=True, scope="session")
def compiled():
    """The loops are there, and no test is the first to say that they are compiled."""
    warm_up()


@pytest.fixture(scope="session")
def hills(tmp_path_factory):
    """A data set of four photos with truth; nobody writes here."""
    return write_scenes(tmp_path_factory.mktemp("data") / "hills", 4)


@pytest.fixture
def say(tmp_path, monkeypatch, capsys):
    """Run a command line in an empty folder, without a browser: status, stdout, stderr."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("CI", "1")

    def run(*words):
        status = main([str(word) for word in words])
        printed = capsys.readouterr()
        assert "Traceback" not in printed.err
        return status, printed.out, printed.err

    return run
