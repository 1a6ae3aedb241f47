"""The chain a study runs under its options: alternative laws, put where the base chain has its own."""

from __future__ import annotations

import numpy as np

from mixedlub.chain.base_models import GEAR_LOSS
from mixedlub.chain.model import Chain, Law
from mixedlub.laws import film, oil, shear
from mixedlub.laws.loss import over_path
from mixedlub.study.schema import Options


def mean_hertz_pressure(hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Mean pressure of a line contact (Pa), :math:`p_m = \pi p_0 / 4`; Hertz 1881.

    >>> round(float(mean_hertz_pressure(0.9642e9)) / 1e9, 4)
    0.7573
    """
    return 0.25 * np.pi * hertz_pressure


def fluid_friction_at_mean_pressure(shear_stress: np.ndarray, hertz_pressure: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of the film (-), :math:`\mu_E = \tau / p_m`, with the mean Hertz pressure.

    A second reading of the contact pressure of Hong, Aneshansley, Talbot, Gear Technology, eq. 2.

    >>> round(float(fluid_friction_at_mean_pressure(22.57e6, 0.9437e9)), 5)
    0.03045
    """
    return shear_stress / mean_hertz_pressure(hertz_pressure)


def roelands_at_mean_pressure(
    viscosity: np.ndarray, pressure_viscosity: np.ndarray, hertz_pressure: np.ndarray
) -> np.ndarray:
    r"""Roelands viscosity at the mean Hertz pressure (Pa s), :math:`\eta(\pi p_0/4)`.

    >>> round(float(roelands_at_mean_pressure(0.01489, 14.81e-9, 0.9642e9)), 1)
    19.9
    """
    return oil.roelands_viscosity(viscosity, pressure_viscosity, mean_hertz_pressure(hertz_pressure))


def barus_at_maximum_pressure(
    viscosity: np.ndarray, pressure_viscosity: np.ndarray, hertz_pressure: np.ndarray
) -> np.ndarray:
    r"""Barus viscosity at the largest Hertz pressure (Pa s), :math:`\eta_0 e^{\alpha p_0}`.

    >>> round(float(barus_at_maximum_pressure(0.01489, 14.81e-9, 0.9642e9)))
    23688
    """
    return oil.barus_viscosity(viscosity, pressure_viscosity, hertz_pressure)


def barus_at_mean_pressure(
    viscosity: np.ndarray, pressure_viscosity: np.ndarray, hertz_pressure: np.ndarray
) -> np.ndarray:
    r"""Barus viscosity at the mean Hertz pressure (Pa s), :math:`\eta_0 e^{\alpha \pi p_0/4}`.

    >>> round(float(barus_at_mean_pressure(0.01489, 14.81e-9, 0.9642e9)))
    1106
    """
    return oil.barus_viscosity(viscosity, pressure_viscosity, mean_hertz_pressure(hertz_pressure))


def averaged_mesh_loss(
    friction: np.ndarray, mean_weight: np.ndarray, mean_sliding_speed: np.ndarray, transmitted_force: np.ndarray
) -> np.ndarray:
    r"""Sliding power lost in the mesh from separate averages (W), :math:`P = \hat\mu\, \hat V_s\, F_m`.

    The plain mean of friction over the path, a quarter of the sum of the sliding speeds at its two ends, and
    the force at the base circle. Source: Hong, Aneshansley, Talbot, Gear Technology, eq. 3 and 4.

    >>> weight = np.array([[0.25, 0.5, 0.25]])
    >>> float(averaged_mesh_loss(np.full((1, 3), 0.05), weight, 2.0, 1000.0)[0, 0])
    100.0
    """
    return over_path(friction, mean_weight) * (mean_sliding_speed * transmitted_force)


_CHOICES: dict[str, dict[object, tuple[str, Law]]] = {
    "film": {"dowson_higginson_minimum": ("film_thickness", film.dowson_higginson)},
    "effective_viscosity": {"secant": ("shear_stress", shear.ree_eyring_secant)},
    "contact_pressure": {"mean": ("fluid_friction", fluid_friction_at_mean_pressure)},
    "averaging": {"paper": ("mesh_loss", averaged_mesh_loss)},
}

_VISCOSITY: dict[tuple[str, str], Law] = {
    ("roelands", "maximum"): oil.roelands_viscosity,
    ("roelands", "mean"): roelands_at_mean_pressure,
    ("barus", "maximum"): barus_at_maximum_pressure,
    ("barus", "mean"): barus_at_mean_pressure,
}


def study_chain(options: Options) -> Chain:
    """The gear chain with the laws that the options ask for.

    >>> dict(study_chain(Options(effective_viscosity="secant")))["shear_stress"].__name__
    'ree_eyring_secant'
    """
    chosen: dict[str, Law] = {"contact_viscosity": _VISCOSITY[options.viscosity_law, options.viscosity_pressure]}
    for option, laws in _CHOICES.items():
        replacement = laws.get(getattr(options, option))
        if replacement is not None:
            chosen[replacement[0]] = replacement[1]
    return tuple((name, chosen.get(name, law)) for name, law in GEAR_LOSS)
