"""Ranking of the pairings of a study by their mean power loss."""

from __future__ import annotations

from typing import TYPE_CHECKING

from profiles.errors import InputError

if TYPE_CHECKING:
    import pandas as pd

PAIRING = ["pinion_surface", "gear_surface"]
LOSS = "power_loss_W"
CONDITIONS = ["torque_Nm", "speed_rpm", "oil_temperature_C"]
BAND = {"mean_low_W": "power_loss_low_W", "mean_high_W": "power_loss_high_W"}
"""Columns of the ranking with the mean ends of the bands, and the columns of the results."""


def ranking(results: pd.DataFrame) -> pd.DataFrame:
    """Pairings in the order of their power loss averaged over all conditions, the best first.

    Parameters
    ----------
    results : pandas.DataFrame
        Table of a study: ``results.to_pandas()`` of ``ml.study.run``, or `results.csv`.

    Returns
    -------
    pandas.DataFrame
        Mean power loss (W), excess over the best pairing (%), share of the conditions at which the pairing is the
        best (%), share of the conditions inside the range of the laws (%), and the mean ends of the bands if any.

    Raises
    ------
    profiles.errors.InputError
        If the table has no column of pairings or losses.

    Examples
    --------
    >>> import pandas as pd
    >>> rows = {"torque_Nm": [50, 150, 50, 150], "power_loss_W": [10.0, 30.0, 11.0, 25.0]}
    >>> same = {"pinion_surface": list("aabb"), "gear_surface": list("aabb"), "speed_rpm": 500, "oil_temperature_C": 60}
    >>> found = ranking(pd.DataFrame({**rows, **same}))
    >>> found["pinion_surface"].tolist(), found["over_best_percent"].round(1).tolist()
    (['b', 'a'], [0.0, 11.1])
    """
    lacking = [name for name in (*PAIRING, *CONDITIONS, LOSS) if name not in results]
    if lacking:
        raise InputError("is no table of a study: a column is missing", where="ranking: results", value=lacking[0])
    best = results.groupby(CONDITIONS)[LOSS].transform("min")
    marked = results.assign(is_best=results[LOSS] <= best)
    groups = marked.groupby(PAIRING, sort=False)
    found = groups[LOSS].mean().rename("mean_loss_W").to_frame()
    found["over_best_percent"] = (100.0 * (found["mean_loss_W"] / found["mean_loss_W"].min() - 1.0)).round(1)
    found["best_at_percent"] = (100.0 * groups["is_best"].mean()).round(1)
    if "validity" in marked:
        sound = ~marked["validity"].astype(str).str.startswith("not_quantitative")
        found["quantitative_percent"] = (100.0 * sound.groupby([marked[n] for n in PAIRING]).mean()).round(1)
    for name, column in BAND.items():
        if column in marked:
            found[name] = groups[column].mean()
    return found.sort_values("mean_loss_W", kind="stable").reset_index()
