"""Arrays whose columns have names."""

from typing import TYPE_CHECKING, Any, Tuple

import numpy

if TYPE_CHECKING:  # numpy's own class takes a type in brackets from numpy 1.22 on, but not everywhere
    _Numbers = numpy.ndarray[Any, numpy.dtype[numpy.float64]]
else:
    _Numbers = numpy.ndarray


class Columns(_Numbers):
    """An array (N, n) whose columns are also found by their names: `run.torque["E1"]` is one of them, (N,)."""

    names: Tuple[str, ...] = ()

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, list) and key and all(isinstance(name, str) for name in key):
            return named(numpy.column_stack([self[name] for name in key]), key)
        if not isinstance(key, str):
            return self.view(numpy.ndarray)[key]
        if key not in self.names:
            raise KeyError(f'no column "{key}", there are {", ".join(self.names) or "none"}')
        return self.view(numpy.ndarray)[:, self.names.index(key)]

    def __array_finalize__(self, other: Any) -> None:
        """Copies have the names; what has other columns has none."""
        names = getattr(other, "names", ())
        self.names = names if self.ndim == 2 and self.shape[1] == len(names) else ()

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        """What is computed of them is an array like any other."""
        return array[()] if return_scalar or array.ndim == 0 else numpy.asarray(array)

    def __reduce__(self) -> Any:
        return named, (numpy.asarray(self), self.names)


def named(values: Any, names: Any) -> "Columns":
    """The values (N, n) with n names of columns, without a copy."""
    columns = values.view(Columns)
    columns.names = tuple(names)
    return columns  # type: ignore[no-any-return]
