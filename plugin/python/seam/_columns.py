"""Arrays whose columns have names."""

import numpy


class Columns(numpy.ndarray):
    """An array (N, n) whose columns are also found by their names: `run.torque["E1"]` is one of them, (N,)."""

    names: tuple = ()

    def __getitem__(self, key):
        if not isinstance(key, str):
            return self.view(numpy.ndarray)[key]
        if key not in self.names:
            raise KeyError(f'no column "{key}", there are {", ".join(self.names) or "none"}')
        return self.view(numpy.ndarray)[:, self.names.index(key)]

    def __array_wrap__(self, array, context=None, return_scalar=False):
        """What is computed of them is an array like any other."""
        return array[()] if return_scalar else numpy.asarray(array)

    def __reduce__(self):
        return named, (numpy.asarray(self), self.names)


def named(values, names):
    """The values (N, n) with n names of columns, without a copy."""
    columns = values.view(Columns)
    columns.names = tuple(names)
    return columns
