"""What `system.toml` may say: one class a table, each key described by its field, its range in `ranges.toml`."""

from __future__ import annotations

import re
from typing import Annotated, Literal, get_args

from pydantic import Field, model_validator

from mixedlub.schema.section import Float, Number, Section, Whole, choices, tables, with_ranges
from profiles.errors import InputError

KindName = Literal["gear_pair", "mesh_friction", "disc", "film", "friction_history", "friction_map", "viscosity"]
KINDS: tuple[str, ...] = get_args(KindName)

Pair = tuple[Number, Number]


class LoadSharing(Section):
    table: str | None = Field(
        default=None,
        description="CSV of torque_Nm, roll_angle_deg, load_share; this or model",
        examples=["load_share.csv"],
        json_schema_extra={"alternative": True},
    )
    model: Literal["ldp", "rigid"] | None = Field(
        default=None,
        description="how the load divides between tooth pairs; this or table",
        examples=["ldp"],
        json_schema_extra=choices(ldp="elastic teeth", rigid="equal shares of the pairs in contact"),
    )
    tip_relief_um: Pair = Field(default=(0.0, 0.0), description='model "ldp": tip relief', examples=[[15, 15]])
    relief_length_mm: Pair = Field(
        default=(0.0, 0.0), description='model "ldp": length of the relief along the profile', examples=[[2, 2]]
    )
    lead_crown_um: Number = Field(
        default=0.0, description='model "ldp": crown over the face, both flanks together', examples=[3.0]
    )
    misalignment_um: Number = Field(default=0.0, description='model "ldp": misalignment over the face width')

    @model_validator(mode="after")
    def _table_or_model(self) -> LoadSharing:
        if (self.table is None) == (self.model is None):
            raise ValueError('needs either table = "FILE", or model = "ldp" or "rigid"; not both')
        return self


class Gears(Section):
    teeth: tuple[Whole, Whole] = Field(description="numbers of teeth, pinion (driving) and gear", examples=[[17, 26]])
    normal_module_mm: Number = Field(description="normal module", examples=[4.2333333])
    pressure_angle_deg: Number = Field(default=20.0, description="normal pressure angle", examples=[22.5])
    helix_angle_deg: Number = Field(default=0.0, description="helix angle at the pitch circle")
    profile_shift: Pair = Field(default=(0.0, 0.0), description="profile shift over module")
    tip_diameter_mm: Pair | None = Field(
        default=None, description="tip diameters; left out: standard addendum", examples=[[80.5, 118.4]]
    )
    centre_distance_mm: Number | None = Field(
        default=None, description="working centre distance; left out: from the profile shift", examples=[91.0]
    )
    face_width_mm: Number = Field(description="common face width", examples=[14.0])
    youngs_modulus_GPa: Pair = Field(default=(206.0, 206.0), description="Young's moduli")
    poisson_ratio: Pair = Field(default=(0.3, 0.3), description="Poisson's ratios")
    load_sharing: LoadSharing = Field(
        default=LoadSharing(model="rigid"),
        description='how the load divides between tooth pairs; left out: { model = "rigid" }',
        examples=[{"model": "ldp", "tip_relief_um": [15, 15], "relief_length_mm": [2, 2]}],
    )


class Contact(Section):
    geometry: Literal["line", "point"] = Field(
        default="line",
        description="form of the contact",
        json_schema_extra=choices(line="cylinders", point="a ball"),
    )
    radius_mm: tuple[Float, Float] = Field(description="radii of the two bodies; inf is flat", examples=[[20.0, 25.4]])
    width_mm: Number | None = Field(
        default=None, description="width of a line contact, which needs it; a point contact has none", examples=[6.0]
    )
    youngs_modulus_GPa: Pair = Field(default=(206.0, 206.0), description="Young's moduli of the two bodies")
    poisson_ratio: Pair = Field(default=(0.3, 0.3), description="Poisson's ratios of the two bodies")

    @model_validator(mode="after")
    def _line_has_width(self) -> Contact:
        if self.geometry == "line" and self.width_mm is None:
            raise ValueError("a line contact needs width_mm")
        return self


