"""The study file: one class per section, validated once, every error with its place."""

from __future__ import annotations

from collections.abc import Callable
from inspect import signature
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, create_model, model_validator

from mixedlub.chain.slots import ASPERITY_LOAD, SLOTS
from mixedlub.friction import BASE, PLACES, catalogue
from mixedlub.schema.friction_file import coefficients_of
from mixedlub.schema.section import Number, NumberOrName, Section, Whole, check_keys_of, key, table, with_ranges
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.system_file import BASES, CUTOFF_SHARE, FLATTENING, Gears, RigFile, Uncertainty

MOST_LEVELS = 100_000


def _levels(value: Any) -> Any:
    """A list unchanged, or ``{from, to, count}`` expanded."""
    if not isinstance(value, dict):
        return value
    if set(value) != {"from", "to", "count"}:
        raise ValueError("is a list, or { from = LOW, to = HIGH, count = N }")
    low, high, count = value["from"], value["to"], value["count"]
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= MOST_LEVELS:
        raise ValueError(f"count is a whole number from 2 to {MOST_LEVELS}")
    if not all(isinstance(end, (int, float)) and np.isfinite(end) for end in (low, high)):
        raise ValueError("from and to are finite numbers")
    return np.linspace(low, high, count).tolist()


def each_once(values: tuple[Any, ...]) -> tuple[Any, ...]:
    """Levels; raises an error if a value appears twice."""
    doubled = sorted({v for v in values if values.count(v) > 1}, key=str) if len(values) < 1000 else []
    if doubled or len(set(values)) < len(values):
        raise ValueError(f"each level once, but {doubled[0] if doubled else 'one'} appears again")
    return values


Numbers = Annotated[tuple[Number, ...], Field(min_length=1), BeforeValidator(_levels)]
Names = Annotated[tuple[str, ...], Field(min_length=1)]


class Conditions(Section):
    """The factorial: every torque at every speed and oil temperature."""

    torque_Nm: Numbers = key("torques on the pinion", example=[50, 100, 150])
    speed_rpm: Numbers = key("speeds of the pinion", example={"from": 500, "to": 3000, "count": 6})
    oil_temperature_C: Numbers = key("temperatures of the oil where it enters the contact", example=[60])

    @model_validator(mode="after")
    def _each_once(self) -> Conditions:
        for name in ("torque_Nm", "speed_rpm", "oil_temperature_C"):
            try:
                each_once(getattr(self, name))
            except ValueError as error:
                raise ValueError(f"{name}: {error}") from None
        return self


class Pairings(Section):
    """Pairings of surfaces: ``every`` unordered pair of some, or ``pinion`` list against ``gear`` list."""

    every: Names | None = key(
        "surfaces of which every pair is taken, each with itself too; or pinion and gear",
        None,
        example=["ground", "polished"],
    )
    pinion: Names | None = key(
        "surfaces of the pinion, each against each of gear", None, example=["ground"], alternative=True
    )
    gear: Names | None = key("surfaces of the gear", None, example=["polished"], alternative=True)

    @model_validator(mode="after")
    def _one_way(self) -> Pairings:
        lists = (self.pinion, self.gear)
        if (self.every is None) == (None in lists) or (self.every is not None and lists != (None, None)):
            raise ValueError("needs either every = [...], or both pinion = [...] and gear = [...]")
        for names in (self.every, *lists):
            each_once(names or ())
        return self


def _laws() -> Any:
    """An option for each step with a choice of laws, and for the friction law."""
    fields: dict[str, Any] = {}
    for slot in SLOTS:
        together = [other.choices for other in SLOTS if other.option == slot.option]
        values = {c.name: c.title for c in slot.choices.values() if all(c.name in one for one in together)}
        fields[slot.option] = (Literal[tuple(values)], key(slot.meaning, slot.default, values=values))
    meaning = "law of the friction coefficient; `mixedlub friction-laws NAME` shows its page"
    values = {law.name: f"{law.title}, {PLACES[law.place]}" for law in catalogue().values()}
    fields["friction"] = (Literal[tuple(catalogue())], key(meaning, BASE, values=values))
    return create_model("Laws", __base__=Section, **fields)


_Laws: Any = _laws()


