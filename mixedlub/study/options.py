"""The chain of a study: the base chain with the laws chosen by options."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from functools import wraps
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from mixedlub import friction
from mixedlub.base_model.balanced import balanced
from mixedlub.base_model.chains import GEAR_LOSS
from mixedlub.base_model.flattened import Flattening, with_flattening
from mixedlub.chain.model import Chain, Law, Model
from mixedlub.chain.renamed import renamed
from mixedlub.chain.slots import FILM, SLIDING_POWER, SLOTS, VISCOSITY
from mixedlub.laws import contact, heating, loss, oil, pitch_point, safety
from mixedlub.laws.contact import asperity_pressure, mean_hertz_pressure
from mixedlub.laws.film import dowson_higginson
from mixedlub.laws.rough_film import film_over_roughness, rough_film
from mixedlub.laws.yielding import chang_etsion_bogy_pressure
from mixedlub.study.schema import Options

if TYPE_CHECKING:
    from mixedlub.full_base.emulator import Emulator


def at_mean_pressure(law: Law) -> Law:
    """A law at the mean instead of the largest Hertz pressure; unchanged if it does not read the pressure.

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
    """Pressure of asperities with the given strength of plasticity, as in effect `asperity_plasticity`.

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


def study_chain(
    options: Options,
    asperities: Mapping[str, Law] = MappingProxyType({}),
    full: Emulator | None = None,
    flattening: Flattening | None = None,
) -> Chain:
    """Gear chain with the chosen laws, and with ``asperities`` of other heights, full solutions and flattened waves.

    >>> dict(study_chain(Options(effective_viscosity="secant")))["shear_stress"].__name__
    'ree_eyring_secant'
    """
    chosen = {**options.laws, **asperities}
    if options.viscosity_pressure == "mean":
        chosen[VISCOSITY.quantity] = at_mean_pressure(chosen[VISCOSITY.quantity])
    if options.averaging != SLIDING_POWER.default:
        chosen["mean_friction"] = loss.friction_of_path
    chain = tuple((name, chosen.get(name, law)) for name, law in GEAR_LOSS)
    if options.friction != friction.BASE:
        own = friction.find(options.friction).with_coefficients(options.friction_coefficients)
        chain = with_friction(chain, own)
    chain = chain if flattening is None else with_flattening(chain, flattening)
    chain = chain if options.balance == "none" else balanced(chain)
    if full is not None:
        from mixedlub.full_base.chain import with_full_base

        chain = with_full_base(chain, full)
    return chain if options.film_roughness == "none" else with_rough_film(chain)


def with_rough_film(base: Chain) -> Chain:
    """Chain with the film of surfaces with a lay; under a balance, it applies to the film carrying the whole load.

    >>> names = [name for name, _ in with_rough_film(GEAR_LOSS)]
    >>> names[names.index("smooth_film") :][:3]
    ['smooth_film', 'film_thickness', 'film_over_roughness']
    """
    film = FILM.quantity
    after = (("film_over_roughness", film_over_roughness),)
    if "full_load_film" in dict(base):
        law = renamed(rough_film, {"smooth_film": film})
        chain = tuple((name, law if name == "full_load_film" else own) for name, own in base)
        return (*chain, *after)
    place = [name for name, _ in base].index(film)
    smooth = (("smooth_film", dict(base)[film]), (film, rough_film))
    return (*base[:place], *smooth, *after, *base[place + 1 :])


FURTHER: Chain = (
    ("flash_temperature", heating.largest_flash_temperature),
    ("film_rise", heating.film_rise),
    ("friction_line_load", loss.friction_line_load),
    ("sliding_integral", loss.sliding_integral),
    ("load_loss_factor", loss.load_loss_factor),
)
"""Quantities of a study beyond the base model."""
RATED: Chain = (("mean_roughness", contact.mean_roughness), ("specific_film", safety.specific_film))
"""Additional quantities of a study that compares films with a limit."""


def with_friction(base: Chain, law: Law) -> Chain:
    """Gear chain with another friction law, preceded by quantities that such laws read beyond the base model.

    >>> from mixedlub.friction.iso_tc60 import iso_tc60
    >>> dict(with_friction(GEAR_LOSS, iso_tc60))["friction"].__name__
    'iso_tc60'
    """
    place = [name for name, _ in base].index("friction")
    pitch = (("pitch_film", at_pitch_point(dict(base)[FILM.quantity])),)
    return (*base[:place], *BEFORE_FRICTION, *pitch, ("friction", law), *base[place + 1 :])


def at_pitch_point(law: Law) -> Law:
    """A line-contact law at the pitch point, with one tooth pair carrying the whole load.

    >>> tuple(inspect.signature(at_pitch_point(contact.line_hertz_pressure)).parameters)
    ('mesh_line_load', 'pitch_radius', 'reduced_modulus')
    """
    return renamed(law, _AT_PITCH_POINT)


_AT_PITCH_POINT = {
    "radius": "pitch_radius",
    "entrainment_speed": "pitch_entrainment_speed",
    "line_load": "mesh_line_load",
}
BEFORE_FRICTION: Chain = (
    ("kinematic_viscosity", oil.kinematic),
    ("mean_roughness", contact.mean_roughness),
    ("pitch_line_speed", pitch_point.pitch_line_speed),
    ("pitch_entrainment_speed", pitch_point.pitch_entrainment_speed),
    ("pitch_radius", pitch_point.pitch_radius),
    ("mesh_line_load", pitch_point.mesh_line_load),
    ("load_intensity", pitch_point.load_intensity),
    ("pitch_pressure", at_pitch_point(contact.line_hertz_pressure)),
    ("pitch_minimum_film", at_pitch_point(dowson_higginson)),
)
"""Quantities read by friction laws beyond the base model."""


def ignored(options: Options, model: Model) -> tuple[str, ...]:
    """Options choosing a law that no step reads because of the friction law."""
    if options.friction == friction.BASE:
        return ()
    made = {name for step in model.steps for name in step.outputs}
    read = {slot.option for slot in SLOTS if slot.quantity in made and slot.quantity != "friction"}
    unread = [option for option in dict.fromkeys(slot.option for slot in SLOTS) if option not in read]
    return (*unread, *(["viscosity_pressure"] if VISCOSITY.quantity not in made else []))