class Lubricant(Section):
    name: str = Field(default="unnamed oil", description="name of the oil, for the report", examples=["sample oil"])
    base: Literal["mineral", "pao", "ester", "pag"] | None = Field(
        default=None,
        description="base stock, whose typical oil fills what is left out; left out: mineral",
        examples=["mineral"],
        json_schema_extra=choices(
            mineral="mineral oil", pao="polyalphaolefin", ester="synthetic ester", pag="polyalkylene glycol"
        ),
    )
    temperature_C: Pair | None = Field(
        default=None, description="two temperatures, at which the next two keys are given", examples=[[40.0, 100.0]]
    )
    kinematic_viscosity_mm2_s: Pair | None = Field(
        default=None, description="kinematic viscosity there; ASTM D341 between and beyond", examples=[[30.0, 6.2]]
    )
    pressure_viscosity_per_GPa: Pair | None = Field(
        default=None,
        description="pressure-viscosity coefficient there; linear between and beyond",
        examples=[[18.0, 14.0]],
    )
    density_15C_kg_m3: Number | None = Field(default=None, description="density at 15 °C", examples=[850.0])
    density_change_per_K: Number | None = Field(
        default=None, description="relative fall of the density", examples=[7e-4]
    )
    eyring_stress_MPa: Number | None = Field(default=None, description="Eyring stress of the film", examples=[5.0])
    thermal_conductivity_W_mK: Number | None = Field(
        default=None, description="thermal conductivity of the oil", examples=[0.14]
    )
    specific_heat_J_kgK: Number | None = Field(default=None, description="specific heat of the oil", examples=[2000.0])


class Coating(Section):
    name: str = Field(default="coating", description="name of the coating, for the report", examples=["DLC"])
    thickness_um: Number = Field(description="thickness of the coating", examples=[3.0])
    thermal_conductivity_W_mK: Number = Field(description="thermal conductivity of the coating", examples=[2.0])


class SurfaceSection(Section):
    m0_um2: Number | None = Field(
        default=None,
        description="variance of the heights of the profile; the three moments, or a profile",
        examples=[0.137],
    )
    m2: Number | None = Field(default=None, description="variance of the slopes of the profile", examples=[0.0031])
    m4_per_um2: Number | None = Field(
        default=None, description="variance of the curvatures of the profile", examples=[0.0021]
    )
    profile: str | None = Field(
        default=None,
        description="instead of the moments: file of a trace, relative to this file, or shipped:NAME",
        examples=["profiles/ground.csv"],
        json_schema_extra={"alternative": True},
    )
    cutoff_mm: Number | None = Field(
        default=None, description="long cut-off of a trace; left out: 0.8, or the trace's own", examples=[0.8]
    )
    short_cutoff_um: Number | None = Field(
        default=None, description="short cut-off of a trace; left out: 2.5, or the trace's own", examples=[2.5]
    )
    form: str | None = Field(
        default=None,
        description="form taken off a trace: line (left out), none, mean, circle, polynomial-N, involute-MM",
        examples=["line"],
    )
    edges: Annotated[bool, Field(strict=True)] = Field(
        default=True, description="true: chamfers and falling ends are cut off a trace", examples=[False]
    )
    outliers: Number | None = Field(
        default=None, description="a trace is masked beyond so many robust standard deviations", examples=[5.0]
    )
    coating: Coating | None = Field(
        default=None,
        description="only where there is one",
        examples=[{"name": "DLC", "thickness_um": 3.0, "thermal_conductivity_W_mK": 2.0}],
    )
    thermal_conductivity_W_mK: Number = Field(default=46.0, description="thermal conductivity of the body")
    density_kg_m3: Number = Field(default=7800.0, description="density of the body")
    specific_heat_J_kgK: Number = Field(default=470.0, description="specific heat of the body")

    @model_validator(mode="after")
    def _moments_or_profile(self) -> SurfaceSection:
        moments = (self.m0_um2, self.m2, self.m4_per_um2)
        if self.profile is None and None in moments:
            raise ValueError("needs m0_um2, m2 and m4_per_um2, or a profile")
        if self.profile is not None and any(m is not None for m in moments):
            raise ValueError("has both moments and a profile; give one of them")
        return self