def reads_hardness(law: Callable[..., Any]) -> bool:
    """Whether asperities of a law yield.

    >>> [name for name, one in ASPERITY_LOAD.choices.items() if not reads_hardness(one.law)]
    ['greenwood_williamson', 'greenwood_tripp']
    """
    return "hardness" in signature(law).parameters


BESIDE_FULL = ("film", "viscosity_law", "viscosity_pressure", "effective_viscosity", "contact_pressure", "friction")
"""Options for laws of film and film friction, which full solutions replace."""


class Options(_Laws):
    """Options of the model left open by its authors; the defaults are the base model's."""

    base: Literal["formulas", "full_solution"] = key("film and film friction", "formulas", values=BASES)
    balance: Literal["none", "johnson_greenwood_poon"] = key(
        "whether film and asperities share the load",
        "none",
        values={
            "none": "the film formula sets the gap, whatever the asperities would carry",
            "johnson_greenwood_poon": "the film gives way until it and the asperities together carry the load",
        },
    )
    hardness_GPa: Number | None = key(
        "indentation hardness of the softer flank, for asperities that yield", None, example=6.0, alternative=True
    )
    viscosity_pressure: Literal["maximum", "mean"] = key(
        "pressure at which the viscosity is taken",
        "maximum",
        values={
            "maximum": "viscosity taken at the largest Hertz pressure",
            "mean": "viscosity taken at the mean Hertz pressure",
        },
    )
    friction_coefficients: Annotated[dict[str, Number], BeforeValidator(coefficients_of)] = key(
        "NAME = VALUE: coefficients of the friction law that are the user's, by the names of its page; or the file "
        "that `mixedlub condense` or `mixedlub evaluate` wrote",
        {},
        example={},
    )
    film_roughness: Literal["none", "patir_cheng"] = key(
        "whether the lay changes the film; needs the lay of every surface",
        "none",
        values={
            "none": "the film of smooth surfaces",
            "patir_cheng": "the inlet of the contact with the flow factors of Patir and Cheng",
        },
    )
    heights: Literal["gaussian", "measured", "plateau", "auto"] = key(
        "distribution of the heights in the contact of the asperities",
        "gaussian",
        values={
            "gaussian": "normal heights",
            "measured": "the heights of the traces or map of each surface",
            "plateau": "two normal processes fitted to each surface, the lower one that of the valleys",
            "auto": "by the normal probability plot of each surface: Gaussian where its bulk is, a plateau where two "
            "lines describe it, else the measured heights",
        },
    )
    flattening: Literal["none", "waves"] = key("roughness of the asperities", "none", values=FLATTENING)
    short_cutoff_over_half_width: Number | None = key(CUTOFF_SHARE, None, example=0.1, alternative=True)
    bands: Literal["none", "traces", "short_cutoff", "both"] = key(
        "low and high columns of every result but input power, loss factors, temperature of the teeth and losses by "
        "single effects; the temperature of the teeth is kept in all bands",
        "none",
        values={
            "none": "no bands",
            "traces": "the true value in 90 of 100 surfaces, by the scatter between three or more traces of each, "
            "else between the sampling lengths",
            "short_cutoff": "lowest and highest at half, one and two short cut-offs of all traces",
            "both": "lowest and highest end of the bands of the traces at half, one and two short cut-offs",
        },
    )
    conditions_of: Literal["pinion", "gear"] = key(
        "the wheel of the conditions",
        "pinion",
        values={"pinion": "torque and speed are the pinion's", "gear": "torque and speed are the gear's"},
    )
    bulk_temperature_rise_K: Number = key(
        "by how much the oil at the contact's inlet is warmer than the oil temperature", 0.0
    )
    path_points: Whole = key("quadrature points along the path of contact, about", 48)
    face_slices: Whole | None = key("slices across the face; left out: as the load sharing needs", None, example=1)

    @property
    def laws(self) -> dict[str, Callable[..., Any]]:
        """Chosen laws by output quantity."""
        return {slot.quantity: slot.choices[getattr(self, slot.option)].law for slot in SLOTS}

    @model_validator(mode="after")
    def _full_base_alone(self) -> Options:
        """Raise an error for another law of film or friction beside full solutions, which have both."""
        if self.base == "full_solution":
            for name in BESIDE_FULL:
                default = type(self).model_fields[name].default
                if getattr(self, name) != default:
                    raise ValueError(
                        f'{name} = "{getattr(self, name)}": base = "full_solution" has its own; leave it out'
                    )
        return self

    @model_validator(mode="after")
    def _heights_where_they_act(self) -> Options:
        if self.heights != "gaussian" and self.asperities != ASPERITY_LOAD.default:
            raise ValueError(f'heights = "{self.heights}" acts only with asperities = "{ASPERITY_LOAD.default}"')
        return self

    @model_validator(mode="after")
    def _hardness_where_it_acts(self) -> Options:
        laws = ASPERITY_LOAD.choices.values()
        check_keys_of(self, "asperities", {c.name: ("hardness_GPa",) if reads_hardness(c.law) else () for c in laws})
        return self


