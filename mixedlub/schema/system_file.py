"""Format of `system.toml`: one class per table, one field per key; ranges are in `ranges.toml`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Annotated, Any, Literal
from unicodedata import category

from pydantic import (
    AfterValidator,
    SerializeAsAny,
    ValidationInfo,
    create_model,
    field_validator,
    model_serializer,
    model_validator,
)

from mixedlub.schema.discovery import declared
from mixedlub.schema.gear_file import gear_names, with_preset
from mixedlub.schema.lubricant_section import Lubricant, Pair
from mixedlub.schema.section import Float, Number, NumberOrName, Section, Whole, key, one_of, tables, with_ranges
from mixedlub.schema.settable import Settable
from mixedlub.schema.simulation_file import Condition, SimulationInput, simulation_input
from mixedlub.schema.surface_file import SurfaceSection
from profiles.errors import InputError


def _known_kind(name: str) -> str:
    return one_of(name, [kind.name for kind in sorted(declared(*KINDS), key=lambda kind: kind.rank)])


def _known_quantity(name: str) -> str:
    return one_of(name, dict.fromkeys(quantity for kind in declared(*KINDS) for quantity in kind.quantities))


def _has_own_columns(kind: object) -> bool:
    """Whether the columns of a kind depend on the case."""
    return any(one.name == kind and one.by_case is not None for one in declared(*KINDS))


KINDS = ("mixedlub.kinds", "mixedlub.kinds", "KIND")
"""Module with the kinds of recording, imported only when a file is read because it imports this module."""

SHARING: tuple[Any, ...] = declared("mixedlub.gear.sharing", "mixedlub.load_sharing", "MODEL")
"""Load-sharing models, each with name, meaning and keys."""
_NAMED = {model.name: model.meaning for model in SHARING if not model.chosen_by}


def _sharing_keys() -> Any:
    """Keys of all load-sharing models: keys that select a model by themselves, ``model``, and the others."""
    model: Any = key("how the load divides between tooth pairs; this or table", None, example="ldp", values=_NAMED)
    names: Any = Literal[tuple(_NAMED)]
    name = create_model("ModelName", __base__=Section, model=(names | None, model))
    first = [one.keys for one in SHARING if one.chosen_by]
    rest = [one.keys for one in SHARING if not one.chosen_by and one.keys is not Section]
    # Fields of the last base class come first.
    return create_model("SharingKeys", __base__=(*reversed(rest), name, *reversed(first)))


_SharingKeys: Any = _sharing_keys()


class LoadSharing(_SharingKeys):
    @property
    def chosen(self) -> Any:
        """Model selected by the keys."""
        return self._choices()[0]

    def _choices(self) -> list[Any]:
        by_key = [one for one in SHARING if one.chosen_by and getattr(self, one.chosen_by) is not None]
        return by_key + [one for one in SHARING if one.name == self.model]

    @model_validator(mode="after")
    def _one_model(self) -> LoadSharing:
        if len(self._choices()) != 1:
            keys = [f'{one.chosen_by} = "FILE"' for one in SHARING if one.chosen_by]
            names = " or ".join(f'"{name}"' for name in _NAMED)
            raise ValueError(f"needs either {', '.join(keys)}, or model = {names}; not both")
        return self

    @model_validator(mode="after")
    def _keys_of_the_model(self) -> LoadSharing:
        """Raise an error for a nonzero modification ignored by the chosen model."""
        for name in self.model_fields_set - self.chosen.keys.model_fields.keys() - {"model"}:
            if getattr(self, name) != type(self).model_fields[name].default:
                takers = " or ".join(f'"{one.name}"' for one in SHARING if name in one.keys.model_fields)
                raise ValueError(
                    f"{name} acts only with model = {takers}; with {self.chosen.meaning} leave it out or give 0"
                )
        return self


class Gears(Section):
    preset: str | None = key(
        f"gears by name ({', '.join(gear_names())}); what this section states itself wins",
        None,
        example="fzg_c",
        alternative=True,
    )
    teeth: tuple[Whole, Whole] = key(
        "numbers of teeth, pinion (driving) and gear; below zero, the gear is a ring gear", example=[17, 26]
    )
    normal_module_mm: Number = key("normal module", example=4.2333333)
    pressure_angle_deg: Number = key("normal pressure angle", 20.0, example=22.5)
    helix_angle_deg: Number = key("helix angle at the pitch circle", 0.0)
    profile_shift: Pair = key("profile shift over module", (0.0, 0.0))
    tip_diameter_mm: Pair | None = key("tip diameters; left out: standard addendum", None, example=[80.5, 118.4])
    centre_distance_mm: Number | None = key(
        "working centre distance; left out: by the profile shift", None, example=91.0
    )
    face_width_mm: Number = key("common face width", example=14.0)
    dedendum: Number = key("dedendum of the basic rack over module, which elastic teeth read", 1.25)
    youngs_modulus_GPa: Pair = key("Young's moduli", (206.0, 206.0))
    poisson_ratio: Pair = key("Poisson's ratios", (0.3, 0.3))
    load_sharing: LoadSharing = key(
        'how the load divides between tooth pairs; left out: { model = "rigid" }',
        LoadSharing(model="rigid"),
        example={"model": "ldp", "tip_relief_um": [15, 15], "relief_length_mm": [2, 2]},
    )

    @model_validator(mode="before")
    @classmethod
    def _of_its_preset(cls, given: Any) -> Any:
        """Complete the section by its preset."""
        named = given.get("preset") if isinstance(given, Mapping) else None
        return with_preset(given) if isinstance(named, str) else given


BASES = {
    "formulas": "published formulas, isothermal",
    "full_solution": "full thermal, non-Newtonian solutions for the oil, by an emulator that is built once",
}
"""Bases of film and film friction."""
FLATTENING = {
    "none": "the roughness as measured, whatever the film presses flat",
    "waves": "the roughness inside the film: the pressure leaves each wave of each surface a part of its amplitude",
}
"""Choices for the roughness of the asperities."""
CUTOFF_SHARE = "short cut-off of the asperities over the half width of the contact; left out: that of the traces"


class Contact(Section):
    geometry: Literal["line", "point"] = key(
        "form of contact", "line", values={"line": "cylinders", "point": "a ball or crowned discs"}
    )
    radius_mm: tuple[Float, Float] = key("radii of the two bodies; inf is flat", example=[20.0, 25.4])
    transverse_radius_mm: tuple[Float, Float] | None = key(
        "radii across the motion, of crowned discs; only of a point contact; left out: those along it",
        None,
        example=[76.2, 76.2],
        alternative=True,
    )
    width_mm: Number | None = key("width of a line contact, which needs it; a point has none", None, example=6.0)
    youngs_modulus_GPa: Pair = key("Young's moduli of the two bodies", (206.0, 206.0))
    poisson_ratio: Pair = key("Poisson's ratios of the two bodies", (0.3, 0.3))

    @model_validator(mode="after")
    def _line_has_width(self) -> Contact:
        if self.geometry == "line" and self.width_mm is None:
            raise ValueError("a line contact needs width_mm")
        if self.geometry == "line" and self.transverse_radius_mm is not None:
            raise ValueError('transverse_radius_mm acts only with geometry = "point"; leave it out')
        return self


class Uncertainty(Section):
    boundary_friction: Number = key("of the boundary friction, absolute", 0.0, example=0.012)
    viscosity: Number = key("of the viscosity, relative; one factor throughout", 0.0, example=0.06)
    pressure_viscosity: Number = key(
        "of the pressure-viscosity coefficient, relative; one factor throughout", 0.0, example=0.06
    )
    eyring_stress: Number = key("of the Eyring stress, relative; one factor throughout", 0.0, example=0.15)
    roughness: Number = key("of Rq, relative; one factor for all surfaces", 0.0, example=0.04)

    @property
    def stated(self) -> dict[str, float]:
        """Standard deviations above zero, by input."""
        return {name: sd for name, sd in self if sd > 0}


class SimulationUncertainty(Uncertainty):
    """Uncertain inputs of the user's own simulation, by their names in it."""

    inputs: dict[str, SimulationInput] = key("uncertain inputs by name", {})

    @property
    def stated(self) -> dict[str, float]:
        return {name: one.spread for name, one in self.inputs.items() if one.spread > 0}

    @model_serializer
    def _flat(self) -> dict[str, Any]:
        return {
            name: one.model_dump(exclude_unset=True) if one.relative is None else one.relative
            for name, one in self.inputs.items()
        }


