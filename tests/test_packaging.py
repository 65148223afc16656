"""What is said about the package in more than one file, and that the locked versions are whole."""

import re
import tomllib
from pathlib import Path

import pytest

import skyline_viz as sv

ROOT = Path(__file__).resolve().parents[1]
LOCKS = ("requirements.txt", "requirements-dev.txt")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def locked(name):
    """Each locked requirement with its hashes, comments left out."""
    lines = re.sub(r"^ *#.*\n", "", text(name), flags=re.MULTILINE).replace("\\\n", "")
    return [line.split() for line in lines.splitlines()]


def test_the_citation_is_of_this_version_and_names_the_paper_of_the_project():
    citation = text("CITATION.cff")
    assert re.search(r"^version: (.*)$", citation, re.MULTILINE)[1] == sv.__version__
    assert PROJECT["urls"]["Paper"].endswith(re.search(r"doi: (\S+)", citation)[1])
    assert f"license: {PROJECT['license']}" in citation
    assert PROJECT["authors"] == [{"name": "skyline-viz maintainers"}]
    assert "name: skyline-viz maintainers" in citation


def test_the_changelog_has_a_section_for_this_version():
    versions = re.findall(r"^## (.*)$", text("CHANGELOG.md"), re.MULTILINE)
    assert versions[:2] == ["Unreleased", sv.__version__]


def test_the_package_takes_its_licence_and_its_notice_along():
    assert PROJECT["license-files"] == ["LICENSE", "NOTICE"]
    for name in PROJECT["license-files"]:
        assert len(text(name)) > 1000


@pytest.mark.parametrize("name", LOCKS)
def test_every_locked_version_has_hashes_and_names_no_host(name):
    assert "://" not in text(name)
    for requirement in locked(name):
        assert re.fullmatch(r"[a-z0-9.-]+(\[[a-z,-]+\])?==\S+", requirement[0]), requirement[0]
        hashes = [word for word in requirement if word.startswith("--hash=")]
        assert hashes, requirement[0]
        assert all(re.fullmatch(r"--hash=sha256:[0-9a-f]{64}", word) for word in hashes)


def test_what_running_installs_is_what_is_tested():
    run, dev = ({requirement[0] for requirement in locked(name)} for name in LOCKS)
    assert run <= dev


def test_every_dependency_is_locked():
    names = {requirement[0].partition("==")[0] for requirement in locked("requirements.txt")}
    for requirement in PROJECT["dependencies"]:
        assert re.match(r"[a-z0-9-]+", requirement)[0] in names


def test_every_target_of_the_makefile_is_explained():
    makefile = text("Makefile")
    phony = re.search(r"^\.PHONY: (.*)$", makefile, re.MULTILINE)[1].split()
    explained = re.findall(r"^([a-z]+):.*## \S.*\.$", makefile, re.MULTILINE)
    assert sorted(explained) == sorted(phony)
