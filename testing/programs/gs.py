"""A Google Cloud Storage on this machine."""

from contextlib import contextmanager

import gcsfs
from gcp_storage_emulator.server import Router, create_server


@contextmanager
def gs(monkeypatch):
    """A storage with an empty bucket ``photos``, which the environment names.

    Yields what it was asked for: methods and paths.
    """
    asked = []

    def handle(self, method):
        asked.append((method, self._request_handler.path))
        return plain(self, method)

    plain = Router.handle
    monkeypatch.setattr(Router, "handle", handle)
    server = create_server("127.0.0.1", 0, in_memory=True, default_bucket="photos")
    server.start()
    try:
        port = server._api._httpd.server_port  # the one that was free
        monkeypatch.setenv("STORAGE_EMULATOR_HOST", f"http://127.0.0.1:{port}")
        gcsfs.GCSFileSystem.clear_instance_cache()
        yield asked
    finally:
        gcsfs.GCSFileSystem.clear_instance_cache()
        server.stop()
