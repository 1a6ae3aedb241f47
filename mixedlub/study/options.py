"""The chain a study runs under its options: the chosen laws, put where the base chain has its own."""

from __future__ import annotations

import inspect
from functools import wraps
from typing import Any

from mixedlub.chain.balance import balanced
from mixedlub.chain.base_models import GEAR_LOSS
from mixedlub.chain.model import Chain, Law
from mixedlub.laws.contact import asperity_pressure, mean_hertz_pressure
from mixedlub.laws.yielding import chang_etsion_bogy_pressure
from mixedlub.slots import VISCOSITY
from mixedlub.study.schema import Options


def at_mean_pressure(law: Law) -> Law:
    """A law with the mean Hertz pressure in place of the largest; one that reads no pressure as it is.

    >>> from mixedlub.laws.oil import roelands_viscosity
    >>> round(float(at_mean_pressure(roelands_viscosity)(0.01489, 14.81e-9, 0.9642e9)), 1)
    19.9
    """
    names = tuple(inspect.signature(law).parameters)
    if "hertz_pressure" not in names:
        return law
    place = names.index("hertz_pressure")

    @wraps(law)
    def averaged(*values: Any) -> Any:
        return law(*values[:place], mean_hertz_pressure(values[place]), *values[place + 1 :])

    head, _, rest = (inspect.getdoc(law) or "").partition("\n")
    averaged.__doc__ = f"{head} Taken at the mean Hertz pressure.\n{rest}"
    return averaged


def at_hardness(strength: float, hardness: float) -> Law:
    """Pressure of asperities of which plasticity of this strength lets those yield that `asperity_plasticity` does.

    >>> gap = (0.1806, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)
    >>> [round(float(at_hardness(strength, 6e9)(*gap)) / 1e9, 1) for strength in (0.0, 1.0)]
    [2.1, 1.1]
    """

    yielding: Law = chang_etsion_bogy_pressure

    @wraps(asperity_pressure)
    def law(*values: Any) -> Any:
        elastic = asperity_pressure(*values)
        return elastic + strength * (yielding(*values, hardness) - elastic)

    return law


def study_chain(options: Options) -> Chain:
    """The gear chain with the laws that the options ask for.

    >>> dict(study_chain(Options(effective_viscosity="secant")))["shear_stress"].__name__
    'ree_eyring_secant'
    """
    chosen = options.laws
    if options.viscosity_pressure == "mean":
        chosen[VISCOSITY.quantity] = at_mean_pressure(chosen[VISCOSITY.quantity])
    chain = tuple((name, chosen.get(name, law)) for name, law in GEAR_LOSS)
    return chain if options.balance == "none" else balanced(chain)
