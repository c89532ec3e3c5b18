"""Arrays from what users give, with messages that name the place."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
else:
    # What checks types reads the line above; the import of numpy.typing would cost a millisecond.
    Floats = np.ndarray


_DOUBLE = np.dtype(np.float64)


def floats(value: Any, what: str) -> Floats:
    """An array of finite doubles; everything else is a TypeError or a ValueError."""
    if type(value) is np.ndarray and value.dtype is _DOUBLE and value.flags.c_contiguous:
        return value
    if isinstance(value, (str, bytes)):
        raise TypeError(f"found {value!r} as {what}, expected numbers")
    try:
        array = np.asarray(value)
    except ValueError as fault:
        raise ValueError(f"found lists of unequal length as {what}, expected an array: {fault}") from None
    if array.dtype.kind not in "fiu":
        kind = ragged(value)
        if kind is not None:
            raise ValueError(f"found lists of unequal length as {what} ({kind}), expected an array")
        raise TypeError(f"found values of type {array.dtype} as {what}, expected real numbers")
    return np.asarray(array, dtype=np.float64, order="C")


def ragged(value: Any) -> str | None:
    """Where lists differ in length, in words."""
    if not isinstance(value, (list, tuple)):
        return None
    lengths = [len(row) if isinstance(row, (list, tuple, np.ndarray)) else -1 for row in value]
    for index, length in enumerate(lengths):
        if length != lengths[0]:
            return f"[{index}] has {length}, [0] has {lengths[0]}" if min(length, lengths[0]) >= 0 else f"[{index}]"
    return None


def finite(array: Floats, what: str) -> Floats:
    """The array, if all of it is finite."""
    # One product tells most arrays from those with an infinity or a NaN; that of large numbers may overflow.
    if math.isfinite(np.vdot(array, array)):
        return array
    bad = np.argwhere(~np.isfinite(array))
    if len(bad):
        index = ", ".join(str(int(k)) for k in bad[0])
        raise ValueError(f"found {array[tuple(bad[0])]} at [{index}] of {what}, expected finite numbers")
    return array


def fits(found: tuple[int, ...], shape: tuple[int | None, ...]) -> bool:
    """Whether a shape is the expected one, in which None stands for any length."""
    return len(found) == len(shape) and all(want is None or have == want for have, want in zip(found, shape))


def shaped(value: Any, shape: tuple[int | None, ...], what: str) -> Floats:
    """A finite array of this shape; None stands for any length."""
    array = floats(value, what)
    if array.shape != shape and not fits(array.shape, shape):
        wanted = "(" + ", ".join("n" if want is None else str(want) for want in shape) + ("," if len(shape) == 1 else "") + ")"
        raise ValueError(f"found the shape {array.shape} of {what}, expected {wanted}")
    return finite(array, what)
