"""Routes of the whole folder: its photos, its guideline and exports."""

import io
import zipfile

from testing.labelling import done, served, write_hills


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


def test_the_list_says_who_else_has_finished_and_what_has_no_skyline(tmp_path):
    folder = write_hills(tmp_path / "alps")
    with served(folder, annotator="bob") as bob:
        done(bob, 1, {"kind": "status", "status": "rejected"})
        done(bob, 2, {"kind": "status", "status": "needs review"})
    with served(folder, annotator="bob", number=2) as again:
        done(again, 1, {"kind": "status", "status": "accepted"})
    with served(folder) as client:
        done(client, 3, {"kind": "tag", "tag": "no visible skyline"})
        listed = client.get("/api/photos").json()["photos"]
    assert [one["finished_by"] for one in listed] == [["bob", "bob, pass 2"], [], []]
    assert [one["nothing_visible"] for one in listed] == [False, False, True]
    assert {one["status"] for one in listed} == {"to do"}  # what others say of it is not told


def test_the_folders_own_guideline_is_text(fresh, tmp_path):
    assert fresh.get("/api/guideline").json() == {"text": None}
    file = tmp_path / "photos" / "GUIDELINE.md"
    file.write_text("# Ours\n<script>alert(1)</script>\n", encoding="utf-8")
    assert fresh.get("/api/guideline").json() == {"text": "# Ours\n<script>alert(1)</script>\n"}
    file.write_bytes(b"\xff\xfe\x00")
    said = fresh.get("/api/guideline")
    assert (said.status_code, said.json()["detail"]) == (422, "GUIDELINE.md is no text in UTF-8.")


def test_exporting_what_was_accepted(fresh):
    said = fresh.get("/api/exports/mask")
    assert said.status_code == 422
    assert "nothing to export" in said.json()["detail"]
    done(fresh, 2, {"kind": "status", "status": "accepted"})
    said = fresh.get("/api/exports/mask")
    with zipfile.ZipFile(io.BytesIO(said.content)) as archive:
        assert archive.namelist() == ["masks/hill-1.png"]
    assert said.headers["content-type"] == "application/zip"
