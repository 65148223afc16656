"""A product of vectors that the compiler does not find by itself, spelt in its own language.

A filter of seven taps a row fits into one vector of eight. But numba's compiler makes vectors of
loops that are long, not of many short ones. This is the only place where LLVM is told what to do:
it has 8 lanes of float32 in its language on every processor, and makes of them what there is, two
registers of four if need be. The order of the sums is fixed, so all processors round alike.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

LANES = 8
"""Values that are multiplied at once."""

_FLOAT = ir.FloatType()
_VECTOR = ir.VectorType(_FLOAT, LANES)


@intrinsic
def dot_lanes(
    typing_context: Any,  # noqa: ANN401, ARG001
    taps: Any,  # noqa: ANN401
    first_tap: Any,  # noqa: ANN401
    tap_stride: Any,  # noqa: ANN401
    values: Any,  # noqa: ANN401
    first_value: Any,  # noqa: ANN401
    stride: Any,  # noqa: ANN401
    rows: Any,  # noqa: ANN401
) -> tuple[Any, Callable[..., Any]]:
    """Sum of products over `LANES` neighbours in each of some rows, float32.

    Each lane is summed down the rows; then lanes four apart are added, two apart, and the last two.
    No index is checked: the caller sees to it that all lie inside.

    Args:
        typing_context: Numba's.
        taps: Flat float32 array.
        first_tap: Place of the first tap of the first row.
        tap_stride: Places from a row of taps to the next.
        values: Flat float32 array.
        first_value: Place of the first value.
        stride: Places from a row of values to the next.
        rows: A tuple with an entry for each row: its length, not what is in it, is known when this
            is compiled, and no loop is left of them.
    """
    del first_tap, tap_stride, first_value, stride
    place = types.uintp
    signature = types.float32(taps, place, place, values, place, place, rows)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:  # noqa: ANN401
        taps, tap, tap_stride, values, value, stride, _ = arguments
        kinds = signature.args
        taps = context.make_array(kinds[0])(context, builder, taps).data
        values = context.make_array(kinds[3])(context, builder, values).data

        def loaded(data: Any, at: Any) -> Any:  # noqa: ANN401
            pointer = builder.bitcast(builder.gep(data, [at]), _VECTOR.as_pointer())
            vector = builder.load(pointer)
            vector.align = 4  # rows begin anywhere
            return vector

        vector = ir.Constant(_VECTOR, [0.0] * LANES)
        for _ in range(kinds[6].count):
            product = builder.fmul(loaded(taps, tap), loaded(values, value))
            vector = builder.fadd(vector, product)
            tap, value = builder.add(tap, tap_stride), builder.add(value, stride)
        lanes = LANES
        while lanes > 1:  # add the upper half to the lower one
            lanes //= 2
            halves = (
                builder.shuffle_vector(
                    vector,
                    vector,
                    ir.Constant(ir.VectorType(ir.IntType(32), lanes), list(range(at, at + lanes))),
                )
                for at in (0, lanes)
            )
            vector = builder.fadd(*halves)
        return builder.extract_element(vector, ir.Constant(ir.IntType(32), 0))

    return signature, generate
