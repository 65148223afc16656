.PHONY: demo test check bench reliability pictures samples lock clean

SOURCES = pyproject.toml requirements-dev.txt tools/setup.sh

demo: .venv/.installed-run  ## Find the skylines of the samples, or of PHOTOS=FOLDER, and show them.
	.venv/bin/skyline-viz demo $(if $(PHOTOS),"$(PHOTOS)")

test: check  ## Everything that must hold: lint, types, doctests, tests.
	.venv/bin/python -m pytest -n auto --dist loadscope

check: .venv/.installed-dev  ## Lint and types only.
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/mypy
	.venv/bin/lint-imports

bench: .venv/.installed-dev  ## The README's figures; DATA=FOLDER names the folder of the real data sets.
	.venv/bin/python -m benchmarks $(if $(DATA),"$(DATA)")

reliability: .venv/.installed-dev  ## The tables of docs/reliability.md: faults, kills, offline minutes, hostile files.
	.venv/bin/python -m benchmarks.reliability

pictures: .venv/.installed-dev  ## Draw the pictures of the docs again.
	.venv/bin/skyline-viz inspect sample_data/images/hazy-1.jpg --truth sample_data/masks/hazy-1.png \
	    --method default paper --screenshot docs/inspect.jpg
	.venv/bin/python -m tools.viewer_pictures docs
	.venv/bin/skyline-viz gallery sample_data --screenshot docs/gallery.jpg
	.venv/bin/python -m tools.page_pictures docs

samples: .venv/.installed-run  ## Rebuild sample_data, byte for byte.
	.venv/bin/skyline-viz render --out sample_data

lock: .venv/.installed-dev  ## Renew the locked development set.
	.venv/bin/uv pip compile --quiet --universal --python-version 3.11 --group dev pyproject.toml \
	    --no-emit-index-url --no-header --output-file requirements-dev.txt

clean:
	rm -rf .venv build dist skyline-demo skyline-gallery

.venv/.installed-run: $(SOURCES)
	tools/setup.sh run

.venv/.installed-dev: $(SOURCES)
	tools/setup.sh dev
