.DEFAULT_GOAL := help
.PHONY: help demo test check docs bounds fuzz legs next bench reliability pictures samples bank sky seen lock clean

SOURCES = pyproject.toml requirements.txt tools/setup.sh
MKDOCS = NO_MKDOCS_2_WARNING=1 .venv/bin/mkdocs build --strict --quiet
PYTEST = .venv/bin/python -m pytest
# The tests of each module with a compiled loop.
KERNEL_TESTS = $(shell grep -rl 'numba.njit' skyline_viz annotate --include='*.py' | \
    sed 's,^skyline_viz/,,; s,[^/]*$$,test_&,; s,^,tests/,')

help:  ## Say what can be made.
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "make %-12s %s\n", $$1, $$2 }' Makefile

demo: .venv/.installed-run  ## Find the skylines of the samples, or of PHOTOS=FOLDER, and show them.
	.venv/bin/skyline-viz demo $(if $(PHOTOS),"$(PHOTOS)")

test: check  ## Everything that must hold: make check, and all tests, which reach 95 % of lines and branches.
	.venv/bin/coverage erase
	.venv/bin/coverage run -m pytest -n auto --dist loadscope
	.venv/bin/coverage combine --quiet
	.venv/bin/coverage report

check: .venv/.installed-dev  ## Lint, types, direction of imports, the page, docs with all their links.
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/mypy
	.venv/bin/lint-imports
	PATH="$(CURDIR)/.venv/bin:$$PATH" npm run --prefix tools/page --silent check
	$(MKDOCS)

docs: .venv/.installed-dev  ## The docs as a site, to read without a network: site/index.html.
	$(MKDOCS)
	@echo "Open site/index.html in a browser."

bounds: .venv/.installed-dev  ## The tests of the compiled loops, every index checked.
	NUMBA_BOUNDSCHECK=1 NUMBA_CACHE_DIR=.venv/bounds $(PYTEST) -n auto --dist loadscope $(KERNEL_TESTS)

fuzz: .venv/.installed-dev  ## The properties, with twenty times as many examples, drawn at random.
	HYPOTHESIS_PROFILE=random $(PYTEST) -n auto --dist load -m hypothesis

legs: .venv/.installed-dev  ## The tests with the lowest and the newest versions, on Python 3.11 and 3.13.
	tools/legs.sh

next: .venv/.installed-dev  ## The tests of the viewer with the newest rerun-sdk, whatever is pinned; for once a week.
	tools/next.sh

bench: .venv/.installed-dev  ## The README's figures; DATA=FOLDER names the real data sets, MODELS=FOLDER sky models that have not seen one of them, ONLY=PART a part.
	.venv/bin/python -m benchmarks $(if $(DATA),"$(DATA)" $(if $(MODELS),"$(MODELS)")) $(if $(ONLY),--only $(ONLY))

reliability: .venv/.installed-dev  ## The tables of docs/reliability.md: faults, kills, offline minutes, hostile files.
	.venv/bin/python -m benchmarks.reliability

pictures: .venv/.installed-dev  ## Draw the pictures of the docs again.
	.venv/bin/skyline-viz inspect sample_data/images/hazy-2.jpg --truth sample_data/masks/hazy-2.png \
	    --method default paper --screenshot docs/inspect.jpg
	.venv/bin/python -m tools.viewer_pictures docs
	.venv/bin/skyline-viz gallery sample_data --screenshot docs/gallery.jpg
	.venv/bin/python -m tools.flag_picture docs
	.venv/bin/python -m tools.report_picture docs
	.venv/bin/python -m tools.guideline_pictures
	.venv/bin/python -m tools.page_pictures docs

samples: .venv/.installed-run  ## Rebuild sample_data, byte for byte.
	.venv/bin/skyline-viz render --out sample_data

SCENES = build/rendered

bank: .venv/.installed-run  ## Train the shipped filter bank; DATA=FOLDER names the folder of the real data sets.
	for kind in clear hazy cloudy snow foreground spires desert rover; do \
	    .venv/bin/skyline-viz render --kind $$kind --seed 2000 --count 8 --out $(SCENES) || exit 1; done
	.venv/bin/skyline-viz train "$(DATA)/web_dataset" "$(DATA)/mountains" "$(DATA)/uav" $(SCENES) \
	    --out skyline_viz/filter_bank.npz

SKY_SCENES = build/sky-scenes
LEARN_SKY = .venv/bin/skyline-viz train "$(DATA)/web_dataset" "$(DATA)/mountains" "$(DATA)/uav" $(SKY_SCENES) \
    "$(DATA)/phone_unlabelled" "$(DATA)/webcam" --teacher "$(TEACHER)" --workers 1

sky: .venv/.installed-dev  ## Train the shipped sky models; DATA=FOLDER as for bank, TEACHER=FILE.onnx knows what is sky.
	.venv/bin/skyline-viz render --kind all --camera any --seed 1000 --count 30 --width 480 --height 320 \
	    --out $(SKY_SCENES)
	.venv/bin/skyline-viz render --kind all --camera any --seed 2000 --count 20 --width 360 --height 480 \
	    --out $(SKY_SCENES)
	$(LEARN_SKY) --learn-sky small --steps 14000 --out skyline_viz/sky_small.onnx
	$(LEARN_SKY) --learn-sky large --steps 5000 --out skyline_viz/sky_large.onnx

seen: .venv/.installed-dev  ## Put fingerprints of the training photographs into what is shipped; DATA=FOLDER as for bank.
	.venv/bin/python -m tools.photos_seen "$(DATA)"

LOCK = .venv/bin/uv pip compile --quiet $(if $(UPGRADE),--upgrade) --universal --python-version 3.11 --generate-hashes \
    --no-emit-index-url --no-header pyproject.toml --group build

lock: .venv/.installed-dev  ## Lock what development and running need; UPGRADE=1 takes the newest versions.
	$(LOCK) --group dev --output-file requirements-dev.txt
	$(LOCK) --constraints requirements-dev.txt --output-file requirements.txt

clean:  ## Remove the environments and what was built and shown.
	rm -rf .venv .venv-* tools/page/node_modules build dist site skyline-demo skyline-gallery .coverage .coverage.*

.venv/.installed-run: $(SOURCES)
	tools/setup.sh run

.venv/.installed-dev: $(SOURCES) requirements-dev.txt tools/page/package-lock.json
	tools/setup.sh dev
