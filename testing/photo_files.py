"""One photo in many files: formats, encodings and depths, and what can be wrong with each."""

import io
import struct
import zlib

import cv2
import numpy as np
import pillow_heif
import tifffile
from PIL import Image


def scene(height=160, width=240):
    """A smooth sky over darker, rough terrain ``(H, W, 3)``, and the row of its skyline."""
    random = np.random.default_rng(3)
    columns = np.arange(width)
    rows = np.rint(height * 0.45 + height * 0.08 * np.sin(columns / 17)).astype(int)
    down = np.arange(height)[:, None]
    sky = 200 + 40 * down / height
    rock = 70 + cv2.GaussianBlur(random.normal(0, 60, (height, width)), (0, 0), 1.5)
    grey = np.where(down < rows, sky, rock).clip(0, 255)
    tint = np.where((down < rows)[..., None], [0.75, 0.88, 1.0], [1.0, 0.9, 0.75])
    return (grey[..., None] * tint).astype(np.uint8), rows


def grey_of(photo):
    return cv2.cvtColor(photo, cv2.COLOR_RGB2GRAY)


def pillow(kind, **options):
    def make(path, photo):
        Image.fromarray(photo).save(path, kind, **options)

    return make


def heic(**options):
    def make(path, photo):
        pillow_heif.from_pillow(Image.fromarray(photo)).save(path, quality=95, **options)

    return make


def exif(orientation, kind, **options):
    def make(path, photo):
        turned = {6: np.rot90(photo, 1), 3: photo[::-1, ::-1], 5: photo.transpose(1, 0, 2)}
        block = Image.Exif()
        block[0x0112] = orientation
        stored = np.ascontiguousarray(turned[orientation])
        Image.fromarray(stored).save(path, kind, exif=block, **options)

    return make


def xmp_only(path, photo):
    xmp = b'<x:xmpmeta xmlns:x="adobe:ns:meta/"><a tiff:Orientation="6"/></x:xmpmeta>'
    Image.fromarray(photo).save(path, "JPEG", quality=95, xmp=xmp)


def deep(bits, kind, colour=True, **options):
    """Values of so many bits in samples of sixteen."""

    def make(path, photo):
        samples = photo if colour else grey_of(photo)
        samples = (samples.astype(np.uint16) << (bits - 8)) | (samples >> (16 - bits))
        if kind == "tif":
            how = "rgb" if colour else "minisblack"
            tifffile.imwrite(path, samples, photometric=how, **options)
        else:
            backwards = samples[..., ::-1] if colour else samples
            assert cv2.imwrite(f"{path}.{kind}", backwards)
            path.with_name(f"{path.name}.{kind}").rename(path)

    return make


def lzw16(path, photo):
    how = [cv2.IMWRITE_TIFF_COMPRESSION, 5]
    _, data = cv2.imencode(".tif", photo[..., ::-1].astype(np.uint16) << 4, how)
    path.write_bytes(data.tobytes())


def min_is_white(path, photo):
    inverted = 65535 - (grey_of(photo).astype(np.uint16) << 8)
    tifffile.imwrite(path, inverted, photometric="miniswhite")


def thumbnail_first(path, photo):
    small = np.ascontiguousarray(photo[::4, ::4])
    with tifffile.TiffWriter(path) as tiff:
        tiff.write(small, photometric="rgb", subfiletype=1, subifds=1, metadata=None)
        tiff.write(photo, photometric="rgb", subfiletype=0, metadata=None)


def small_page_first(path, photo):
    with tifffile.TiffWriter(path) as tiff:
        tiff.write(np.ascontiguousarray(photo[::4, ::4]), photometric="rgb", metadata=None)
        tiff.write(photo, photometric="rgb", metadata=None, compression="deflate")


def two_pages(path, photo):
    with tifffile.TiffWriter(path) as tiff:
        for page in (photo, 255 - photo):
            tiff.write(page, photometric="rgb", metadata=None)


