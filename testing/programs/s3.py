"""An S3 on this machine, which can be told to be busy, to break off, and to lose things."""

import threading
import urllib.request
from contextlib import contextmanager

import fsspec
from moto.server import DomainDispatcherApplication, create_backend_app
from werkzeug.serving import make_server

BUCKET = "photos"


class Moods:
    """What stands between a client and its storage."""

    def __init__(self, application):
        self.application = application
        self.busy = 0
        """Downloads that are refused from now on, as one that throttles does."""
        self.torn = 0
        """Downloads from now on of which the second half does not come."""
        self.forbidden = set()
        """Keys that may not be downloaded."""
        self.downloads = []
        """Keys that were downloaded, or tried."""
        self.questions = []
        """Keys of which something was asked, without a download."""

    def __call__(self, environ, start_response):
        path = environ["PATH_INFO"]
        download = environ["REQUEST_METHOD"] == "GET" and path.count("/") > 1 and path[-1] != "/"
        if environ["REQUEST_METHOD"] == "HEAD":
            self.questions.append(path.split("/", 2)[-1])
        if not download:
            return self.application(environ, start_response)
        self.downloads.append(path.split("/", 2)[2])
        if self.downloads[-1] in self.forbidden:
            start_response("403 Forbidden", [("Content-Type", "application/xml")])
            return [b"<Error><Code>AccessDenied</Code><Message>Access Denied.</Message></Error>"]
        if self.busy:
            self.busy -= 1
            start_response("503 Slow Down", [("Content-Type", "application/xml")])
            return [b"<Error><Code>SlowDown</Code><Message>Reduce your rate.</Message></Error>"]
        if not self.torn:
            return self.application(environ, start_response)
        self.torn -= 1

        def shortened(status, headers, *more):
            plain = [one for one in headers if one[0].lower() not in _LENGTHS]
            return start_response(status, plain, *more)

        whole = b"".join(self.application(environ, shortened))
        return [whole[: len(whole) // 2]]


_LENGTHS = ("content-length", "x-amz-checksum-crc32", "etag")


@contextmanager
def s3(monkeypatch):
    """A storage with an empty bucket ``photos``, which the environment names; yields its moods."""
    moods = Moods(DomainDispatcherApplication(create_backend_app))
    server = make_server("127.0.0.1", 0, moods, threaded=True)
    thread = threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True)
    thread.start()
    try:
        place = f"http://127.0.0.1:{server.server_port}"
        monkeypatch.setenv("AWS_ENDPOINT_URL", place)
        monkeypatch.setenv("AWS_MAX_ATTEMPTS", "1")
        for name in ("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY"):
            monkeypatch.setenv(name, "testing")
        monkeypatch.setenv("AWS_DEFAULT_REGION", "us-east-1")
        urllib.request.urlopen(f"{place}/moto-api/reset", data=b"").close()  # it outlives servers
        files = fsspec.filesystem("s3", skip_instance_cache=True)
        type(files).clear_instance_cache()
        files.mkdir(BUCKET)
        yield moods
    finally:
        type(files).clear_instance_cache()
        server.shutdown()
        thread.join()
        server.server_close()
