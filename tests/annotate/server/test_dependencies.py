"""What routes are given, and parts of addresses that are none."""

import asyncio

import httpx
import pytest
from fastapi import FastAPI

from annotate.server.dependencies import Bench, Column, PhotoId, TheLearner, Tile
from annotate.server.desks import Desk


def asked(place):
    """What a server answers whose route gives back what it was given."""
    app = FastAPI()
    desk = Desk(bench={"a": 1}, learner={"b": 2}, pictures={"c": 3}, shown="pass")

    @app.get("/{photo}/{column}/{tile}")
    async def given(photo: PhotoId, column: Column, tile: Tile, bench: Bench, learner: TheLearner):
        return [photo, column, tile, bench, learner]

    async def ask():
        transport = httpx.ASGITransport(
            lambda scope, *rest: app({**scope, "state": {"desk": desk}}, *rest)
        )
        async with httpx.AsyncClient(transport=transport) as client:
            return await client.get(f"http://here/{place}")

    return asyncio.run(ask())


def test_the_workbench_and_the_learner_are_those_of_the_person():
    assert asked("1/0/1000").json() == [1, 0, 1000, {"a": 1}, {"b": 2}]


@pytest.mark.parametrize("place", ["0/0/0", "1/-1/0", "1/100001/0", "1/0/1001", f"{2**63}/0/0"])
def test_numbers_out_of_range_are_refused(place):
    assert asked(place).status_code == 422
