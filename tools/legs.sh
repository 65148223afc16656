#!/usr/bin/env bash
# Tests on other Pythons and with other versions than the locked ones: the lowest that pyproject.toml allows on the
# lowest Python, with scikit-learn; and the newest on the highest Python, without any extra. Left to `make test` are
# the extra deep, whose torch takes gigabytes for each leg, and all that starts programs, viewers and browsers.
set -euo pipefail
cd "$(dirname "$0")/.."
uv=(.venv/bin/uv --quiet --no-config)

say() { printf 'skyline-viz legs: %s\n' "$*" >&2; }

# Print the path of a Python of a version: on the PATH, kept by pyenv, or from uv.
find_python() {
    local path
    for path in "python$1" "/usr/bin/python$1" "${PYENV_ROOT:-$HOME/.pyenv}"/versions/"$1".*/bin/python; do
        if "$path" -c "import sys; sys.exit('%d.%d' % sys.version_info[:2] != '$1')" 2>/dev/null; then
            command -v "$path"
            return 0
        fi
    done
    "${uv[@]}" python install "$1" 2>/dev/null && "${uv[@]}" python find "$1"
}

# Run tests. $1: version of Python; $2: of the dependencies, lowest-direct or highest, as uv calls them; then more for uv.
leg() {
    local folder=".venv-$2-$1" python
    if ! python=$(find_python "$1"); then
        say "NOT RUN: Python $1 with $2 versions; there is no Python $1 here, and none could be had."
        return 0
    fi
    say "Python $1 with $2 versions"
    "${uv[@]}" venv --clear --python "$python" "$folder"
    VIRTUAL_ENV=$folder "${uv[@]}" pip install --resolution "$2" --upgrade -r pyproject.toml "${@:3}"
    VIRTUAL_ENV=$folder "${uv[@]}" pip install pytest pytest-xdist hypothesis httpx
    # Others' warnings are theirs: the lowest version of one package warns of the newest of another.
    PYTHONPATH=. NUMBA_CACHE_DIR=$folder/numba "$folder/bin/python" -m pytest -n auto --dist loadscope -q \
        -W default -p no:cacheprovider tests/test_*.py tests/annotate/engine tests/annotate/server tests/command_line \
        tests/datasets tests/evaluation tests/methods/test_dense_scores.py skyline_viz annotate
}

leg 3.11 lowest-direct --extra methods
leg 3.13 highest
