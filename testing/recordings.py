"""Reads recordings back."""

import re
import subprocess

import cv2
import numpy as np
from rerun.chunk import RrdReader

import skyline_viz as sv
from skyline_viz.config import TrainingConfig
from skyline_viz.training import train
from skyline_viz.viewer.program.rerun_internals import program


def verify(path):
    subprocess.run([program(), "rrd", "verify", path], check=True, capture_output=True)


class Read:
    """What a recording holds, by entity and component."""

    def __init__(self, path):
        self.values = {}
        self.chunks = []
        reader = RrdReader(path)
        for chunk in reader.stream():
            batch = chunk.to_record_batch()
            self.chunks.append((str(chunk.entity_path).lstrip("/"), batch))
            for name, values in zip(batch.schema.names, batch.columns, strict=True):
                key = str(chunk.entity_path).lstrip("/"), name
                self.values.setdefault(key, []).extend(values)
        self.view_names = {
            str(value.as_py()[0])
            for store in reader.blueprints()
            for chunk in reader.stream(store=store)
            for batch in [chunk.to_record_batch()]
            for name in batch.schema.names
            if name.endswith(":display_name")
            for value in batch.column(name)
        }

    def entities(self):
        return {entity for entity, _ in self.values}

    def all(self, entity, component):
        """Every logged value of a component, oldest first."""
        found = [
            value
            for (place, name), values in self.values.items()
            if place == entity and (name == component or name.endswith(f":{component}"))
            for value in values
        ]
        return [value for value in found if value.as_py() is not None]

    def on(self, timeline, entity, component):
        """Every logged value of a component by its place on a timeline."""
        found = {}
        for place, batch in self.chunks:
            if place == entity and timeline in batch.schema.names:
                times = batch.column(timeline).to_pylist()
                for name in batch.schema.names:
                    if name.endswith(f":{component}"):
                        values = batch.column(name).to_pylist()
                        rows = zip(times, values, strict=True)
                        found |= {at: value for at, value in rows if value is not None}
        return found

    def last(self, entity, component):
        return self.all(entity, component)[-1]

    def array(self, entity, component):
        return np.array(self.last(entity, component).as_py())

    def picture(self, entity):
        """Decoded `EncodedImage`, RGB or grey."""
        blob = np.array(self.last(entity, "blob").as_py()[0], np.uint8)
        picture = cv2.imdecode(blob, cv2.IMREAD_UNCHANGED)
        return picture[..., ::-1] if picture.ndim == 3 else picture

    def classes(self, entity):
        """``(H, W)`` classes of a `SegmentationImage`."""
        form = self.last(entity, "format").as_py()[0]
        kind = np.uint8 if form["channel_datatype"] in (6, None) else np.uint16
        data = np.array(self.last(entity, "buffer").as_py()[0], np.uint8).tobytes()
        return np.frombuffer(data, kind).reshape(form["height"], form["width"])

    def labels(self, entity):
        """Words of each class."""
        context = self.last(entity, "context").as_py()[0]
        infos = [one["class_description"]["info"] for one in context]
        return {info["id"]: info["label"] for info in infos}

    def map(self, entity):
        """``(H, W)`` values that hovering tells, NaN where it tells none."""
        labels = self.labels(entity)
        told = np.full(max(labels) + 1, np.nan)
        for index, label in labels.items():
            if label and (number := re.search(r"-?\d+(\.\d+)?", label)):
                told[index] = float(number[0])
        return told[self.classes(entity)]


def drawn_rows(strips, width):
    """``(W,)`` row of the line that strips draw; NaN in columns that they leave out."""
    rows = np.full(width, np.nan)
    for strip in strips:
        across, down = np.array(strip).T
        rows[np.floor(across).astype(int)] = down
    return rows


def visible_rows(skyline):
    """``(W,)`` row of a skyline; NaN where it is not visible."""
    return np.where(skyline.visible, skyline.rows, np.nan)


def scene(height=90, width=120, noise=6, seed=0):
    """A photo of a ridge with noise, and its truth."""
    generator = np.random.default_rng(seed)
    rows = np.round(height * (0.4 + 0.1 * np.sin(np.arange(width) / 9)))
    photo = np.where(sv.Skyline(rows).to_mask(height)[..., None], (150, 190, 230), (70, 80, 50))
    photo = photo + generator.normal(0, noise, photo.shape)
    return photo.clip(0, 255).astype(np.uint8), sv.Skyline(rows, np.arange(width) != 60)


def banks_of_sizes(sizes):
    """Filter banks of some sizes, learned from two scenes."""
    return [
        train([scene(seed=1), scene(seed=2)], 0, TrainingConfig(filter_size=size), "two scenes")
        for size in sizes
    ]