def cut_out(kind, under=0, **options):
    """The sky cut away, with something of one colour under it."""

    def make(path, photo):
        _, rows = scene(*photo.shape[:2])
        sky = np.arange(len(photo))[:, None] < rows
        stored = np.dstack([photo, np.where(sky, 0, 255).astype(np.uint8)])
        stored[sky, :3] = under
        Image.fromarray(stored).save(path, kind, **options)

    return make


def chunk(kind, data, checksum=None):
    checksum = zlib.crc32(kind + data) if checksum is None else checksum
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)


def png_with(*chunks):
    """Chunks put before the pixels of a PNG."""

    def make(path, photo):
        data = io.BytesIO()
        Image.fromarray(photo).save(data, "PNG")
        data = data.getvalue()
        path.write_bytes(data[:33] + b"".join(chunks) + data[33:])

    return make


def png_without_end(path, photo):
    pillow("PNG")(path, photo)
    path.write_bytes(path.read_bytes()[:-12])


def linear_png(path, photo):
    linear = np.rint(65535 * (photo / 255.0) ** 2.2).astype(np.uint16)
    _, data = cv2.imencode(".png", linear[..., ::-1])
    data = data.tobytes()
    path.write_bytes(data[:33] + chunk(b"gAMA", struct.pack(">I", 100_000)) + data[33:])


def late_exif(path, photo):
    """Turned, with the orientation behind the pixels."""
    data = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(np.rot90(photo))).save(data, "PNG")
    block = Image.Exif()
    block[0x0112] = 6
    exif_chunk = chunk(b"eXIf", block.tobytes().removeprefix(b"Exif\0\0"))
    path.write_bytes(data.getvalue()[:-12] + exif_chunk + data.getvalue()[-12:])


def jpeg_cut(share, **options):
    def make(path, photo):
        Image.fromarray(photo).save(path, "JPEG", quality=92, **options)
        data = path.read_bytes()
        path.write_bytes(data[: int(len(data) * share)])

    return make


def jpeg_without_end(**options):
    def make(path, photo):
        Image.fromarray(photo).save(path, "JPEG", quality=95, **options)
        path.write_bytes(path.read_bytes()[:-2])

    return make


def text_bomb(kind=b"zTXt", megabytes=3):
    return chunk(kind, b"Comment\0\0" + zlib.compress(b"x" * (megabytes << 20)))


READ = {
    "heic.heic": heic(),
    "ten_bit.hif": heic(),
    "avif.avif": pillow("AVIF", quality=95),
    "jfif.jfif": pillow("JPEG", quality=95),
    "jpe.jpe": pillow("JPEG", quality=95, progressive=True),
    "jpeg2000.jp2": pillow("JPEG2000"),
    "codestream.j2k": pillow("JPEG2000"),
    "gif.gif": pillow("GIF"),
    "exif_6.jpg": exif(6, "JPEG", quality=95),
    "exif_5.webp": exif(5, "WEBP", lossless=True),
    "exif_3.tif": exif(3, "TIFF"),
    "late_exif.png": late_exif,
    "xmp.jpg": xmp_only,
    "16.png": deep(16, "png"),
    "12.png": deep(12, "png"),
    "14.png": deep(14, "png", colour=False),
    "10.tif": deep(10, "tif"),
    "12_grey.tif": deep(12, "tif", colour=False),
    "12_deflate.tif": deep(12, "tif", compression="deflate", predictor=True),
    "12_planar.tif": deep(12, "tif", byteorder=">"),
    "12_lzw.tif": lzw16,
    "min_is_white.tif": min_is_white,
    "thumbnail_first.tif": thumbnail_first,
    "small_page_first.tif": small_page_first,
    "two_pages.tif": two_pages,
    "cut_out_black.png": cut_out("PNG"),
    "cut_out_white.png": cut_out("PNG", under=255),
    "cut_out.webp": cut_out("WEBP", lossless=True),
    "linear.png": linear_png,
    "big_text.png": png_with(text_bomb()),
    "big_itxt.png": png_with(chunk(b"iTXt", b"C\0\1\0\0\0" + zlib.compress(b"x" * (4 << 20)))),
    "bad_text.png": png_with(chunk(b"tEXt", b"Comment\0hello", checksum=5)),
    "bad_ztxt.png": png_with(chunk(b"zTXt", b"Comment\0\0no deflate")),
    "no_end.png": png_without_end,
    "no_end.jpg": jpeg_without_end(),
    "no_end_progressive.jpg": jpeg_without_end(progressive=True),
}
"""How to make a file that is read, by its name; the photo in it is that of `scene`."""

