"""Importing label files for the photo of `testing.label_files`: rightly, or with one sentence."""

import numpy as np
import pytest

from annotate.formats import FormatError, import_labels
from testing.label_files import NAME, ROWS, WIDTH


def imported(source, photos, names=(NAME,), **options):
    return import_labels(source, photos, names, **options)


def said_about(source, photos, names=(NAME,), **options):
    with pytest.raises(FormatError) as caught:
        imported(source, photos, names, **options)
    said = str(caught.value)
    assert len(said.splitlines()) == 1
    assert said.endswith(".")
    for word in ("Error", "NoneType", "codec", "object is", "object has", "not subscriptable"):
        assert word not in said
    return said


def is_right(found, name=NAME):
    assert [one.name for one in found] == [name]
    np.testing.assert_array_equal(found.found[0].skyline.rows, ROWS)
    assert found.found[0].skyline.visible.all()
    return found


def level(row, first=0.0, last=float(WIDTH)):
    return [(first, float(row)), (last, float(row))]
