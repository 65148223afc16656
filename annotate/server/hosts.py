"""By which names the labelling server may be called, and what to tell other machines.

Another website can make its own name point to this machine (DNS rebinding), and no more than that.
So every other name is refused: those of loopback are known, those of the machine are asked for, and
the address at which a request arrives is one of the machine.
"""

from __future__ import annotations

import re
import socket
from collections.abc import Iterable, Mapping
from ipaddress import ip_address
from typing import Any

from skyline_viz.system.loopback import allowed_hosts, spelled

_NAME = re.compile(r"(?!-)[A-Za-z0-9_-]{1,63}(\.[A-Za-z0-9_-]{1,63})*")
_ELSEWHERE = {socket.AF_INET: "192.0.2.1", socket.AF_INET6: "2001:db8::1"}  # of no machine


def is_name(text: str) -> bool:
    """Whether something is the name or the address of a machine, without a port.

    >>> [is_name(one) for one in ("lab.example.org", "::1", "lab:80", "http://lab", "*")]
    [True, True, False, False, False]
    """
    return bool(_NAME.fullmatch(text)) or _is_address(text)


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches what listens there.

    >>> [is_loopback(one) for one in ("127.0.0.1", "localhost", "::1", "0.0.0.0", "10.0.0.1")]
    [True, True, True, False, False]
    """
    return host.lower() == "localhost" or (_is_address(host) and ip_address(host).is_loopback)


def names_for(host: str, others: Iterable[str] = ()) -> frozenset[str]:
    """Names under which a server may be called.

    Args:
        host: Where it listens.
        others: More names.
    """
    names = [host, *others]
    if not is_loopback(host):
        own = socket.gethostname()
        short = own.partition(".")[0]
        names += [own, short, f"{short}.local", socket.getfqdn()]
    return allowed_hosts(*filter(None, names))


def arrived_at(scope: Mapping[str, Any]) -> frozenset[str]:
    """The address of this machine at which a request arrived; nothing where that is not known."""
    server = scope.get("server")
    return frozenset([spelled(server[0])] if server and _is_address(server[0]) else [])


def to_be_told(host: str) -> str:
    """What stands for a server in an address that works wherever the server can be reached from.

    Args:
        host: Where it listens; of all addresses of the machine, that which others see is meant.
    """
    if not _is_address(host) or not ip_address(host).is_unspecified:
        return spelled(host)
    for family in (socket.AF_INET, socket.AF_INET6) if ":" in host else (socket.AF_INET,):
        with socket.socket(family, socket.SOCK_DGRAM) as asking:
            try:
                asking.connect((_ELSEWHERE[family], 9))  # chooses a way there, and sends nothing
            except OSError:
                continue
            return spelled(asking.getsockname()[0])
    return socket.gethostname()  # of a machine without a network


def tunnel(host: str, port: int) -> str:
    """The command by which another machine reaches what listens on loopback alone.

    >>> tunnel("::1", 8000).startswith("ssh -N -L 8000:[::1]:8000 ")
    True
    """
    return f"ssh -N -L {port}:{spelled(host)}:{port} {socket.gethostname()}"


def _is_address(text: str) -> bool:
    try:
        ip_address(text)
    except ValueError:
        return False
    return True
