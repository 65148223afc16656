"""Label files of other programs for the photo of `tests.label_files`, sound and unsound."""

import json

import numpy as np
from pycocotools import mask as coco_mask

from testing import label_files as made
from testing.label_files import HEIGHT, NAME, ROWS, SKY, WIDTH, coco, cvat, labelme, shape

OUTLINE, LINE = made.outline(), made.line()
FLAT = made.flat(OUTLINE)
HALF = WIDTH // 2
LEFT = [(0, 0), (HALF, 0), *[(x, y) for x, y in OUTLINE[2:] if x <= HALF]]
RIGHT = [(HALF, 0), (WIDTH, 0), *[(x, y) for x, y in OUTLINE[2:] if x >= HALF]]
BEYOND = [(-30.0, -50.0), (WIDTH + 30.0, -50.0), (WIDTH + 30.0, float(ROWS[-1])), *OUTLINE[2:]]
BEYOND.append((-30.0, float(ROWS[0])))
PACKED = coco_mask.encode(np.asfortranarray(SKY.astype(np.uint8)))
COMPRESSED = {"size": PACKED["size"], "counts": PACKED["counts"].decode()}
POLYLINE = f'<polyline label="skyline" points="{made.cvat_points(LINE)}"/>'
POLYGON = f'<polygon label="Sky" points="{made.cvat_points(OUTLINE)}"/>'
MASK = (
    f'<mask label="sky" rle="{made.cvat_rle(SKY[:90])}" left="0" top="0" width="{WIDTH}" '
    f'height="90"/>'
)


READ = {
    "coco polygon": coco([[FLAT]]),
    "coco polygon that is not nested": coco([FLAT]),
    "coco polygon 1 px below the top": coco([[made.flat(made.outline(top=1.0))]]),
    "coco polygon 2.4 px below the top": coco([[made.flat(made.outline(top=2.4))]]),
    "coco polygon past the borders": coco([[made.flat(BEYOND)]]),
    "coco polygon the other way round": coco([[made.flat(OUTLINE[::-1])]]),
    "coco two polygons": coco([[made.flat(LEFT), made.flat(RIGHT)]]),
    "coco two annotations": coco([[made.flat(LEFT)], [made.flat(RIGHT)]]),
    "coco polygon and mask": coco([[made.flat(LEFT)], made.rle(SKY & (np.arange(WIDTH) >= HALF))]),
    "coco plain run lengths": coco([made.rle(SKY)]),
    "coco compressed run lengths": coco([COMPRESSED]),
    "coco Sky": coco([[FLAT]], category=" Sky "),
    "coco with a folder": coco([[FLAT]], name=f"train2017/{NAME}"),
    "coco with a folder of Windows": coco([[FLAT]], name=f"..\\photos\\{NAME}"),
    "coco in capitals": coco([[FLAT]], name=NAME.upper()),
    "coco of Roboflow": coco([[FLAT]], name="ridge_png.rf.0a1b2c.jpg", extra={"name": NAME}),
    "coco without sizes": coco([[FLAT]], size=(None, None)),
    "coco with other categories": coco([[FLAT], {"image_id": 1, "category_id": 7}]),
    "labelme line": labelme(shape(LINE)),
    "labelme line from right to left": labelme(shape(LINE[::-1])),
    "labelme Skyline": labelme(shape(LINE, "Skyline")),
    "labelme horizon": labelme(shape(LINE, "horizon")),
    "labelme polygon": labelme(shape(OUTLINE, "sky", "polygon")),
    "labelme very old": labelme({"label": "sky", "points": OUTLINE}, size=(None, None)),
    "labelme two polygons": labelme(
        shape(LEFT, "sky", "polygon"), shape(RIGHT, "SKY", "polygon", group_id=2)
    ),
    "labelme two lines": labelme(shape(LINE[:HALF]), shape(LINE[HALF:])),
    "labelme path of Windows": labelme(shape(LINE), name=f"..\\images\\{NAME}"),
    "labelme flags null": labelme(shape(LINE), flags=None),
    "labelme with a point": labelme(shape([(5, 5)], "peak", "point"), shape(LINE)),
    "labelme line and sky": labelme(shape(LINE), shape([(0, 0), (9, 0), (9, 9)], "sky", "polygon")),
    "labelme mask": labelme(
        shape([(0, 0), (WIDTH - 1, 89)], "sky", "mask", mask=made.png_in_text(SKY[:90]))
    ),
    "cvat polyline": cvat(POLYLINE),
    "cvat polygon": cvat(POLYGON),
    "cvat mask": cvat(MASK),
    "cvat in a folder": cvat(POLYLINE, name=f"day/{NAME}"),
    "cvat with boxes": cvat(f'<box label="hut" xtl="1" ytl="1" xbr="9" ybr="9"/>{POLYLINE}'),
    "cvat with attributes": cvat(
        POLYLINE.replace("/>", '><attribute name="kind">rock</attribute></polyline>')
    ),
    "cvat in UTF-16": cvat(POLYLINE).replace("utf-8", "utf-16").encode("utf-16"),
    "cvat in Latin-1": cvat(POLYLINE + "<!-- é -->").replace("utf-8", "latin-1").encode("latin-1"),
    "coco in UTF-16": json.dumps(coco([[FLAT]])).encode("utf-16"),
    "coco with a mark": b"\xef\xbb\xbf" + json.dumps(coco([[FLAT]])).encode(),
}
"""Files that mean `SKYLINE`, exactly; the first word is the format."""

