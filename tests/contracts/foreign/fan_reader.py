"""Traces of a stylus that writes its heights in hexadecimal digits, in nm and 0.5 um apart."""

import numpy as np

from profiles import Profile


class FanReader:
    name = "fan"
    format = "trace of the fan's maker"

    def magic(self, source):
        return source.data.startswith(b"FANTRACE")

    def read(self, source):
        heights = np.array([int(word, 16) for word in source.data.split()[1:]]) * 1e-9
        return Profile(heights, 0.5e-6, name=source.name)


READER = FanReader()