class Noise(Section):
    relative: Number = key(
        "standard deviation of a reading over its size; its square adds to that of the next key", 0.0, example=0.01
    )
    absolute: Number = key("standard deviation of a reading, in its unit", 0.0, example=0.3, unit="as read")
    setup_relative: Number = key("standard deviation of the error shared within a set-up, over the reading", 0.0)
    setup_absolute: Number = key(
        "standard deviation of the error shared within a set-up, in the unit of the reading", 0.0, unit="as read"
    )

    @property
    def of_single(self) -> bool:
        """Whether the scatter of single readings is stated."""
        return self.relative > 0 or self.absolute > 0

    @property
    def of_setups(self) -> bool:
        """Whether the error common to a set-up is stated."""
        return self.setup_relative > 0 or self.setup_absolute > 0


class Recording(Section):
    quantity: Annotated[str, AfterValidator(_known_quantity)] = key(
        "the column that the rig recorded", example="power_loss_W"
    )
    includes: str = key("what the reading contains beside the contact, free text", "", example="bearings and seals")
    ambient_temperature_C: Number = key("temperature around the rig", 25.0)
    check: str | None = key(
        "column of a second channel: never fitted, compared afterwards", None, example="track_coverage_percent"
    )
    noise: Noise | None = key(
        "scatter of the readings; left out: estimated from repeats, else from the fit",
        None,
        example={"relative": 0.01, "absolute": 0.3},
    )


class SimulatedRecording(Recording):
    """Recording of any quantity, beside the user's own simulation."""

    quantity: str = key("the column that the rig recorded, in any unit", example="power_loss_W")
    unit: str | None = key("unit of the reading and its simulation; left out: the unit at the end of its name", None)