LAYOUTS = {
    "coco in annotations": {"annotations/instances_default.json": READ["coco polygon"]},
    "coco beside other files": {
        "README.txt": "hello",
        "settings.json": {"theme": "dark"},
        "train/_annotations.coco.json": READ["coco polygon"],
    },
    "labelme of several": {
        "a.json": labelme(shape(LINE, "tree"), name="other.png"),
        "ridge.json": READ["labelme line"],
    },
    "labelme without a path": {"ridge.json": labelme(shape(LINE), name=None)},
    "coco in parts": {
        "1.json": coco([[made.flat(LEFT)]]),
        "2.json": coco([[made.flat(RIGHT)]]),
    },
    "one damaged file among them": {"a.json": "{", "ridge.json": READ["labelme line"]},
}
"""Folders that mean it."""

SAID = {
    "another photo": (coco([[FLAT]], name="1a2b3c4d-ridge.png"), ["1a2b3c4d-ridge.png", NAME]),
    "another label": (coco([[FLAT]], category="mountain"), ["mountain (1 polygon)", "--label"]),
    "boxes only": (coco([None]), ["sky (1 box)"]),
    "turned": (coco([[FLAT]], size=(WIDTH, HEIGHT)), ["160x120", "120x160", "turned"]),
    "another size": (coco([[FLAT]], size=(60, 80)), ["80x60"]),
    "empty run lengths": (coco([{"size": [HEIGHT, WIDTH], "counts": []}]), ["do not fill"]),
    "run lengths of another size": (coco([{"size": [9, 9], "counts": [40, 41]}]), ["9x9"]),
    "cut run lengths": (
        coco([{"size": [HEIGHT, WIDTH], "counts": COMPRESSED["counts"][:-4]}]),
        ["annotation 1"],
    ),
    "labelme in GB2312": (
        json.dumps(labelme(shape(LINE, "天空线")), ensure_ascii=False).encode("gb18030"),
        ["encoding UTF-8", "GB2312"],
    ),
    "labelme in GB2312 that is sound UTF-8": (
        json.dumps(labelme(shape(LINE), name="山.png"), ensure_ascii=False).encode("gb18030"),
        ["GB2312", "山.png"],
    ),
    "labelme rectangle": (labelme(shape([(0, 0), (9, 9)], "sky", "rectangle")), ["sky (1 box)"]),
    "labelme line called sky": (labelme(shape(LINE, "sky")), ["sky (1 line)"]),
    "labelme polygon called skyline": (
        labelme(shape(OUTLINE, "skyline", "polygon")),
        ["skyline (1 polygon)"],
    ),
    "VIA": (
        {"_via_settings": {}, "_via_img_metadata": {"a": {"filename": NAME, "regions": [{}, {}]}}},
        ["VGG Image Annotator", "2 regions", "COCO"],
    ),
    "Label Studio": ([{"data": {"image": NAME}, "annotations": []}], ["Label Studio", "COCO"]),
    "Segment Anything": ({"image": {"file_name": NAME}, "annotations": []}, ["Segment Anything"]),
    "Supervisely": ({"objects": [], "size": {}}, ["Supervisely"]),
    "something else": ({"theme": "dark"}, ["theme"]),
    "cvat of another size": (cvat(POLYLINE, size=(WIDTH, HEIGHT)), ["120x160", "turned"]),
    "cvat boxes": (
        cvat('<box label="sky" xtl="1" ytl="1" xbr="9" ybr="9"/><box label="sky" xtl="1"/>'),
        ["sky (2 boxes)"],
    ),
    "cvat damaged mask": (cvat(MASK.replace('rle="', 'rle="7, ')), ["mask", "do not fill"]),
    "Pascal VOC": ("<annotation><object/></annotation>", ["Pascal VOC"]),
    "other XML": ("<kml/>", ["<kml>"]),
    "unknown encoding": ("<?xml version='1.0' encoding='klingon'?><annotations/>", ["klingon"]),
    "no list of annotations": ({"images": [], "annotations": None}, ["annotations"]),
}
"""Files that are refused, and words that must be said."""
