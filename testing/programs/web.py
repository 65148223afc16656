"""A web server on this machine, which says what it is told to say."""

import ssl
import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


class Site:
    """What a server has, and what it was asked for."""

    def __init__(self, place):
        self.place = place
        """Its address, without a slash at the end."""
        self.pages = {}
        """What there is by its path: bytes, or whatever `Answer` takes."""
        self.asked = []
        """Paths that were asked for, with their queries."""


class Answer:
    """An answer that is no plain page."""

    def __init__(self, status, body=b"", times=1_000_000, **headers):
        self.status = status
        self.body = body
        self.times = times
        """How often it is given; the body alone comes after that."""
        self.headers = {name.replace("_", "-"): value for name, value in headers.items()}


@contextmanager
def site(certificate=None):
    """A server that lasts as long as the block; yields its `Site`.

    Args:
        certificate: A file with a certificate and its key, for https.
    """

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            found.asked.append(self.path)
            answer = found.pages.get(self.path, Answer(404))
            if isinstance(answer, bytes):
                answer = Answer(200, answer)
            if not answer.times:
                answer = Answer(200, answer.body)
            answer.times -= 1
            kind = "text/html" if self.path.endswith("/") else "image/jpeg"
            length = str(len(answer.body))
            headers = {"Content-Type": kind, "Content-Length": length, **answer.headers}
            self.send_response(answer.status)
            for name, value in headers.items():
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(answer.body)

        def log_message(self, *_):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    if certificate:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(certificate)
        server.socket = context.wrap_socket(server.socket, server_side=True)
    found = Site(f"http{'s' if certificate else ''}://127.0.0.1:{server.server_port}")
    thread = threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True)
    thread.start()
    try:
        yield found
    finally:
        server.shutdown()
        thread.join()
        server.server_close()