class Uncertainty(Section):
    boundary_friction: Number = Field(default=0.0, description="of the boundary friction, absolute", examples=[0.012])
    viscosity: Number = Field(
        default=0.0, description="of the viscosity, relative; one factor for the case", examples=[0.06]
    )
    pressure_viscosity: Number = Field(
        default=0.0,
        description="of the pressure-viscosity coefficient, relative; one factor for the case",
        examples=[0.06],
    )
    eyring_stress: Number = Field(
        default=0.0, description="of the Eyring stress, relative; one factor for the case", examples=[0.15]
    )
    roughness: Number = Field(default=0.0, description="of Rq, relative; one factor for all surfaces", examples=[0.04])


class Noise(Section):
    relative: Number = Field(
        default=0.0,
        description="standard deviation of a reading over its size; its square adds to that of the next key",
        examples=[0.01],
    )
    absolute: Number = Field(
        default=0.0,
        description="standard deviation of a reading, in its unit",
        examples=[0.3],
        json_schema_extra={"unit": "as read"},
    )
    setup_relative: Number = Field(
        default=0.0,
        description="standard deviation of the error shared within a set-up, over the reading",
    )
    setup_absolute: Number = Field(
        default=0.0,
        description="standard deviation of the error shared within a set-up, in the unit of the reading",
        json_schema_extra={"unit": "as read"},
    )

    @property
    def of_single(self) -> bool:
        """Whether it says how much single readings scatter."""
        return self.relative > 0 or self.absolute > 0

    @property
    def of_setups(self) -> bool:
        """Whether it says how much set-ups are off as a whole."""
        return self.setup_relative > 0 or self.setup_absolute > 0


class Recording(Section):
    quantity: Literal[
        "power_loss_W", "friction_coefficient", "film_thickness_nm", "friction_torque_Nm", "viscosity_mPa_s"
    ] = Field(description="the column that the rig recorded", examples=["power_loss_W"])
    includes: str = Field(
        default="",
        description="what the reading contains beside the contact, free text",
        examples=["bearings and seals"],
    )
    ambient_temperature_C: Number = Field(default=25.0, description="temperature around the rig")
    check: str | None = Field(
        default=None,
        description="column of a second channel: never fitted, compared afterwards",
        examples=["track_coverage_percent"],
    )
    noise: Noise | None = Field(
        default=None,
        description="scatter of the readings; left out: estimated from repeats, else from the fit",
        examples=[{"relative": 0.01, "absolute": 0.3}],
    )


class RigFile(Section):
    """What a case and a study both say of a rig."""

    boundary_friction: Number = Field(default=0.1, description="friction coefficient of touching asperities")
    description: str = Field(default="", description="free text", examples=["rig, oil, campaign"])
    gears: Gears | None = Field(default=None, description="two entries: pinion, gear")
    lubricant: Lubricant | None = Field(
        default=None, description="what is left out is typical of the base stock, and a warning says so"
    )
    surfaces: dict[str, SurfaceSection] = Field(
        default={}, description="one table a surface; NAME as in the other tables"
    )


class System(RigFile):
    """Everything the engineer knows about the rig."""

    schema_: Literal["mixedlub-case/1"] = Field(
        alias="schema", description="format of the file", examples=["mixedlub-case/1"]
    )
    kind: KindName = Field(description="what was recorded", examples=["gear_pair"])
    contact: Contact | None = Field(default=None, description="two entries: first and second body")
    uncertainty: Uncertainty = Field(
        default=Uncertainty(), description="one standard deviation of what calibration may move; 0: known"
    )
    recording: Recording = Field(description="what was read, and how well")


with_ranges(System)


def in_file(error: InputError, file: str) -> InputError:
    """An error about a key of a file, with the file and the table of the key; one that names its place stays.

    >>> print(in_file(InputError("teeth interfere", where="teeth", value=[5, 60]), "system.toml"))
    system.toml: gears.teeth: [5, 60]: teeth interfere
    """
    key = re.split(r"[.,\[]", error.where)[0]
    for table in tables(System):
        own = table.name in ("gears", "gears.load_sharing") and key == error.where
        if key in table.model.model_fields and (not table.name or own):
            place = f"{table.name}.{error.where}".lstrip(".")
            return InputError(error.rule, where=f"{file}: {place}", value=error.value)
    return error
