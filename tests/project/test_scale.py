"""What the page on scale shows runs: lines that read a table, scripts and manifests of clusters."""

import os
import re
import subprocess
import sys

import pytest
import yaml

import skyline_viz as sv
from annotate.formats import export_labels
from skyline_viz.running.line_table import failed_row, found_row, write_lines
from testing import ROOT
from testing.exports import label, put
from testing.programs.commands import scene

PAGE = (ROOT / "docs" / "scale.md").read_text(encoding="utf-8")
COUNTS = {
    "pandas": "len(found)",
    "polars": "len(found)",
    "duckdb": "len(found.fetchall())",
    "datasets": "found['train'].num_rows",
}
GOOD, ALL = 4, 6


def blocks(kind, holding):
    """Blocks of code of a kind that hold a text."""
    found = re.findall(rf"```{kind}\n(.*?)```", PAGE, re.DOTALL)
    return [one for one in found if holding in one]


def readers():
    (block,) = blocks("python", "pandas.read_parquet")
    return {line.partition(".")[0]: line for line in block.splitlines()}


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    """A folder with a table, and one with shards of it."""
    home = tmp_path_factory.mktemp("tables")
    found = sv.Detector().detect(scene(0)[0])
    rows = [found_row(f"{number}.jpg", "", "ab", found) for number in range(GOOD)]
    rows += [failed_row(f"{number}.jpg", "it is empty.") for number in range(GOOD, ALL)]
    (home / "one").mkdir()
    write_lines(home / "one" / "lines.parquet", rows, {"digest": "d"})
    (home / "many" / "lines.parquet").mkdir(parents=True)
    for number in range(3):
        file = home / "many" / "lines.parquet" / f"shard-{number + 1:05d}-of-00003.parquet"
        write_lines(file, rows[number::3], {"digest": "d"})
    return home


def read(module, line, folder, tmp_path):
    """How many rows a line of the page reads, as a program of its own."""
    code = f"import {module}\nfound = {line}\nprint({COUNTS[module]})\n"
    caches = {name: str(tmp_path) for name in ("HF_HOME", "HF_DATASETS_CACHE")}
    offline = {"HF_HUB_OFFLINE": "1", "HF_DATASETS_DISABLE_PROGRESS_BARS": "1"}
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
        env={**os.environ, **caches, **offline},
        timeout=120,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return int(done.stdout)


def test_the_page_names_four_readers():
    assert list(readers()) == list(COUNTS)


@pytest.mark.parametrize("module", COUNTS)
def test_each_reads_a_table_with_the_line_of_the_page(module, tables, tmp_path):
    line = readers()[module]
    wanted = GOOD if "error is null" in line else ALL
    assert read(module, line, tables / "one", tmp_path) == wanted


@pytest.mark.parametrize("module", COUNTS)
def test_each_reads_a_folder_of_shards_as_the_page_says(module, tables, tmp_path):
    assert "or `lines.parquet/*.parquet` for the others" in " ".join(PAGE.split())
    line = readers()[module]
    if module != "pandas":
        line = line.replace("lines.parquet", "lines.parquet/*.parquet")
    wanted = GOOD if "error is null" in line else ALL
    assert read(module, line, tables / "many", tmp_path) == wanted


def said_by(script, **variables):
    """What a script would run of this program, by the words."""
    stands_in = 'source() { :; }; skyline-viz() { echo "$@"; }\n'
    done = subprocess.run(
        ["bash", "-euc", stands_in + script],
        capture_output=True,
        text=True,
        check=True,
        env={"PATH": os.environ["PATH"], **variables},
    )
    return done.stdout.split()


def after(words, name):
    return words[words.index(name) + 1]


def test_the_array_of_jobs_covers_all_shards_and_uses_the_processors_it_has():
    (script,) = blocks("bash", "SLURM_ARRAY_TASK_ID")
    first, last = map(
        int, re.search(r"^#SBATCH --array=(\d+)-(\d+)$", script, re.MULTILINE).groups()
    )
    for number in (first, last):
        words = said_by(script, SLURM_ARRAY_TASK_ID=str(number), SLURM_CPUS_PER_TASK="8")
        assert after(words, "--shard") == f"{number}/{last}"
        assert after(words, "--workers") == "8"
    assert first == 1


def test_the_job_of_kubernetes_covers_all_shards():
    (manifest,) = blocks("yaml", "completionMode: Indexed")
    job = yaml.safe_load(manifest)
    spec = job["spec"]
    (container,) = spec["template"]["spec"]["containers"]
    assert (job["kind"], container["command"]) == ("Job", ["bash", "-c"])
    (script,) = container["args"]
    count = spec["completions"]
    for index in (0, count - 1):
        words = said_by(script, JOB_COMPLETION_INDEX=str(index))
        assert after(words, "--shard") == f"{index + 1}/{count}"
        assert after(words, "--workers") == container["resources"]["requests"]["cpu"]


def test_labels_are_led_to_a_storage_as_the_page_says(tmp_path):
    put(tmp_path / "photos", "deep/a.png")
    labels = [label(tmp_path / "photos", "deep/a.png")]
    out = tmp_path / "skylines-parquet"
    export_labels(labels, tmp_path / "photos", out, "parquet")
    (block,) = blocks("python", "skylines-parquet")
    code = f"import polars\n{block}"
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True, timeout=120)
    (item,) = sv.open_dataset(tmp_path / "alps.parquet")
    assert (item.where, item.truth()) == ("s3://photos/alps/deep/a.png", labels[0].skyline)
