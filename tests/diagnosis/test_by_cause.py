"""A diagnosed data set, cause by cause."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from skyline_viz.diagnosis.by_cause import by_cause, over_all
from skyline_viz.diagnosis.diagnosing import Diagnosis, Segment
from skyline_viz.diagnosis.record import Diagnosed
from skyline_viz.diagnosis.remedies import Remedy
from skyline_viz.diagnosis.report import in_full, remedies_table, table, write_json, write_photo


def segment(cause, error, terms=(), place=None, first=0):
    return Segment(
        columns=(first, first + 9),
        mean_error=error / 10,
        worst_error=error / 10,
        total_error=error,
        cause=cause,
        contributing=(),
        terms=terms,
        place=place,
        begins=first,
        findings=("It is so.",),
        trials=(),
        margin=1.0,
        path_cost={},
        truth_cost={},
        line=(0, np.zeros(10, np.int32)),
    )


def photo(name, segments, **changes):
    a_err = sum(one.total_error for one in segments) / 100
    remedies = [
        Remedy(setting, f"--{setting}", 1, broken, a_err + change, change, a_err + change > 5)
        for setting, (change, broken) in changes.items()
    ]
    return Diagnosed(name, a_err, a_err > 5, 100, Diagnosis(tuple(segments), 4.0), tuple(remedies))


CLOUD = segment("cheaper path", 2000.0, ("clear sky", "score"), "cloud above")
WIRE = segment("cheaper path", 300.0, ("strength",), "wire", first=50)


@pytest.fixture
def found():
    return [
        photo("a", [CLOUD, WIRE], off=(-18.0, 0), weak=(-1.0, 0)),
        photo("b", [WIRE], off=(9.0, 2), weak=(-2.0, 0)),
        photo("c", [], off=(1.0, 1), weak=(0.0, 0)),
    ]


def test_what_a_cause_costs_is_its_part_of_the_mean_error(found):
    cloud, wire = by_cause(found)
    assert cloud.title == "cheaper path by clear sky, cloud above"
    assert (cloud.term, cloud.place, cloud.photos, cloud.segments) == (
        "clear sky", "cloud above", 1, 1,
    )  # fmt: skip
    assert (wire.title, wire.photos, wire.columns) == ("cheaper path by strength, wire", 2, 20)
    assert cloud.a_err + wire.a_err == pytest.approx(np.mean([one.a_err for one in found]))


def test_the_best_remedy_is_that_of_the_photos_it_is_the_main_cause_of(found):
    cloud, wire = by_cause(found)
    off = cloud.remedy
    assert (off.name, off.photos, off.of, off.change) == ("off", 1, 1, -18)
    assert (off.broken, off.change_of_all) == (3, pytest.approx(-8 / 3))
    assert wire.remedy.name == "weak"
    assert (wire.remedy.photos, wire.remedy.of) == (0, 0)  # a small miss, but no gross one
    assert (off.misses, wire.remedy.misses) == (1, 0)  # b is one only with the other


def test_pairs_and_what_was_tried_on_some_photos_only_are_no_remedy_of_a_cause(found):
    more = replace(found[0].remedies[0], name="off and weak", change=-19.0, a_err=4.0)
    some = replace(found[0], remedies=(*found[0].remedies, more))
    assert by_cause([some, *found[1:]])[0].remedy.name == "off"
    assert "off and weak" not in over_all([some, *found[1:]])
    assert by_cause([some])[0].remedy.name == "off and weak"
    paired = replace(found[0], remedies=(*found[0].remedies, replace(more, pair=True)))
    assert by_cause([paired])[0].remedy.name == "off"


def test_the_photos_of_a_cause_are_named_the_worst_first(found):
    cloud, _wire = by_cause(found)
    assert cloud.names == ("a",)
    again = replace(found[0], name="d", diagnosis=Diagnosis((WIRE, WIRE), 4.0))
    assert by_cause([found[1], again])[0].names == ("d", "b")


def test_what_helps_nobody_is_no_remedy():
    (cause,) = by_cause([photo("b", [WIRE], off=(9.0, 2))])
    assert cause.remedy is None
    (cause,) = by_cause([photo("b", [WIRE])])
    assert cause.remedy is None
    assert by_cause([photo("c", [])]) == []


def test_the_tables_say_it(found):
    said = table(found)
    assert "1 right, 2 with wrong segments" in said
    assert "cheaper path by clear sky, cloud above" in said
    assert "6.67 px" in said
    assert "What would help most of each cause" in remedies_table(found)
    assert remedies_table([photo("b", [WIRE])]) == ""


def test_settings_are_ranked_by_what_they_are_worth(found):
    first, *rest = [line for line in remedies_table(found).splitlines() if " px" in line][:2]
    assert first.split() == ["off", "-2.67", "px", "1", "1", "3", "of", "3", "3"]
    assert rest[0].split() == ["weak", "-1.00", "px", "0", "0", "3", "of", "3", "0"]


def test_where_nothing_helps_it_is_said(found):
    some = [found[0], replace(found[2], remedies=())]
    assert "None of the settings that were tried" in remedies_table(some)
    assert "None of these helps" not in remedies_table(found)
    assert "None of these helps" in remedies_table([photo("b", [WIRE], off=(9.0, 2))])


def test_files_have_remedies_by_what_they_are_worth(found, tmp_path):
    write_json(tmp_path / "diagnosis.json", "hills", found)
    document = json.loads((tmp_path / "diagnosis.json").read_text())
    assert [one["name"] for one in document["remedies"]] == ["off", "weak"]
    assert document["remedies"][0] == {
        "name": "off", "change": pytest.approx(-8 / 3),
        "saved": 1, "lost": 1, "repaired": 3, "broken": 3,
    }  # fmt: skip
    assert [one["name"] for one in document["photos"][1]["remedies"]] == ["weak", "off"]


def test_one_photo_has_its_remedies_in_all_its_files(found, tmp_path):
    assert re.search(r"off +5\.00 px +-18\.00 px +no", in_full(found[0]))
    document, text = write_photo(tmp_path, "hills", found[0])
    assert json.loads(document.read_text())["photos"][0]["remedies"][0]["change"] == -18
    said = text.read_text()
    assert "- off: A_err 5.00 px, -18.00 px; add `--off`" in said
    assert "- weak: A_err 22.00 px, -1.00 px, still a gross miss; add `--weak`" in said


def test_a_photo_is_said_to_be_right_or_where_it_is_most_wrong():
    assert Diagnosis((), 4.0).said == "Right: no column is off by more than 4 px."
    assert Diagnosis((WIRE,), 4.0).said == (
        "Wrong: columns 50 to 59, by 30.0 px in the mean, cheaper path by strength, wire."
    )
    assert Diagnosis((WIRE, CLOUD), 4.0).said.endswith(
        "by clear sky, cloud above; 1 more stretch is wrong."
    )
