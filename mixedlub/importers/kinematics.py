"""Whether the speeds of a table agree: where both surfaces' speeds stand in it, entrainment is their mean."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mixedlub.headers import split, words_of
from mixedlub.importers.sheet import Cells, is_number
from profiles.errors import InputError

PAIRS = (("disc speed", "ball speed"), ("disk speed", "ball speed"), ("lower speed", "upper speed"))
WITHIN = 0.02
"""Share by which a speed may differ from the mean of the two surfaces'."""


def refuse_one_surface(headers: Mapping[str, str], cells: Cells, name: str) -> None:
    """An error where the speed of one surface was taken for entrainment although the other's speed stands there too.

    >>> cells = {"Disc Speed (m/s)": ["1.0", "2.0"], "Ball Speed (m/s)": ["0", "0"]}
    >>> refuse_one_surface({"entrainment_speed_m_s": "Ball Speed (m/s)"}, {"Ball Speed (m/s)": ["1.0"]}, "a.txt")
    >>> refuse_one_surface({"entrainment_speed_m_s": "Disc Speed (m/s)"}, cells, "a.txt")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: a.txt: entrainment_speed_m_s: 'Disc Speed (m/s)': is the speed of one surface; \
entrainment is the mean with that of 'Ball Speed (m/s)': add a column of it to the file
    """
    taken = headers.get("entrainment_speed_m_s")
    if taken is None:
        return
    by_words = {words_of(header): header for header in cells}
    for pair in PAIRS:
        if words_of(taken) not in pair or not all(words in by_words for words in pair):
            continue
        one, other = (by_words[words] for words in sorted(pair, key=lambda words: words != words_of(taken)))
        if split(one)[1] != split(other)[1]:
            continue
        both = [row for row in zip(cells[one], cells[other], strict=True) if all(map(is_number, row))]
        if not both:
            continue
        first, second = np.abs(np.array(both, dtype=float)).T
        if np.max(np.abs(first - second)) > 2.0 * WITHIN * np.max(np.abs(first)):
            rule = f"is the speed of one surface; entrainment is the mean with that of {other!r}: add a column of it"
            raise InputError(f"{rule} to the file", where=f"{name}: entrainment_speed_m_s", value=taken)
