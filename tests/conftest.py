"""What holds for all tests: nothing is kept in the home of whoever runs them."""

import pytest


@pytest.fixture(autouse=True, scope="session")
def state_of_their_own(tmp_path_factory):
    """Addresses of folders are kept elsewhere, by this process and by those that it starts."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield
