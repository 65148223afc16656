"""Who may call a server of this machine."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skyline_viz.system.loopback import allowed_hosts, called, policy, spelled, why_refused

ALLOWED = allowed_hosts("lab-pc")


@pytest.mark.parametrize("name", ["localhost", "127.0.0.1", "[::1]", "LOCALHOST", "lab-pc"])
@pytest.mark.parametrize("port", ["", ":80", ":9000"])  # that of a tunnel is another one
def test_its_own_page_is_answered(name, port):
    host = f"{name}{port}"
    for origin in (None, f"http://{host}", f"HTTP://{host}".upper()):
        assert why_refused([host], origin, ALLOWED) is None


@pytest.mark.parametrize(
    ("hosts", "origin", "status"),
    [
        ([], None, 421),
        ([""], None, 421),
        (["127.0.0.2:80"], None, 421),
        (["lab-pc.evil.example:80"], None, 421),
        (["localhost.:80"], None, 421),
        (["localhost:80:80"], None, 421),
        (["localhost:"], None, 421),
        (["evil.example@localhost"], None, 421),
        (["localhost:80", "localhost:80"], None, 421),
        (["localhost:80"], "null", 403),
        (["localhost:80"], "", 403),
        (["localhost:80"], "https://localhost:80", 403),
        (["localhost:80"], "http://localhost:81", 403),
        (["localhost:80"], "http://127.0.0.1:80", 403),
        (["localhost:80"], "http://lab-pc:80", 403),
        (["localhost:80"], "http://localhost:80/", 403),
    ],
)
def test_others_are_not(hosts, origin, status):
    assert why_refused(hosts, origin, ALLOWED)[0] == status


@given(st.text(), st.none() | st.text())
def test_no_other_name_and_no_other_origin_gets_in(host, origin):
    answered = why_refused([host], origin, ALLOWED) is None
    ours = called(host) in ALLOWED
    from_us = origin is None or origin.lower() == f"http://{host.lower()}"
    assert answered == (ours and from_us)


@given(st.sampled_from(sorted(ALLOWED)), st.integers(0, 65535), st.text(max_size=4))
def test_a_port_changes_no_name_and_nothing_else_belongs_to_it(name, port, more):
    assert called(f"{name}:{port}") == name
    assert called(f"{name}{more}") in {name, ""} or more[0] not in ":]"


@given(st.ip_addresses())
def test_an_address_is_spelled_as_a_browser_calls_it(address):
    assert called(f"{spelled(str(address))}:80") == spelled(address.exploded)


def test_a_server_that_listens_elsewhere_may_be_called_by_that_name_too():
    assert "10.0.0.1" in allowed_hosts("10.0.0.1")
    assert "[fe80::1]" in allowed_hosts("FE80::1")


def test_a_page_contacts_its_own_server_and_no_other():
    parts = dict(one.split(" ", 1) for one in policy("'wasm-unsafe-eval'", "blob:").split("; "))
    assert parts["default-src"] == parts["frame-ancestors"] == parts["form-action"] == "'none'"
    assert parts["connect-src"] == parts["style-src"] == "'self'"
    assert parts["script-src"] == "'self' 'wasm-unsafe-eval'"
    assert not any("http" in one or "*" in one for one in parts.values())
