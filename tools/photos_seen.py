"""Put fingerprints of training photographs into what is shipped: python -m tools.photos_seen DATA.

What is trained keeps them by itself. The shipped filter bank and sky models are older, and
training them anew would change them. Rendered scenes are left out: kind and seed tell them.
"""

import sys
from dataclasses import replace
from pathlib import Path

import onnx
from onnx import helper

from skyline_viz.datasets import open_dataset
from skyline_viz.evaluation import fingerprints
from skyline_viz.files import replacing
from skyline_viz.filter_bank import FilterBank
from skyline_viz.sky_model import SEEN
from skyline_viz.system.fingerprints import packed, telling

PACKAGE = Path(__file__).parents[1] / "skyline_viz"
OF_BANK = ("web_dataset", "mountains", "uav")
OF_SKY = (*OF_BANK, "phone_unlabelled", "webcam")


def main(data):
    """Write the bank and both sky models, of which nothing else changes."""
    found = {name: _of_folder(data / name) for name in OF_SKY}
    bank = PACKAGE / "filter_bank.npz"
    seen = sorted({one for name in OF_BANK for one in found[name]})
    replace(FilterBank.load(bank), seen=tuple(seen)).save(bank)
    for size in ("small", "large"):
        file = PACKAGE / f"sky_{size}.onnx"
        model = onnx.load_model(file)
        notes = {one.key: one.value for one in model.metadata_props}
        notes[SEEN] = packed(one for name in OF_SKY for one in found[name])
        helper.set_model_props(model, notes)
        with replacing(file) as temporary:
            temporary.write_bytes(model.SerializeToString())


def _of_folder(folder):
    return telling([*fingerprints(open_dataset(folder), workers=2).values()])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