class RigFile(Section):
    """Tables on the rig common to cases and studies."""

    boundary_friction: Number = key("friction coefficient of touching asperities", 0.1)
    description: str = key("free text", "", example="rig, oil, campaign")
    gears: Gears | None = key("two entries: pinion, gear", None)
    lubricant: Lubricant | None = key("what is left out is typical of the base stock, and a warning says so", None)
    surfaces: dict[str, SurfaceSection] = key("one table a surface, by the name that other tables use", {})

    @field_validator("surfaces")
    @classmethod
    def _are_named(cls, surfaces: dict[str, SurfaceSection]) -> dict[str, SurfaceSection]:
        for name in surfaces:
            if not name or name != name.strip() or any(category(c) == "Cc" for c in name):
                raise ValueError(f"{name!r} is no name: one line of text, no blank at either end")
        return surfaces


class System(RigFile):
    """Description of the rig in a case."""

    schema_: Literal["mixedlub-case/1"] = key("format of the file", example="mixedlub-case/1", alias="schema")
    kind: Annotated[str, AfterValidator(_known_kind)] = key("what was recorded", example="gear_pair")
    base: Literal["formulas", "full_solution"] = key(
        "film and film friction of the base model; a gear pair or discs in line contact may have full solutions",
        "formulas",
        values=BASES,
    )
    flattening: Literal["none", "waves"] = key(
        "roughness of the asperities; only for contacts along a line", "none", values=FLATTENING
    )
    short_cutoff_over_half_width: Number | None = key(CUTOFF_SHARE, None, example=0.1, alternative=True)
    contact: Contact | None = key("two entries: first and second body", None)
    uncertainty: SerializeAsAny[Uncertainty] = key(
        "one standard deviation of what calibration may move; 0: known", Uncertainty()
    )
    recording: SerializeAsAny[Recording] = key("what was read, and how well")
    conditions: dict[str, Condition] = key(
        "a column of conditions beside the user's own simulation, by its name in the tables", {}
    )
    effects: dict[str, dict[str, NumberOrName]] = key(
        "EFFECT = { PARAMETER = VALUE }: physics that the rig is known to have, part of the base model; law = NAME: "
        "a published law; parameters left out: as the first published law has them; PARAMETER_sd: standard deviation; "
        "the path of a law file may take the place of EFFECT",
        {},
        example={"sensor_gain": {"gain": 0.01, "gain_sd": 0.005}},
    )
    calibration: dict[str, Number] = key(
        "NAME = VALUE: calibrated inputs at which the model is simulated, named as in diagnosis.json",
        {},
        example={"boundary_friction": 0.1},
    )
    rig: dict[str, Settable] = key(
        "CONDITION = [LOW, HIGH] or { steps = [...] }, and pairings = [[SURFACE, SURFACE], ...]: what can be set; next "
        "tests stay inside it; left out: inside the recorded range and pairs",
        {},
        example={"oil_temperature_C": [40.0, 100.0]},
    )

    @field_validator("recording", mode="before")
    @classmethod
    def _of_any_quantity(cls, given: Any, info: ValidationInfo) -> Any:
        """Recording of any quantity for kinds with columns that depend on the case."""
        if not isinstance(given, Mapping) or not _has_own_columns(info.data.get("kind")):
            return given
        return SimulatedRecording.model_validate(given, context=info.context)

    @field_validator("uncertainty", mode="before")
    @classmethod
    def _of_any_input(cls, given: Any, info: ValidationInfo) -> Any:
        """Inputs of any name for kinds with columns that depend on the case."""
        if not isinstance(given, Mapping) or not _has_own_columns(info.data.get("kind")):
            return given
        return SimulationUncertainty(inputs={name: simulation_input(name, one) for name, one in given.items()})

    @field_validator("conditions")
    @classmethod
    def _only_beside_a_simulation(cls, given: dict[str, Condition], info: ValidationInfo) -> dict[str, Condition]:
        if given and not _has_own_columns(info.data.get("kind")):
            raise ValueError(f"a case of kind {info.data.get('kind')!r} has columns of its own; leave the section out")
        return given

    missing_part: str | None = key(
        "table of what the model lacks over conditions, added to its readings within the range of the table",
        None,
        example="missing_part.csv",
        alternative=True,
    )


with_ranges(System)


def in_file(error: InputError, file: str) -> InputError:
    """Add file and table to an error about a key; an error with its place is unchanged.

    >>> print(in_file(InputError("teeth interfere", where="teeth", value=[5, 60]), "system.toml"))
    system.toml: gears.teeth: [5, 60]: teeth interfere
    """
    if error.where.startswith(file):
        return error
    name = re.split(r"[.,\[]", error.where)[0]
    for table in tables(System):
        own = table.name in ("gears", "gears.load_sharing") and name == error.where
        if name in table.model.model_fields and (not table.name or own):
            place = f"{table.name}.{error.where}".lstrip(".")
            return InputError(error.rule, where=f"{file}: {place}", value=error.value)
    return error