class Safety(Section):
    """Limits of oil and material, by tests, that the study holds its temperatures and films against."""

    scuffing_temperature_C: Number | None = key(
        "contact temperature at which the oil scuffs, for the flash temperature method", None, example=250.0
    )
    integral_scuffing_temperature_C: Number | None = key(
        "integral temperature at which the oil scuffs; needs flash_weight", None, example=200.0
    )
    flash_weight: Annotated[Number, Field(ge=0.0, le=10.0)] | None = key(
        "C_2, weight of the mean flash temperature in the integral temperature; that of your standard",
        None,
        example=1.5,
    )
    permissible_film_ratio: Annotated[Number, Field(gt=0.0, le=10.0)] | None = key(
        "lambda_GFP, film over mean roughness below which the oil lets micropitting arise", None, example=0.3
    )

    @model_validator(mode="after")
    def _complete(self) -> Safety:
        if (self.integral_scuffing_temperature_C is None) != (self.flash_weight is None):
            raise ValueError("integral_scuffing_temperature_C and flash_weight go together; give both or neither")
        if self == Safety.model_construct():
            raise ValueError("holds no limit; give one or leave the section out")
        return self


class StudyFile(RigFile):
    """A study file."""

    schema_: Literal["mixedlub-study/1"] = key("format of the file", example="mixedlub-study/1", alias="schema")
    title: str = key("title of the page", "Study", example="Ground against polished flanks")
    gears: Gears = key(table(RigFile, "")["gears"].meaning)
    surfaces: dict[str, SurfaceSection] = key(table(RigFile, "")["surfaces"].meaning, min_length=1)
    pairings: Pairings | None = key(
        "which surface runs against which; left out: every pair, each with itself too", None
    )
    conditions: Conditions = key(
        "every torque at every speed and oil temperature; each a list, or { from = LOW, to = HIGH, count = N }"
    )
    options: Options = key("readings of the model on which its authors leave room", Options())
    uncertainty: Uncertainty = key(
        "one standard deviation of inputs common to all pairings, for bands and ranking; 0: known", Uncertainty()
    )
    costs: dict[str, Number] = key(
        "SURFACE = relative cost of the finish of one flank, for the map of saving against cost",
        {},
        example={"ground": 1.0, "polished": 2.5},
    )
    safety: Safety | None = key("limits against scuffing and micropitting", None)
    effects: dict[str, dict[str, NumberOrName]] = key(
        "EFFECT = { PARAMETER = VALUE }: physics beyond the base model, as `mixedlub effects` lists it; "
        "law = NAME: a published law; parameters left out: as the first published law has them; "
        "the path of a law file may take the place of EFFECT",
        {},
        example={"churning": {"law": "Changenet and Velex"}},
    )

    @model_validator(mode="after")
    def _scuffs_above_the_oil(self) -> StudyFile:
        """Raise an error for a scuffing temperature not above the oil temperature at the inlet or in the contact."""
        hottest = max(self.conditions.oil_temperature_C) + self.options.bulk_temperature_rise_K
        for name in ("scuffing_temperature_C", "integral_scuffing_temperature_C"):
            limit = None if self.safety is None else getattr(self.safety, name)
            if limit is not None and limit <= hottest:
                raise ValueError(
                    f"safety.{name}: must be above the oil of {hottest:g} degC in conditions, not {limit:g}"
                )
        return self


with_ranges(StudyFile)
