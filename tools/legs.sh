#!/usr/bin/env bash
# The tests of the package without its extras, on other Pythons and with other versions than the locked ones:
# the lowest that pyproject.toml allows on the lowest Python, and the newest on the highest. Programs that tests
# start and real browsers are left to `make test`.
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

# Run the tests. $1: version of Python; $2: of the dependencies, lowest or newest.
leg() {
    local folder=".venv-$2-$1" python resolution
    if ! python=$(find_python "$1"); then
        say "NOT RUN: Python $1 with the $2 versions; there is no Python $1 here, and none could be had."
        return 0
    fi
    resolution=$([ "$2" = lowest ] && echo lowest-direct || echo highest)
    say "Python $1 with the $2 versions"
    "${uv[@]}" venv --clear --python "$python" "$folder"
    VIRTUAL_ENV=$folder "${uv[@]}" pip install --resolution "$resolution" --upgrade -r pyproject.toml
    VIRTUAL_ENV=$folder "${uv[@]}" pip install pytest pytest-xdist hypothesis httpx
    # Others' warnings are theirs: the lowest version of one package warns of the newest of another.
    PYTHONPATH=. NUMBA_CACHE_DIR=$folder/numba "$folder/bin/python" -m pytest -n auto --dist loadscope -q \
        -W default -p no:cacheprovider "${tests[@]}"
}

tests=(tests/test_*.py)
if [ $# = 2 ]; then
    leg "$@"
else
    leg 3.11 lowest
    leg 3.13 newest
fi
