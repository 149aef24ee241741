#!/bin/sh
# Checks the Python package as its users get it: builds the wheel, installs it where there is no
# cargo, and runs the tests and the notebooks there. Everything lies in target/python.
#
# Where PyPI cannot be reached this says so and ends well, unless SNELL_NEED_PYTHON is set.
set -eu
cd "$(dirname "$0")/../.."
ROOT=$PWD
WORK=target/python
VENV=$WORK/venv
HERE=compare/python

left_out() {
    printf 'LEFT OUT: the checks of the Python package. %s\n' "$1"
    [ -z "${SNELL_NEED_PYTHON:-}" ] || exit 1
    exit 0
}

mkdir -p $WORK
python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || left_out "They need Python 3.11 or later"
if ! cmp -s $HERE/requirements.txt $VENV/requirements.txt; then
    rm -rf $VENV
    python3 -m venv $VENV 2>$WORK/venv.log || left_out "python3 -m venv fails: see $WORK/venv.log"
    $VENV/bin/pip install -q --retries 1 -r $HERE/requirements.txt >$WORK/pip.log 2>&1 ||
        left_out "PyPI cannot be reached, or lacks a version: see $WORK/pip.log"
    cp $HERE/requirements.txt $VENV/requirements.txt
fi
rm -rf $WORK/wheels
(cd $HERE && "$ROOT/$VENV/bin/maturin" build --quiet --release --out "$ROOT/$WORK/wheels")
$VENV/bin/pip install -q --no-deps --force-reinstall $WORK/wheels/*.whl
# From here on as for a user: no cargo, and nothing of this folder but the tests.
export PATH="$ROOT/$VENV/bin" SNELL_WHEELS="$ROOT/$WORK/wheels"
unset SNELL
$VENV/bin/python -m mypy --config-file $HERE/pyproject.toml --cache-dir $WORK/mypy -p snell
exec $VENV/bin/python -P -m pytest -c $HERE/pyproject.toml --rootdir $HERE -o cache_dir="$ROOT/$WORK/pytest" $HERE/tests
