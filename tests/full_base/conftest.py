"""An emulator of the shipped solutions of one oil, kept where a run finds it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.run import Rows
from mixedlub.ehl.solve import CONVERGED
from mixedlub.full_base import store
from mixedlub.full_base.box import Box
from mixedlub.full_base.emulator import Emulator, trained
from mixedlub.full_base.solutions import Bodies, Matter, Varied
from mixedlub.full_base.store import CACHE
from mixedlub.rig.build import lubricant
from mixedlub.schema.findings import collected
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.solutions import kept
from mixedlub.solutions.rigs import STEEL

OIL = "atf"
BOX: Box = {
    "radius": (1e-3, 30e-3),
    "hertz_pressure": (0.2e9, 2.0e9),
    "entrainment_speed": (0.1, 50.0),
    "slide_roll_ratio": (0.02, 1.9),
    "oil_temperature": (308.15, 388.15),
    "viscosity": (0.6, 1.7),
    "pressure_viscosity": (0.6, 1.7),
    "eyring_stress": (0.4, 2.6),
}
"""Range of the shipped solutions; factors are only declared, for runs that calibrate the oil."""


def varied(found: Contacts, factors: np.ndarray | None = None) -> Varied:
    """Contacts with factors of their oil, by default 1."""
    fields = {name: getattr(found, name) for name in Contacts.__dataclass_fields__}
    return Varied(**fields, factors=np.ones((len(found.radius), 3)) if factors is None else factors)


def rows_of(table: pd.DataFrame, way: str = "thermal") -> Rows:
    """Results of shipped thermal or isothermal solutions, as the solver returns them."""
    return {
        "central_film": table[f"{way}_central_film_nm"].to_numpy() * 1e-9,
        "friction_coefficient": table[f"{way}_friction"].to_numpy(),
        "central_film_error": table[f"{way}_film_error_percent"].to_numpy() * 0.01,
        "friction_coefficient_error": table[f"{way}_friction_error_percent"].to_numpy() * 0.01,
        "status": table[f"{way}_status"].to_numpy(),
    }


@pytest.fixture(scope="session")
def matter() -> Matter:
    """The oil between steel bodies."""
    with collected():
        oil = lubricant(Lubricant(oil=OIL))
    return Matter(oil, Bodies(STEEL, 46.0, 7800.0, 470.0))


@pytest.fixture(scope="session")
def table() -> pd.DataFrame:
    """Shipped solutions of the oil: 200 contacts that were solved."""
    every = kept.read_solutions(kept.KEPT)
    own = every[(every["oil"] == OIL) & (every["thermal_status"] == CONVERGED)]
    return own.head(200).reset_index(drop=True)


@pytest.fixture(scope="session")
def emulator(matter: Matter, table: pd.DataFrame) -> Emulator:
    """Emulator of the shipped solutions."""
    return trained(matter, BOX, varied(kept.contacts_of(table)), rows_of(table))


@pytest.fixture
def cache(emulator: Emulator, matter: Matter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Cache folder with the emulator, as a run finds it."""
    folder = tmp_path / "cache" / "full_solutions" / matter.digest
    folder.mkdir(parents=True)
    emulator.save(folder / f"shipped-{store.fit_fingerprint()}.npz")
    monkeypatch.setenv(CACHE, str(tmp_path / "cache"))
    monkeypatch.setattr(store, "solved", lambda *given, **how: pytest.fail("solved again"))
    return folder
