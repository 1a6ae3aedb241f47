r"""Mixed contacts: a solved film and asperities share the load.

The film carries the share :math:`1/\gamma` of the load. After Johnson, Greenwood and Poon (Wear 19 (1972) 91) it equals
the film of a smooth contact with this load and the modulus :math:`E'/\gamma`, hence the same width; here that contact
is solved, not taken from a film law. Asperities carry the rest at the central film, by a law that studies choose from.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.base_model.balanced import balanced_film, sharing_exponent
from mixedlub.base_model.chains import ASPERITIES
from mixedlub.chain.model import Model
from mixedlub.chain.slots import ASPERITY_AREA, ASPERITY_LOAD
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.solve import CONVERGED, DIVERGED, Way
from mixedlub.laws.contact import mean_hertz_pressure
from mixedlub.laws.film import dowson_toyoda

if TYPE_CHECKING:
    import xarray

MISSED_LOAD = 1e-7
"""Largest relative error of the load carried by film and asperities together."""
_MOST_SOLUTIONS = 15
"""Cost limit. Solutions of the film's contact; most mixed contacts take four to six."""
_LEAST, _MOST = -600.0, 7.0
"""Logits of the asperities' share: numerically zero, and all but a thousandth of the load."""
_FURTHEST = 3.0
"""Largest change of the logit in a step."""
_READ = ("m0", "m2", "m4", "reduced_modulus", "hardness", "film_thickness")
"""Quantities available to laws of asperities."""


