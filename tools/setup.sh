#!/usr/bin/env bash
# Make the virtual environment .venv and install what the project needs, in the versions that were tested.
#   tools/setup.sh run    what running needs: the package and requirements.txt
#   tools/setup.sh dev    what development needs: requirements-dev.txt, which holds the same versions
# System packages that are missing are installed with apt-get, where that is allowed without a password;
# NO_APT=1 does without, and says what would be missing.
set -euo pipefail
cd "$(dirname "$0")/.."
kind=${1:-run}

say() { printf 'skyline-viz setup: %s\n' "$*" >&2; }

# Run a command that takes long: say now and then that it goes on, and what it said when it fails.
watched() {
    local log pid status=0 began=$SECONDS told=$SECONDS
    log=$(mktemp)
    "$@" >"$log" 2>&1 &
    pid=$!
    while kill -0 "$pid" 2>/dev/null; do
        sleep 1
        if [ $((SECONDS - told)) -ge "${TELL_EVERY:-15}" ]; then
            told=$SECONDS
            say "$((SECONDS - began)) s: $(tail -n 1 "$log" | tr -d '\r' | cut -c 1-90)"
        fi
    done
    wait "$pid" || status=$?
    [ "$status" = 0 ] || tail -n 15 "$log" >&2
    rm -f "$log"
    return "$status"
}

# a Python from 3.11 to 3.13 that can make virtual environments
usable() { "$1" -c 'import sys, venv, ensurepip; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))' 2>/dev/null; }

find_python() {
    local name
    for name in "${PYTHON:-python3}" python3.13 python3.12 python3.11 /usr/bin/python3; do
        if command -v "$name" >/dev/null 2>&1 && usable "$name"; then
            command -v "$name"
            return 0
        fi
    done
    return 1
}

# Install system packages; what apt-get says is shown only when it fails.
apt_install() {
    local as_root=() log
    [ -z "${NO_APT:-}" ] || return 1
    command -v apt-get >/dev/null 2>&1 || return 1
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null || return 1
        as_root=(sudo -n)
    fi
    say "installing $* on this system with apt-get (NO_APT=1 does without)"
    log=$(mktemp)
    if "${as_root[@]}" apt-get update -q >"$log" 2>&1 &&
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qy "$@" >>"$log" 2>&1; then
        rm "$log"
    else
        tail -n 5 "$log" >&2
        rm "$log"
        return 1
    fi
}

if [ ! -x .venv/bin/python ] || ! usable .venv/bin/python; then
    if ! python=$(find_python); then
        apt_install python3 python3-venv || true
        python=$(find_python) || {
            say "Python 3.11, 3.12 or 3.13 with its venv module is missing and could not be installed."
            say "Install it (on Debian and Ubuntu: apt-get install python3 python3-venv), then run this again,"
            say "or name one: PYTHON=/path/to/python3.12 make ..."
            exit 1
        }
    fi
    say "making .venv with $("$python" --version)"
    rm -rf .venv
    "$python" -m venv .venv
fi

pip=(watched .venv/bin/python -m pip --disable-pip-version-check --no-input)
if [ "$kind" = dev ]; then
    say "installing the locked development set; minutes, by the network"
    "${pip[@]}" install --require-hashes -r requirements-dev.txt
    # The extra deep. Torch is not in the locked set: that is for all systems, and torch would bring
    # gigabytes of CUDA packages into it, on machines that find a build for the CPU alone, too.
    say "installing torch"
    "${pip[@]}" install 'torch==2.13.0' || {
        say "torch 2.13.0 could not be installed; tests of the extra deep will be reported as not run."
    }
else
    say "installing the locked set that running needs; a minute or more, by the network"
    "${pip[@]}" install --require-hashes -r requirements.txt
fi
"${pip[@]}" install --no-deps --no-build-isolation -e .

# The viewer draws pictures without a screen when there is a Vulkan driver; Mesa's works anywhere.
vulkan() { ls /usr/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json >/dev/null 2>&1; }
if [ "$(uname)" = Linux ] && ! vulkan; then
    apt_install mesa-vulkan-drivers libvulkan1 || {
        say "mesa-vulkan-drivers and libvulkan1 could not be installed; pictures without a screen need them."
        [ "$kind" = run ]  # tests look at such pictures
    }
fi
# Tests drive the labelling page in a real browser.
browser() { command -v chromium || command -v chromium-browser || command -v google-chrome; }
if [ "$kind" = dev ] && [ "$(uname)" = Linux ] && ! browser >/dev/null 2>&1; then
    apt_install chromium || .venv/bin/python -m playwright install chromium || {
        say "neither apt-get nor Playwright could install Chromium; tests of the labelling page need it."
        exit 1
    }
fi
# ... and check the page's JavaScript with tsc and eslint, under the locked set's Node.
if [ "$kind" = dev ]; then
    say "installing what checks the page's JavaScript"
    PATH="$PWD/.venv/bin:$PATH" watched npm ci --prefix tools/page --ignore-scripts || {
        say "npm could not install typescript and eslint, which check the labelling page; is its registry reachable?"
        exit 1
    }
fi
touch ".venv/.installed-$kind"
