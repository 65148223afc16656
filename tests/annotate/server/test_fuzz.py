"""Requests made from the server's own description: none makes it stumble."""

import schemathesis
from hypothesis import HealthCheck, given
from schemathesis.checks import not_a_server_error

from annotate.server.app import make_app
from annotate.server.security import TOKEN_HEADER
from skyline_viz.system.loopback import allowed_hosts
from testing.examples import examples
from testing.labelling import TOKEN, workbench, write_hills

HEADERS = {TOKEN_HEADER: TOKEN}


def fuzz(operation):
    """Call an operation many times; return the statuses of its answers."""
    statuses = set()

    @examples(60, suppress_health_check=list(HealthCheck))
    @given(case=operation.as_strategy())
    def request(case):
        for photo in (case.path_parameters.get("photo"), 1):  # as drawn, and one that is there
            if photo is not None:
                case.path_parameters["photo"] = photo
            answer = case.call(headers=HEADERS)
            case.validate_response(answer, checks=[not_a_server_error])
            statuses.add(answer.status_code)

    request()
    return statuses


def test_no_request_makes_the_server_stumble(tmp_path):
    bench = workbench(write_hills(tmp_path, count=2))
    app = make_app({TOKEN: bench}, allowed_hosts("testserver"))
    schema = schemathesis.openapi.from_asgi("/api/openapi.json", app, headers=HEADERS)
    tried = {}
    for found in schema.get_all_operations():
        operation = found.ok()
        if operation.path.endswith("/recording"):
            continue  # takes long each time; its errors are tested elsewhere
        tried[operation.method, operation.path] = fuzz(operation)
    bench.close()
    assert len(tried) >= 15
    assert not {401, 421} & set().union(*tried.values())  # it got past the guard
    assert sum(200 in statuses for statuses in tried.values()) >= 10
