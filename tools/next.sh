#!/usr/bin/env bash
# Tests of all that shows something in the viewer, with the newest rerun-sdk that the user's package index has, whatever
# pyproject.toml pins. Everything else is as it is locked, but for what that version itself wants newer. Made for once a
# week: it says which version was tried, and ends with the status of the tests.
set -euo pipefail
cd "$(dirname "$0")/.."
export VIRTUAL_ENV=.venv-next NUMBA_CACHE_DIR=.venv-next/numba
uv=(.venv/bin/uv --quiet --no-config)
python=$VIRTUAL_ENV/bin/python

say() { printf 'skyline-viz next: %s\n' "$*" >&2; }
version() { "$python" -c 'from importlib.metadata import version; print(version("rerun-sdk"))'; }

"${uv[@]}" venv --clear --python "$(.venv/bin/python -c 'import sys; print(sys._base_executable)')" "$VIRTUAL_ENV"
"${uv[@]}" pip install --require-hashes -r requirements-dev.txt
locked=$(version)
"${uv[@]}" pip install --upgrade-package rerun-sdk 'rerun-sdk[catalog,notebook]'
"${uv[@]}" pip install --no-deps --no-build-isolation --editable .
newest=$(version)
if [ "$newest" = "$locked" ]; then
    say "rerun-sdk $newest is the newest, and the one that is locked"
else
    say "rerun-sdk $newest is the newest; $locked is locked"
fi
status=0
PATH="$PWD/$VIRTUAL_ENV/bin:$PATH" "$python" -m pytest -n auto --dist loadscope -q --tb=short -p no:cacheprovider \
    tests/viewer tests/gallery tests/e2e/test_viewer.py tests/e2e/test_gallery.py tests/e2e/test_web_viewer.py \
    tests/e2e/test_flag_page.py || status=$?
if [ "$status" = 0 ]; then
    say "all of them hold with rerun-sdk $newest"
else
    say "with rerun-sdk $newest the tests above fail"
fi
exit "$status"
