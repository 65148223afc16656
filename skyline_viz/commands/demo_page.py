"""The page of the demo: one HTML file beside its pictures, which needs no network."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from statistics import median
from urllib.parse import quote


@dataclass(frozen=True)
class Shown:
    """A photo on the page."""

    name: str
    """Its name."""

    overlay: str
    """Path of its overlay, relative to the page."""

    height: int
    """Rows of the photo."""

    width: int
    """Columns of the photo."""

    seconds: float
    """Time that the detection took."""

    a_err: float | None
    """A_err in pixels; None without truth."""

    gross_miss: bool
    """Whether A_err is over 5 % of the height."""

    def line(self, wide: int) -> str:
        """One line for a terminal, with the name in a column of `wide` characters."""
        size = f"{self.width}x{self.height}"
        error = "" if self.a_err is None else f"  A_err {self.a_err:.2f} px"
        return f"{self.name:<{wide}}  {size:>9}  {self.seconds:6.3f} s{error}"


def page(photos: Sequence[Shown]) -> str:
    """HTML of the page: a table of all photos, then each with its lines."""
    errors = [photo.a_err for photo in photos if photo.a_err is not None]
    legend = '<span class="path">magenta</span> is the detected skyline'
    if errors:
        legend += ', <span class="truth">turquoise</span> the truth'
    figures = f"{len(photos)} photo{'s' if len(photos) != 1 else ''}"
    if errors:
        figures += f", median A<sub>err</sub> {median(errors):.2f} px"
    rows = "\n".join(_row(number, photo) for number, photo in enumerate(photos))
    pictures = "\n".join(_figure(number, photo) for number, photo in enumerate(photos))
    heading = '<th scope="col" class="number">A<sub>err</sub></th>' if errors else ""
    return f"""<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Skylines</title>
<style>{_STYLE}</style>
<header>
<h1>Skylines</h1>
<p>{figures}; {legend}. <a href="contact_sheet.jpg">All on one sheet</a>.</p>
</header>
<main>
<div class="pictures">
{pictures}
</div>
<table>
<thead><tr><th scope="col">photo</th><th scope="col" class="number">size</th>
<th scope="col" class="number">time</th>{heading}</tr></thead>
<tbody>
{rows}
</tbody>
</table>
</main>
</html>
"""


def _row(number: int, photo: Shown) -> str:
    error = "" if photo.a_err is None else f'<td class="number">{_error(photo)}</td>'
    return (
        f'<tr><th scope="row"><a href="#photo-{number}">{escape(photo.name)}</a></th>'
        f'<td class="number">{photo.width} &times; {photo.height}</td>'
        f'<td class="number">{photo.seconds:.3f} s</td>{error}</tr>'
    )


def _figure(number: int, photo: Shown) -> str:
    source = quote(photo.overlay)
    says = f"{photo.name} with its detected skyline"
    error = ""
    if photo.a_err is not None:
        says += f" and the truth, {photo.a_err:.2f} pixels apart on average"
        error = f" · A<sub>err</sub> {_error(photo)}"
    return (
        f'<figure id="photo-{number}"><a href="{source}">'
        f'<img src="{source}" alt="{escape(says)}" loading="lazy"></a>'
        f"<figcaption>{escape(photo.name)}{error}</figcaption></figure>"
    )


def _error(photo: Shown) -> str:
    return f"{photo.a_err:.2f} px" + (" <strong>gross miss</strong>" if photo.gross_miss else "")


_STYLE = """
:root { color-scheme: light dark; --page: #e6e6e6; --ink: #1c1c1c; --soft: #555; --line: #bdbdbd; }
@media (prefers-color-scheme: dark) {
  :root { --page: #2b2b2b; --ink: #ececec; --soft: #b0b0b0; --line: #555; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 90rem; padding: 1.5rem; background: var(--page);
  color: var(--ink); font: 1rem/1.5 system-ui, sans-serif; }
h1 { margin: 0; font-size: 1.5rem; font-weight: 600; }
header p { margin: .25rem 0 1.5rem; color: var(--soft); }
a { color: inherit; text-underline-offset: .15em; }
a:focus-visible { outline: 3px solid var(--ink); outline-offset: 2px; }
.path, .truth { color: var(--ink); text-decoration: underline; text-decoration-thickness: .25em;
  text-decoration-skip-ink: none; }
.path { text-decoration-color: #ff2d95; }
.truth { text-decoration-color: #00d1b2; }
.pictures { display: grid; gap: 1.25rem; align-items: start;
  grid-template-columns: repeat(auto-fill, minmax(min(26rem, 100%), 1fr)); }
figure { margin: 0; }
figure:target img { outline: 3px solid var(--ink); outline-offset: 2px; }
img { display: block; max-width: 100%; max-height: 20rem; }
figcaption { margin-top: .35rem; color: var(--soft); overflow-wrap: anywhere; }
strong { color: var(--ink); }
table { margin-top: 2rem; border-collapse: collapse; }
th, td { padding: .3rem 1.5rem .3rem 0; border-bottom: 1px solid var(--line); text-align: left;
  font-weight: 400; }
thead th { color: var(--soft); }
.number { text-align: right; font-variant-numeric: tabular-nums; }
"""
