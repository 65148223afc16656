"""Label files as other programs write them, and masks of every kind, for one photo and one line."""

import base64
import io
import json
import zipfile

import cv2
import numpy as np
import pytest
import tifffile
from PIL import Image, ImageFilter

from skyline_viz.datasets.truths import read_truth
from skyline_viz.skyline import Skyline, SkylineError

HEIGHT, WIDTH = 120, 160
NAME = "ridge.png"
ROWS = np.round(60 + 20 * np.sin(np.arange(WIDTH) / 20) + 5 * np.sin(np.arange(WIDTH) / 4))
ROWS = ROWS.astype(int)
SKYLINE = Skyline(ROWS)
SKY = SKYLINE.to_mask(HEIGHT)


def photo():
    """A photo with just this skyline, and noise."""
    noise = np.random.default_rng(0).integers(-25, 25, (HEIGHT, WIDTH, 3))
    plain = np.where(SKY[:, :, None], (170, 190, 230), (60, 70, 50))
    return (plain + noise).clip(1, 254).astype(np.uint8)


# Masks: each writes a picture beside the name it is given, and returns its path


def picture(path, pixels, **options):
    Image.fromarray(np.ascontiguousarray(pixels)).save(path, **options)
    return path


def levels(sky, terrain, kind=np.uint8):
    return np.where(SKY, sky, terrain).astype(kind)


def colours(sky, terrain):
    return np.where(SKY[:, :, None], sky, terrain).astype(np.uint8)


def with_alpha(pixels, alpha):
    return np.dstack([pixels, alpha.astype(np.uint8)])


def palette(path, indices, table, **options):
    image = Image.fromarray(indices.astype(np.uint8), "P")
    image.putpalette([one for colour in table for one in colour])
    image.save(path, **options)
    return path


def deep(path, pixels):
    cv2.imwrite(str(path), pixels.astype(np.uint16))
    return path


def tiff(path, values):
    tifffile.imwrite(path, values)
    return path


def framed(mask, thick, value):
    whole = np.full_like(mask, value)
    whole[thick:-thick, thick:-thick] = mask[thick:-thick, thick:-thick]
    return whole


def spotted(mask, top, bottom, left, right, value):
    spotted_mask = mask.copy()
    spotted_mask[top:bottom, left:right] = value
    return spotted_mask


BLACK, WHITE, BLUE, RED = (0, 0, 0), (255, 255, 255), (0, 0, 255), (255, 0, 0)
MASK = levels(0, 255)
THREE = np.where(SKY, 0, np.where(np.arange(HEIGHT)[:, None] > 100, 2, 1))
SOFT = np.clip((np.arange(HEIGHT)[:, None] - ROWS + 8.5) / 16, 0, 1)
CITY = [(70, 130, 180), (107, 142, 35), (0, 0, 142)]
BLURRED = np.asarray(Image.fromarray(levels(0, 255)).filter(ImageFilter.GaussianBlur(1)))

