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


@pytest.fixture
def s3(monkeypatch):
    """An S3 on this machine; its moods."""
    import s3fs  # noqa: PLC0415 - heavy, as moto is

    from testing.programs.s3 import s3 as started  # noqa: PLC0415

    monkeypatch.setattr(s3fs.S3FileSystem, "retries", 1)  # ours are looked at
    with started(monkeypatch) as moods:
        yield moods


@pytest.fixture
def memory():
    """A storage in memory, which is empty before and after."""
    import fsspec  # noqa: PLC0415 - few tests need it

    files = fsspec.filesystem("memory")
    yield files
    files.store.clear()
    files.pseudo_dirs[:] = [""]