@dataclass(frozen=True)
class Asperities:
    """Composite roughness (moments of the profile in SI), law of the asperities, and their friction coefficient.

    ``hardness`` (Pa): of the softer body; NaN if the law does not read it.
    """

    m0: float
    m2: float
    m4: float
    law: str
    boundary_friction: float
    hardness: float = np.nan

    def carried(self, film: np.ndarray, modulus: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mean pressure of the asperities at a film thickness (Pa), and ratio of real to nominal area."""
        own = {
            "area_ratio": ASPERITY_AREA.choices[self.law].law,
            "asperity_pressure": ASPERITY_LOAD.choices[self.law].law,
        }
        chain = tuple((name, own.get(name, law)) for name, law in ASPERITIES if name != "asperity_load_share")
        model = Model(chain, _READ, ("asperity_pressure", "area_ratio"))
        given = {name: np.asarray(getattr(self, name)) for name in ("m0", "m2", "m4", "hardness")}
        found = model({**given, "film_thickness": film, "reduced_modulus": modulus})
        return found["asperity_pressure"], found["area_ratio"]


def laws() -> tuple[str, ...]:
    """Laws of asperities that read only available quantities."""
    made = {name for name, _ in ASPERITIES}
    both = [name for name in ASPERITY_LOAD.choices if name in ASPERITY_AREA.choices]

    def known(law: Any) -> bool:
        return set(inspect.signature(law).parameters) <= {*_READ, *made}

    return tuple(n for n in both if known(ASPERITY_LOAD.choices[n].law) and known(ASPERITY_AREA.choices[n].law))


def yielding() -> tuple[str, ...]:
    """Laws of `laws` that read the hardness."""
    return tuple(n for n in laws() if "hardness" in inspect.signature(ASPERITY_LOAD.choices[n].law).parameters)


def solve_mixed(oil: Oil, contacts: Contacts, asperities: Asperities, *, thermal: bool, way: Way) -> xarray.Dataset:
    """Solutions of mixed contacts: load of film and asperities, real area, and friction of both.

    Friction of the asperities heats neither film nor bodies.
    """
    count = len(contacts.radius)
    data = way.solved(oil, contacts, thermal=thermal)
    full, mean = data["central_film"].to_numpy(), mean_hertz_pressure(contacts.pressure)
    share, exponent = _start(full, mean, contacts, asperities), np.full(count, sharing_exponent(dowson_toyoda))
    before: tuple[np.ndarray, np.ndarray] = np.log(full), np.zeros(count)
    missed = np.full(count, np.nan)
    active = np.flatnonzero(np.isfinite(share))
    for _ in range(_MOST_SOLUTIONS):
        if not len(active):
            break
        part = _film_contacts(contacts.take(active), share[active])
        data = _replaced(data, active, way.solved(oil, part, thermal=thermal))
        film = data["central_film"].to_numpy()[active]
        now = np.log(film), -np.log1p(-share[active])
        exponent[active] = _exponent(now, tuple(old[active] for old in before), exponent[active])
        for old, new in zip(before, now, strict=True):
            old[active] = new
        wanted = _share(film, mean[active], contacts.take(active), asperities)
        missed[active] = wanted - share[active]
        step = _step(share[active], wanted, exponent[active], film, mean[active], contacts.take(active), asperities)
        todo = np.isfinite(film) & (np.abs(missed[active]) > MISSED_LOAD)
        share[active] = np.where(todo, _moved(share[active], step), share[active])
        active = active[todo]
    return _with_shares(data, contacts, asperities, share, missed)


def _film_contacts(contacts: Contacts, share: np.ndarray) -> Contacts:
    """Contacts with the film's share of the load and the reduced modulus."""
    return replace(contacts, line_load=contacts.line_load * (1.0 - share), modulus=contacts.modulus * (1.0 - share))


def _share(film: np.ndarray, mean: np.ndarray, contacts: Contacts, asperities: Asperities) -> np.ndarray:
    return np.asarray(asperities.carried(film, contacts.modulus)[0] / mean)


def _start(full: np.ndarray, mean: np.ndarray, contacts: Contacts, asperities: Asperities) -> np.ndarray:
    """Asperities' share for a film that grows by the exponent of the base law."""
    film = balanced_film(
        full, mean, sharing_exponent(dowson_toyoda), lambda h: asperities.carried(h, contacts.modulus)[0]
    )
    return np.clip(_share(film, mean, contacts, asperities), 0.0, 1.0 - 1e-3)


def _exponent(now: tuple[np.ndarray, ...], before: tuple[np.ndarray, ...], last: np.ndarray) -> np.ndarray:
    """Exponent of the film over the ratio of total to film load, from the last two solutions."""
    (film, growth), (film_before, growth_before) = now, before
    moved = growth - growth_before
    far = np.abs(moved) > 1e-7
    found = (film - film_before) / np.where(far, moved, 1.0)
    return np.where(far & (found > 0.0) & (found < 1.0), found, last)


def _step(
    share: np.ndarray,
    wanted: np.ndarray,
    exponent: np.ndarray,
    film: np.ndarray,
    mean: np.ndarray,
    contacts: Contacts,
    asperities: Asperities,
) -> np.ndarray:
    """Newton step of the logit of the share, from the logarithmic difference of both sides."""
    thicker = _share(film * 1.001, mean, contacts, asperities)
    with np.errstate(divide="ignore", invalid="ignore"):
        falls = np.minimum(np.log(thicker / wanted) / np.log(1.001), 0.0)
        step = np.log(wanted / share) / ((1.0 - share) - falls * exponent * share)
    return np.clip(np.nan_to_num(step, nan=0.0), -_FURTHEST, _FURTHEST)


def _moved(share: np.ndarray, step: np.ndarray) -> np.ndarray:
    """Share after a step of its logit."""
    with np.errstate(divide="ignore"):
        logit = np.clip(np.log(share) - np.log1p(-share) + step, _LEAST, _MOST)
    return np.asarray(1.0 / (1.0 + np.exp(-logit)))


def _replaced(data: xarray.Dataset, rows: np.ndarray, new: xarray.Dataset) -> xarray.Dataset:
    """Data with rows replaced by new data."""
    found = data.copy(deep=True)
    for name, values in new.items():
        found[name].to_numpy()[rows] = values.to_numpy()
    return found


SHARES: Mapping[str, str] = {
    "asperity_load_share": "share of the load that asperities carry",
    "load_missed": "load of film and asperities over the whole load, less one",
    "area_ratio": "real area of contact over the nominal one",
    "mixed_friction_coefficient": "friction of film and asperities, by the whole load",
}
"""Results of a mixed contact in addition to those for its film."""


def _with_shares(
    data: xarray.Dataset, contacts: Contacts, asperities: Asperities, share: np.ndarray, missed: np.ndarray
) -> xarray.Dataset:
    film = data["central_film"].to_numpy()
    solved = np.isfinite(film) & (np.abs(missed) <= MISSED_LOAD)
    data["status"] = ("contact", np.where(solved, CONVERGED, DIVERGED))
    area = asperities.carried(film, contacts.modulus)[1]
    of_film = data["friction_coefficient"].to_numpy() * (1.0 - share)
    friction = of_film + np.sign(contacts.sliding) * asperities.boundary_friction * share
    for (name, meaning), values in zip(SHARES.items(), (share, missed, area, friction), strict=True):
        data[name] = ("contact", np.where(solved, values, np.nan), {"units": "1", "long_name": meaning})
    return data