SAME = {
    "as we write it": lambda p: picture(p / "m.png", MASK),
    "white sky": lambda p: picture(p / "m.png", levels(255, 0)),
    "0 and 1": lambda p: picture(p / "m.png", levels(0, 1)),
    "1 and 0": lambda p: picture(p / "m.png", levels(1, 0)),
    "ids 3 and 10": lambda p: picture(p / "m.png", levels(10, 3)),
    "one bit": lambda p: picture(p / "m.png", ~SKY),
    "one bit, sky": lambda p: picture(p / "m.png", SKY),
    "pgm": lambda p: picture(p / "m.pgm", MASK),
    "bmp": lambda p: picture(p / "m.bmp", MASK),
    "rgb": lambda p: picture(p / "m.png", colours(BLACK, WHITE)),
    "16 bits": lambda p: picture(p / "m.png", levels(0, 65535, np.uint16)),
    "16 bits, 0 and 255": lambda p: picture(p / "m.png", levels(0, 255, np.uint16)),
    "16 bits, 0 and 1": lambda p: picture(p / "m.png", levels(0, 1, np.uint16)),
    "16 bits, 1000 is sky": lambda p: picture(p / "m.png", levels(1000, 0, np.uint16)),
    "16 bits a colour, 0 and 255": lambda p: deep(p / "m.png", colours(BLACK, WHITE)),
    "16 bits a colour": lambda p: deep(p / "m.png", colours(BLUE, BLACK) * np.uint16(257)),
    "16 bits a colour, alpha": lambda p: deep(
        p / "m.png", np.dstack([np.zeros((HEIGHT, WIDTH, 3)), levels(0, 65535, np.uint16)])
    ),
    "floats": lambda p: tiff(p / "m.tif", levels(0, 1, np.float32)),
    "floats, sky": lambda p: tiff(p / "m.tif", levels(1, 0, np.float32)),
    "32 bits": lambda p: tiff(p / "m.tif", levels(3, 0, np.int32)),
    "palette of two": lambda p: palette(p / "m.png", np.where(SKY, 2, 7), [BLACK] * 2 + CITY),
    "palette of two, same colours": lambda p: palette(p / "m.png", np.where(SKY, 0, 1), [BLACK]),
    "palette, sky transparent": lambda p: palette(
        p / "m.png", np.where(SKY, 0, 1), [BLACK, BLACK], transparency=0
    ),
    "blue sky on black": lambda p: picture(p / "m.png", colours(BLUE, BLACK)),
    "red terrain": lambda p: picture(p / "m.png", colours(BLACK, RED)),
    "red sky": lambda p: picture(p / "m.png", colours(RED, BLACK)),
    "blue sky, red terrain": lambda p: picture(p / "m.png", colours(BLUE, RED)),
    "two dark colours": lambda p: picture(p / "m.png", colours((0, 0, 0), (20, 0, 0))),
    "grey and alpha": lambda p: picture(p / "m.png", np.dstack([MASK * 0, MASK])),
    "terrain in alpha": lambda p: picture(
        p / "m.png", with_alpha(colours(BLACK, BLACK), levels(0, 255))
    ),
    "terrain cut out of the photo": lambda p: picture(
        p / "m.png", with_alpha(photo(), levels(0, 255))
    ),
    "sky cut out of the photo": lambda p: picture(p / "m.png", with_alpha(photo(), levels(255, 0))),
    "half transparent sky": lambda p: picture(
        p / "m.png", with_alpha(colours((30, 144, 255), BLACK), levels(153, 0))
    ),
    "alpha says nothing": lambda p: picture(
        p / "m.png", with_alpha(colours(BLACK, WHITE), levels(9, 9))
    ),
    "a frame of 1": lambda p: picture(p / "m.png", framed(MASK, 1, 255)),
    "a frame of 2": lambda p: picture(p / "m.png", framed(MASK, 2, 255)),
    "a black frame": lambda p: picture(p / "m.png", framed(MASK, 2, 0)),
    "a white frame around white sky": lambda p: picture(p / "m.png", framed(255 - MASK, 2, 255)),
    "a line along the top": lambda p: picture(p / "m.png", spotted(MASK, 0, 2, 0, WIDTH, 255)),
    "a bird": lambda p: picture(p / "m.png", spotted(MASK, 10, 14, 50, 56, 255)),
    "a bird in white sky": lambda p: picture(p / "m.png", spotted(255 - MASK, 10, 14, 50, 56, 0)),
    "a branch at the top": lambda p: picture(p / "m.png", spotted(MASK, 0, 5, 50, 56, 255)),
    "a lake": lambda p: picture(p / "m.png", spotted(MASK, 95, 115, 20, 90, 0)),
    "a lake under white sky": lambda p: picture(
        p / "m.png", spotted(255 - MASK, 95, 115, 20, 90, 255)
    ),
    "a painted photo": lambda p: picture(p / "m.png", SKYLINE.to_painted(photo())),
    "a painted photo with alpha": lambda p: picture(
        p / "m.png", with_alpha(SKYLINE.to_painted(photo(), "blue"), levels(255, 255))
    ),
}
"""Pictures that mean `SKYLINE`, exactly, in the columns that are visible."""

