"""Pages of the site that lie outside of docs/: their links are turned the way the site needs them.

A hook of mkdocs (`mkdocs.yml`). The same links lead somewhere in a checkout and on the site.
"""

import re
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parent.parent
PAGES = {
    "contributing.md": "CONTRIBUTING.md",
    "changelog.md": "CHANGELOG.md",
    "benchmarks.md": "benchmarks/results.md",
}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages of `PAGES`, and the icon of the labelling page."""
    for page, source in {**PAGES, "assets/icon.svg": "annotate/static/icon.svg"}.items():
        files.append(File.generated(config, page, abs_src_path=str(ROOT / source)))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Turn links into and out of docs/ into links between pages."""
    del config, files
    if page.file.src_uri in PAGES:
        return re.sub(r"\]\((?:\.\./)?docs/", "](", markdown)
    for name, source in PAGES.items():
        up = "../" * (page.file.src_uri.count("/") + 1)
        markdown = markdown.replace(f"]({up}{source}", f"]({up[3:]}{name}")
    return markdown
