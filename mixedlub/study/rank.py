"""Ranking of the pairings of a study by their mean power loss, with the uncertainty of the places."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.chain.ranges import GRADES
from mixedlub.schema.findings import collected
from mixedlub.schema.result import described
from mixedlub.study.costs import efficient, pairing_costs, reference
from mixedlub.study.draws import loss_draws
from mixedlub.study.results import Results
from profiles.errors import InputError

if TYPE_CHECKING:
    import pandas as pd

PAIRING = ["pinion_surface", "gear_surface"]
LOSS = "power_loss_W"
CONDITIONS = ["torque_Nm", "speed_rpm", "oil_temperature_C"]
BAND = {"mean_low_W": "power_loss_low_W", "mean_high_W": "power_loss_high_W"}
"""Columns of the ranking with the mean ends of the bands, and the columns of the results."""
UNSOUND = 2
"""Definition. Least grade of a condition outside the range of the laws that forbids numbers."""
ENDS = (0.05, 0.95)
LEAST_CHANCE = 0.05
"""Definition. Least probability of losing less than the best pairing for a pairing to be as good: beyond one end of a
90 % interval."""
MOST_COMPARED = 60
"""Cost limit. Number of pairings that are compared in twos, the best ones: 1770 rows."""
RANKING = described(
    place="place by the mean power loss",
    pinion_surface="text: surface of the pinion",
    gear_surface="text: surface of the gear",
    mean_loss_W="power loss, mean over all conditions",
    mean_loss_W_low90="lower end of its 90 % interval",
    mean_loss_W_high90="upper end of it",
    over_best_percent="excess of the mean power loss over the first place",
    place_low90="lower end of the 90 % interval of the place",
    place_high90="upper end of it",
    best_probability="probability that no other pairing loses less",
    less_than_first_probability="probability that the pairing loses less than the first place",
    as_good_as_best="text: yes where that probability is at least 0.05, or for the first place",
    best_at_percent="share of the conditions at which the pairing is the best",
    quantitative_percent="share of the conditions inside the range of the laws, or a little beyond",
    relative_cost="sum of the relative costs of both finishes",
    saving_percent="mean power loss saved over the cheapest pairing",
    saving_percent_low90="lower end of the 90 % interval of the saving",
    saving_percent_high90="upper end of it",
    efficient="text: yes where every other pairing that loses less costs more",
    efficient_probability="probability of the same",
)
"""Columns of the table of a ranking; intervals and probabilities need bands, savings need costs."""
COMPARISONS = described(
    pinion_surface="text: surface of the pinion",
    gear_surface="text: surface of the gear",
    other_pinion_surface="text: surface of the other pairing's pinion",
    other_gear_surface="text: surface of the other pairing's gear",
    less_probability="probability that the pairing loses less than the other",
    saved_W="power loss of the other pairing less the power loss of the pairing, mean over all conditions",
    saved_W_low90="lower end of the 90 % interval",
    saved_W_high90="upper end of it",
)
"""Columns of the table of pairings in twos."""


def ranking(results: Results | pd.DataFrame) -> pd.DataFrame:
    """Pairings in the order of their power loss averaged over all conditions, the best first.

    Parameters
    ----------
    results : Results or pandas.DataFrame
        Result of ``ml.study.run``, or its table alone: `results.csv`, which has no intervals of places.

    Returns
    -------
    pandas.DataFrame
        Mean power loss (W), excess over the best pairing (%), share of the conditions at which the pairing is the
        best (%) and inside the range of the laws (%). With bands or ``[uncertainty]`` of the study: 90 % intervals of
        loss and place, probability of being the best, and whether the pairing is as good as the best within the
        uncertainty. With ``[costs]``: cost, saving over the cheapest pairing (%), and efficient frontier. Of a table
        alone: the mean ends of the bands if any.

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
    if isinstance(results, Results):
        # The study has said what there is to say about its surfaces.
        with collected():
            draws = loss_draws(results)
        return ranking_with_draws(results, draws)
    lacking = [name for name in (*PAIRING, *CONDITIONS, LOSS) if name not in results]
    if lacking:
        raise InputError("is no table of a study: a column is missing", where="ranking: results", value=lacking[0])
    best = results.groupby(CONDITIONS)[LOSS].transform("min")
    marked = results.assign(is_best=results[LOSS] <= best)
    groups = marked.groupby(PAIRING, sort=False)
    found = groups[LOSS].mean().rename("mean_loss_W").to_frame()
    found["over_best_percent"] = _over_best(found["mean_loss_W"].to_numpy())
    found["best_at_percent"] = (100.0 * groups["is_best"].mean()).round(1)
    if "validity" in marked:
        sound = ~marked["validity"].astype(str).str.startswith(GRADES[UNSOUND:])
        found["quantitative_percent"] = (100.0 * sound.groupby([marked[n] for n in PAIRING]).mean()).round(1)
    for name, column in BAND.items():
        if column in marked:
            found[name] = groups[column].mean()
    return found.sort_values("mean_loss_W", kind="stable").reset_index()