NEAR = {
    "JPEG 75": lambda p: picture(p / "m.jpg", MASK, quality=75),
    "JPEG 20": lambda p: picture(p / "m.jpg", MASK, quality=20),
    "JPEG, white sky": lambda p: picture(p / "m.jpg", colours(WHITE, BLACK), quality=60),
    "JPEG, blue sky": lambda p: picture(p / "m.jpg", colours(BLUE, BLACK), quality=90),
    "WebP": lambda p: picture(p / "m.webp", MASK, quality=50),
    "soft": lambda p: picture(p / "m.png", (255 * SOFT).astype(np.uint8)),
    "soft sky": lambda p: picture(p / "m.png", (255 * (1 - SOFT)).astype(np.uint8)),
    "soft from 30 to 220": lambda p: picture(p / "m.png", (30 + 190 * SOFT).astype(np.uint8)),
    "soft floats": lambda p: tiff(p / "m.tif", SOFT.astype(np.float32)),
    "soft 16 bits": lambda p: picture(p / "m.png", (65535 * SOFT).astype(np.uint16)),
    "palette of greys": lambda p: palette(
        p / "m.png", BLURRED // 17, [(17 * one,) * 3 for one in range(16)]
    ),
    "soft alpha": lambda p: picture(p / "m.png", with_alpha(colours(BLACK, BLACK), BLURRED)),
    "soft blue": lambda p: picture(
        p / "m.png", np.dstack([MASK * 0, MASK * 0, 255 - BLURRED]).astype(np.uint8)
    ),
}
"""Pictures that mean `SKYLINE` to within 2 pixels, for what they have lost."""

ASK = {
    "palette of three": lambda p: palette(p / "m.png", THREE, CITY),
    "three colours": lambda p: picture(p / "m.png", np.array(CITY, np.uint8)[THREE]),
    "three colours in JPEG": lambda p: picture(
        p / "m.jpg", np.array([BLUE, WHITE, RED], np.uint8)[THREE], quality=85
    ),
    "three greys": lambda p: picture(p / "m.png", np.array([2, 100, 200], np.uint8)[THREE]),
    "three greys around 128": lambda p: picture(
        p / "m.png", np.array([0, 128, 255], np.uint8)[THREE]
    ),
    "ids with 255 for nothing": lambda p: picture(
        p / "m.png", np.array([1, 0, 255], np.uint8)[THREE]
    ),
    "ids in 16 bits": lambda p: picture(p / "m.png", np.array([7, 8, 900], np.uint16)[THREE]),
    "alpha that says something else": lambda p: picture(
        p / "m.png",
        with_alpha(colours(BLACK, WHITE), np.where(np.arange(WIDTH) > 80, 255, 0) + 0 * THREE),
    ),
    "one value that is no convention": lambda p: picture(p / "m.png", MASK * 0 + 1),
    "one colour": lambda p: picture(p / "m.png", colours((9, 0, 0), (9, 0, 0))),
    "left and right": lambda p: picture(
        p / "m.png", (np.where(np.arange(WIDTH) < 80, 0, 255) + 0 * THREE).astype(np.uint8)
    ),
    "the same above and below": lambda p: picture(
        p / "m.png", spotted(MASK, 100, HEIGHT, 0, WIDTH, 0)
    ),
    "a wide frame": lambda p: picture(p / "m.png", framed(MASK, 10, 255)),
}
"""Pictures that may mean several things; a user is told what is in them, and asked."""

REFUSED = {
    "a photo": lambda p: picture(p / "m.png", photo()),
    "a photo in JPEG": lambda p: picture(p / "m.jpg", photo()),
    "a grey photo": lambda p: picture(p / "m.png", photo()[:, :, 1]),
    "a photo with a red coat": lambda p: picture(p / "m.png", _coat()),
    "a painted photo in JPEG": lambda p: picture(p / "m.jpg", SKYLINE.to_painted(photo())),
    "noise": lambda p: picture(
        p / "m.png", np.random.default_rng(0).integers(0, 256, (HEIGHT, WIDTH), np.uint8)
    ),
    "black and white noise": lambda p: picture(
        p / "m.png", np.random.default_rng(0).integers(0, 2, (HEIGHT, WIDTH)) > 0
    ),
    "a white line": lambda p: picture(
        p / "m.png", np.where(np.arange(HEIGHT)[:, None] == ROWS, 255, 0).astype(np.uint8)
    ),
    "soft and dark": lambda p: picture(p / "m.png", (100 * SOFT).astype(np.uint8)),
    "not a number": lambda p: tiff(p / "m.tif", np.where(SKY, np.nan, 1).astype(np.float32)),
    "values too close for 8 bits": lambda p: deep(p / "m.png", colours(BLACK, (9, 9, 9)) + 300.0),
}
"""Pictures that are no truth."""

UNREADABLE = {**ASK, **REFUSED}
"""Pictures of which no truth may be made without being asked for."""


