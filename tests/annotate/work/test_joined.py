"""Labels joined to the photos that are there; the others are named."""

from annotate.store.store import Store
from annotate.work.joined import joined
from testing.labelling import workbench, write_hills
from testing.labels import label, poisoned


def test_labels_of_photos_that_are_there_and_orphans(tmp_path):
    folder = label(write_hills(tmp_path / "alps"), row=9, photos=2)
    label(folder, "bob", row=9, photos=3)
    (folder / "hill-1.png").unlink()
    store = Store(folder, reading=True)
    found = joined(store, "ann")
    assert [photo.name for photo in found.photos] == ["hill-0.png", "hill-2.png"]
    assert [one.name for one in found.labels] == ["hill-0.png"]
    assert [one.name for one in found.orphans] == ["hill-1.png"]
    assert len(found.notes) == 1
    assert "hill-1.png (sha256 " in found.notes[0]
    assert len(joined(store).labels) == 3
    store.close()


def test_photos_that_were_only_looked_at_have_no_orphans(tmp_path):
    folder = write_hills(tmp_path / "alps", count=1)
    bench = workbench(folder)
    bench.session(1)
    bench.close()
    (folder / "hill-0.png").unlink()
    store = Store(folder, reading=True)
    assert joined(store).notes == []
    store.close()


def test_labels_that_cannot_be_read_are_named_with_what_helps(tmp_path):
    store = Store(poisoned(write_hills(tmp_path / "alps")), reading=True)
    found = joined(store)
    assert [one.name for one in found.labels] == ["hill-0.png"]
    assert len(found.damaged) == 2
    assert "hill-1.png" in found.damaged[0]
    assert "skyline-annotate repair" in found.damaged[1]
    store.close()
