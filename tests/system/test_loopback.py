"""Who may call a server of this machine."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.system.loopback import allowed_hosts, policy, why_refused

ALLOWED = allowed_hosts("127.0.0.1", 80)


@pytest.mark.parametrize("host", ["localhost:80", "127.0.0.1:80", "[::1]:80", "LOCALHOST:80"])
@pytest.mark.parametrize("origin", [None, "http://localhost:80", "HTTP://127.0.0.1:80"])
def test_its_own_page_is_answered(host, origin):
    assert why_refused([host], origin, ALLOWED) is None


@pytest.mark.parametrize(
    ("hosts", "origin", "status"),
    [
        ([], None, 421),
        ([""], None, 421),
        (["localhost"], None, 421),
        (["localhost:81"], None, 421),
        (["localhost:80", "localhost:80"], None, 421),
        (["localhost:80"], "null", 403),
        (["localhost:80"], "", 403),
        (["localhost:80"], "https://localhost:80", 403),
        (["localhost:80"], "http://localhost:81", 403),
        (["localhost:80"], "http://localhost:80/", 403),
    ],
)
def test_others_are_not(hosts, origin, status):
    assert why_refused(hosts, origin, ALLOWED)[0] == status


@given(st.text(), st.none() | st.text())
def test_no_other_name_and_no_other_origin_gets_in(host, origin):
    answered = why_refused([host], origin, ALLOWED) is None
    ours = host.lower() in ALLOWED
    from_us = origin is None or origin.lower() in {f"http://{one}" for one in ALLOWED}
    assert answered == (ours and from_us)


def test_a_server_that_listens_elsewhere_may_be_called_by_that_name_too():
    assert "10.0.0.1:8000" in allowed_hosts("10.0.0.1", 8000)
    assert "[fe80::1]:8000" in allowed_hosts("FE80::1", 8000)


def test_a_page_contacts_its_own_server_and_no_other():
    parts = dict(one.split(" ", 1) for one in policy("'wasm-unsafe-eval'", "blob:").split("; "))
    assert parts["default-src"] == parts["frame-ancestors"] == parts["form-action"] == "'none'"
    assert parts["connect-src"] == parts["style-src"] == "'self'"
    assert parts["script-src"] == "'self' 'wasm-unsafe-eval'"
    assert not any("http" in one or "*" in one for one in parts.values())
