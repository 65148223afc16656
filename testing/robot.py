"""Drives the viewer as a person would: hovers, clicks, types, and reads what it says."""

import psutil

from skyline_viz.gallery.hand import Hand


def listening(process=None):
    """Addresses and ports on which this process and its children listen."""
    process = process or psutil.Process()
    return [
        (one.pid, connection.laddr.ip, connection.laddr.port)
        for one in (process, *process.children(recursive=True))
        for connection in one.net_connections("inet")
        if connection.status == psutil.CONN_LISTEN
    ]


def viewer_port(besides=()):
    """Port of the one viewer that this process has started, besides those on other ports."""
    here = psutil.Process().pid
    (port,) = {port for pid, _, port in listening() if pid != here} - set(besides)
    return port


class Robot(Hand):
    """A hand for a viewer, for as long as a block lasts."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