NOTED = {
    "12.png": "12 bits",
    "14.png": "14 bits",
    "10.tif": "10 bits",
    "12_lzw.tif": "12 bits",
    "two_pages.tif": "2 pages, of which the first",
    "small_page_first.tif": "2 pages, of which the largest",
    "cut_out_black.png": "transparent",
    "bad_text.png": "damaged tEXt chunk",
    "no_end.png": "without its end marker",
    "no_end.jpg": "without its end marker",
    "no_end_progressive.jpg": "without its end marker",
}
"""What the note about some of them says."""


def raw(path, photo):
    """A DNG: a thumbnail, and the mosaic of the sensor below it."""
    with tifffile.TiffWriter(path) as tiff:
        version = [(50706, 1, 4, b"\1\4\0\0", True)]
        small = np.ascontiguousarray(photo[::4, ::4])
        tiff.write(small, photometric="rgb", subfiletype=1, subifds=1, extratags=version)
        tiff.write(photo[..., 1].astype(np.uint16), photometric="cfa", subfiletype=0)


def starts(*data):
    def make(path, _):
        path.write_bytes(b"".join(data) + bytes(500))

    return make


def floats(path, photo):
    tifffile.imwrite(path, photo.astype(np.float32) / 255, photometric="rgb")


def signed(path, photo):
    tifffile.imwrite(path, grey_of(photo).astype(np.int16), photometric="minisblack")


def webp_in_tiff(path, photo):
    thumbnail_first(path, photo)
    data = bytearray(path.read_bytes())
    with tifffile.TiffFile(path) as tiff:
        below = tiff.pages[0].pages[0]
        where = [below.tags["Compression"].valueoffset]
    for place in where:
        struct.pack_into("<H", data, place, 50001)
    path.write_bytes(data)


REFUSED = {
    "dng.dng": (raw, "raw file"),
    "hidden_raw.tif": (raw, "raw file"),
    "plain.nef": (pillow("TIFF"), "raw file"),
    "cr3.cr3": (starts(b"\0\0\0\x18ftypcrx "), "raw file"),
    "hidden_cr2.tif": (starts(b"II*\0\x10\0\0\0CR\2\0"), "raw file"),
    "raf.raf": (starts(b"FUJIFILMCCD-RAW 0201"), "raw file"),
    "orf.orf": (starts(b"IIRO\x08\0\0\0"), "raw file"),
    "rw2.rw2": (starts(b"IIU\0\x08\0\0\0"), "raw file"),
    "unknown.arw": (starts(b"nothing"), "raw file"),
    "jxl.jxl": (starts(b"\0\0\0\x0cJXL \r\n\x87\n"), "JPEG XL"),
    "codestream.jpg": (starts(b"\xff\x0a"), "JPEG XL"),
    "float.tif": (floats, "floating-point"),
    "signed.tif": (signed, "negative"),
    "webp.tif": (webp_in_tiff, "WEBP"),
    "pfm.pfm": (starts(b"Pf\n16 16\n-1.0\n", bytes(1100)), "floating-point"),
    "cut.jpg": (jpeg_cut(0.7), "truncated"),
    "cut_progressive.jpg": (jpeg_cut(0.7, progressive=True), "truncated"),
    "cut_progressive_late.jpg": (jpeg_cut(0.97, progressive=True), "truncated"),
    "psd.psd": (starts(b"8BPS\0\1"), "Photoshop"),
}
"""How to make a file that is refused, and what its sentence says."""