def _over_best(loss: np.ndarray) -> np.ndarray:
    return np.round(100.0 * (loss / loss.min() - 1.0), 1)


def ranking_with_draws(results: Results, draws: np.ndarray | None) -> pd.DataFrame:
    """Ranking of a result, with intervals from draws of the loss if there are any."""
    import pandas as pd

    study, every = results.study, results["power_loss"]
    loss = every.mean(axis=(1, 2, 3))
    graded = [grades >= UNSOUND for grades in results.flags.values()]
    sound = ~np.logical_or.reduce([np.zeros(every.shape, bool), *graded])
    first = int(np.argmin(loss))
    found = pd.DataFrame(study.pairings, columns=PAIRING).assign(mean_loss_W=loss)
    if draws is not None:
        found["mean_loss_W_low90"], found["mean_loss_W_high90"] = np.quantile(draws, ENDS, axis=0)
    found["over_best_percent"] = _over_best(loss)
    if draws is not None:
        places = _places(draws)
        ends = np.quantile(places, ENDS, axis=0, method="inverted_cdf")
        found["place_low90"], found["place_high90"] = ends
        found["best_probability"] = np.mean(places == 1, axis=0)
        less = _less(draws, draws[:, [first]])
        found["less_than_first_probability"] = less
        good = less >= LEAST_CHANCE
        good[first] = True
        found["as_good_as_best"] = _words(good)
    found["best_at_percent"] = np.round(100.0 * (every <= every.min(axis=0)).mean(axis=(1, 2, 3)), 1)
    found["quantitative_percent"] = np.round(100.0 * sound.mean(axis=(1, 2, 3)), 1)
    if study.file.costs:
        found = found.assign(**_of_costs(pairing_costs(study.file.costs, study.pairings), loss, draws))
    found = found.sort_values("mean_loss_W", kind="stable").reset_index(drop=True)
    found.insert(0, "place", np.arange(1, len(found) + 1))
    return found


def _of_costs(cost: np.ndarray, loss: np.ndarray, draws: np.ndarray | None) -> dict[str, np.ndarray]:
    """Columns of cost, saving over the cheapest pairing, and frontier."""
    base = reference(cost, loss)
    found = {"relative_cost": cost, "saving_percent": 100.0 * (1.0 - loss / loss[base])}
    if draws is not None:
        saved = 100.0 * (1.0 - draws / draws[:, [base]])
        found["saving_percent_low90"], found["saving_percent_high90"] = np.quantile(saved, ENDS, axis=0)
    found["efficient"] = _words(efficient(cost, loss))
    if draws is not None:
        found["efficient_probability"] = efficient(cost, draws).mean(axis=0)
    return found


def _words(chosen: np.ndarray) -> np.ndarray:
    return np.where(chosen, "yes", "no")


def _places(draws: np.ndarray) -> np.ndarray:
    """Place of each pairing in each draw: one after the pairings that lose less.

    >>> _places(np.array([[3.0, 1.0, 1.0]])).tolist()
    [[3, 1, 1]]
    """
    from scipy.stats import rankdata

    return np.asarray(rankdata(draws, method="min", axis=1)).astype(int)


def _less(draws: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Share of the draws below the draws of another pairing; equal draws count half."""
    return np.asarray((draws < other).mean(axis=0) + 0.5 * (draws == other).mean(axis=0))


def probabilities(draws: np.ndarray) -> np.ndarray:
    """Probability that the pairing of the row loses less than the pairing of the column; one half on the diagonal.

    >>> probabilities(np.array([[1.0, 2.0], [1.0, 0.5], [1.0, 3.0], [1.0, 4.0]])).tolist()
    [[0.5, 0.75], [0.25, 0.5]]
    """
    return np.stack([_less(draws[:, [i]], draws) for i in range(draws.shape[1])])


def comparisons(results: Results, draws: np.ndarray) -> pd.DataFrame:
    """Every two of the best pairings, smaller mean loss first: probability and saving."""
    import pandas as pd

    study = results.study
    loss = results["power_loss"].mean(axis=(1, 2, 3))
    order = np.argsort(loss, kind="stable")[:MOST_COMPARED]
    rows = []
    for a, b in combinations(order.tolist(), 2):
        saved = draws[:, b] - draws[:, a]
        less = float(_less(draws[:, [a]], draws[:, [b]])[0])
        ends = np.quantile(saved, ENDS).tolist()
        rows.append((*study.pairings[a], *study.pairings[b], less, float(loss[b] - loss[a]), *ends))
    return pd.DataFrame(rows, columns=[column.name for column in COMPARISONS])


def ranking_tables(results: Results) -> dict[str, pd.DataFrame]:
    """Tables of a ranking by file name; without uncertainty the ranking alone."""
    draws = loss_draws(results)
    found = {"ranking": ranking_with_draws(results, draws)}
    if draws is not None and len(results.study.pairings) > 1:
        found["comparisons"] = comparisons(results, draws)
    return found
