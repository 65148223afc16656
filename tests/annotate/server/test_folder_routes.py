"""Routes of the whole folder: its photos, sheets and exports."""

import io
import zipfile

from testing.labelling import done


def test_the_list_has_all_photos(client):
    said = client.get("/api/photos").json()
    assert [photo["name"] for photo in said["photos"]] == [f"hill-{n}.png" for n in range(3)]
    assert {photo["status"] for photo in said["photos"]} == {"to do"}
    assert said["progress"] == {
        "done": 0,
        "total": 3,
        "seconds_a_photo": None,
        "seconds_left": None,
    }


def test_a_sheet_is_a_page_of_photos(client):
    said = client.get("/api/sheet", params={"status": "to do"}).json()
    assert said["pages"] == 1
    assert len(said["photos"]) == 3
    assert client.get("/api/sheet", params={"status": "rejected"}).json()["photos"] == []


def test_exporting_what_was_accepted(fresh):
    said = fresh.get("/api/exports/mask")
    assert said.status_code == 422
    assert "nothing to export" in said.json()["detail"]
    done(fresh, 2, {"kind": "status", "status": "accepted"})
    said = fresh.get("/api/exports/mask")
    with zipfile.ZipFile(io.BytesIO(said.content)) as archive:
        assert archive.namelist() == ["masks/hill-1.png"]
    assert said.headers["content-type"] == "application/zip"
