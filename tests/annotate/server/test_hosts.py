"""Names by which the labelling server may be called: those of the machine, and no other one."""

import socket

import pytest
from hypothesis import given
from hypothesis import strategies as st

from annotate.server import hosts
from annotate.server.hosts import arrived_at, is_loopback, is_name, names_for, to_be_told, tunnel
from skyline_viz.system.loopback import allowed_hosts


@pytest.fixture(autouse=True)
def machine(monkeypatch):
    monkeypatch.setattr(socket, "gethostname", lambda: "Lab-PC.example.org")
    monkeypatch.setattr(socket, "getfqdn", lambda: "www.example.org")


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1"])
def test_what_listens_on_loopback_is_called_so_alone(host):
    assert is_loopback(host)
    assert names_for(host) == allowed_hosts()
    assert names_for(host, ["Lab.example"]) == allowed_hosts("lab.example")


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.0.2.7"])
def test_what_others_reach_is_called_by_every_name_of_the_machine(host):
    assert not is_loopback(host)
    own = {"lab-pc.example.org", "lab-pc", "lab-pc.local", "www.example.org"}
    assert own <= names_for(host)
    assert "other.example.org" not in names_for(host)
    assert "other.example.org" in names_for(host, ["other.example.org"])


def test_a_machine_without_a_name_has_none(monkeypatch):
    monkeypatch.setattr(socket, "gethostname", lambda: "")
    assert "" not in names_for("0.0.0.0")


@pytest.mark.parametrize(
    ("server", "names"),
    [
        (("192.0.2.7", 80), {"192.0.2.7"}),
        (("::ffff:192.0.2.7", 80), {"192.0.2.7"}),
        (("FE80::1", 80), {"[fe80::1]"}),
        (("evil.example", 80), set()),  # no address: somebody else's word
        (("/a/socket", None), set()),
        (None, set()),
    ],
)
def test_the_address_at_which_a_request_arrives_is_one_of_the_machine(server, names):
    assert arrived_at({"server": server}) == names


def test_the_address_that_others_see_is_told():
    assert to_be_told("192.0.2.7") == "192.0.2.7"
    assert to_be_told("::1") == "[::1]"
    assert to_be_told("Lab-PC") == "lab-pc"
    assert to_be_told("0.0.0.0") not in ("0.0.0.0", "", "127.0.0.1")


def test_a_machine_without_a_network_is_told_by_its_name(monkeypatch):
    monkeypatch.setattr(hosts, "_ELSEWHERE", dict.fromkeys(hosts._ELSEWHERE, "no address"))
    assert to_be_told("0.0.0.0") == to_be_told("::") == "Lab-PC.example.org"


def test_a_tunnel_leads_to_where_the_server_listens():
    told = tunnel("127.0.0.1", 8000)
    assert told == "ssh -N -L 8000:127.0.0.1:8000 Lab-PC.example.org"


@given(st.text(max_size=20))
def test_a_name_can_be_told_in_a_header_and_on_a_page(text):
    if is_name(text):
        assert not set(text) & set("<>&\"' /@")
        assert text.isascii()
    assert not is_name(f"{text}:80") or ":" in text