def _coat():
    coat = photo()
    coat[80:86, 100:112] = RED
    return coat


# Label files of drawing programs


def outline(rows=ROWS, top=0.0):
    """Corners of the sky above `rows`, on the borders of pixels."""
    points = [(0.0, top), (float(len(rows)), top)]
    for column in range(len(rows))[::-1]:
        points += [(column + 1.0, float(rows[column])), (float(column), float(rows[column]))]
    return points


def line(rows=ROWS):
    return [(column + 0.5, float(row)) for column, row in enumerate(rows)]


def flat(points):
    return [one for point in points for one in point]


def coco(annotations, name=NAME, size=(HEIGHT, WIDTH), category="sky", **image):
    """A COCO document; `annotations` are segmentations, or whole annotations."""
    whole = [
        one if isinstance(one, dict) and "image_id" in one else {"image_id": 1, "segmentation": one}
        for one in annotations
    ]
    return {
        "images": [{"id": 1, "file_name": name, "height": size[0], "width": size[1], **image}],
        "categories": [{"id": 1, "name": category}],
        "annotations": [
            {"id": number, "category_id": 1, "iscrowd": 0, **one}
            for number, one in enumerate(whole, 1)
        ],
    }


def shape(points, label="skyline", kind="linestrip", **more):
    told = [list(point) for point in points]
    return {"label": label, "points": told, "shape_type": kind, "flags": {}, **more}


def labelme(*shapes, name=NAME, size=(HEIGHT, WIDTH), **more):
    return {
        "version": "5.5.0",
        "flags": {},
        "shapes": list(shapes),
        "imagePath": name,
        "imageData": None,
        "imageHeight": size[0],
        "imageWidth": size[1],
        **more,
    }


def png_in_text(mask):
    packed = io.BytesIO()
    Image.fromarray(mask).save(packed, "PNG")
    return base64.b64encode(packed.getvalue()).decode()


def cvat(inside, name=NAME, size=(HEIGHT, WIDTH)):
    image = f'<image id="0" name="{name}" width="{size[1]}" height="{size[0]}">{inside}</image>'
    return f'<?xml version="1.0" encoding="utf-8"?><annotations>{image}</annotations>'


def cvat_points(points):
    return ";".join(f"{x:.2f},{y:.2f}" for x, y in points)


def cvat_rle(mask):
    """Runs of a mask along its rows, in its whole box."""
    inside = mask.ravel()
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(inside)) + 1, [inside.size]])
    runs = np.diff(bounds).tolist()
    return ", ".join(map(str, [0, *runs] if inside[0] else runs))


def rle(mask):
    """COCO's plain run lengths of a mask."""
    inside = mask.T.ravel()
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(inside)) + 1, [inside.size]])
    runs = np.diff(bounds).tolist()
    return {"size": list(mask.shape), "counts": [0, *runs] if inside[0] else runs}


def written(path, document):
    """Write a document, given as text, bytes or JSON, and return its path."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(document, bytes):
        path.write_bytes(document)
    elif isinstance(document, str):
        path.write_text(document, encoding="utf-8")
    else:
        path.write_text(json.dumps(document), encoding="utf-8")
    return path


def zipped(path, members):
    with zipfile.ZipFile(path, "w") as packed:
        for name, content in members.items():
            packed.writestr(name, content)
    return path


def said_about(path, **options):
    with pytest.raises(SkylineError) as caught:
        read_truth(path, **options)
    said = str(caught.value)
    assert said.startswith(str(path))
    assert said.endswith(".")
    assert len(said.splitlines()) == 1
    return said


def cut_up(document, chance):
    """A document as bytes, of which some are other ones, or missing."""
    text = document if isinstance(document, bytes | str) else json.dumps(document)
    whole = bytearray(text if isinstance(text, bytes) else text.encode())
    for _ in range(chance.randint(1, 6)):
        place = chance.randrange(len(whole))
        whole[place : place + chance.randint(0, 3)] = chance.choice(
            [b"", b"-", b"9", b"null", b"[", b"}", b'"', b"\xff", b"1e999", b","]
        )
    return bytes(whole)


def packed(folder, path):
    """The files of a folder as a ZIP."""
    files = [file for file in folder.rglob("*") if file.is_file()]
    return zipped(path, {one.relative_to(folder).as_posix(): one.read_bytes() for one in files})
