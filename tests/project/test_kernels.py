"""Compiled loops: what Python and another compiled loop both call gives back no array.

numba keeps what it compiled on disk. Read from there, after a function that holds a copy of it, one
that gives back arrays fails: "descr is NULL".
"""

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PLAIN = {"None", "int", "float", "bool"}


def functions():
    for package in ("skyline_viz", "annotate"):
        for file in (ROOT / package).rglob("*.py"):
            for node in ast.walk(ast.parse(file.read_text("utf-8"))):
                if isinstance(node, ast.FunctionDef):
                    yield node, any("njit" in ast.unparse(one) for one in node.decorator_list)


def calls(function):
    for node in ast.walk(function):
        if isinstance(node, ast.Call):
            yield ast.unparse(node.func).rpartition(".")[2]


def test_compiled_functions_that_both_call_give_back_no_array():
    found = list(functions())
    compiled = {one.name: ast.unparse(one.returns) for one, is_compiled in found if is_compiled}
    inside = {name for one, is_compiled in found if is_compiled for name in calls(one)}
    outside = {name for one, is_compiled in found if not is_compiled for name in calls(one)}
    both = compiled.keys() & inside & outside
    assert "column_margin" in both  # there are some
    assert {name: compiled[name] for name in both if compiled[name] not in PLAIN} == {}
