"""File of a bevel or hypoid pair: gears, conditions, oil, surfaces and what varies."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Annotated, Literal

from pydantic import Field, model_validator

from mixedlub.efficiency.file import Flanks, Side
from mixedlub.schema.lubricant_section import Lubricant, Pair
from mixedlub.schema.ranges import ranges
from mixedlub.schema.section import Number, Section, Whole, key
from mixedlub.skew_gears.blank import ToothData
from mixedlub.skew_gears.pitch_cones import Basic
from mixedlub.study.schema import Conditions, Numbers, Options

Positive = Annotated[Number, Field(gt=0.0)]
NotNegative = Annotated[Number, Field(ge=0.0)]
Angle = Annotated[Number, Field(ge=0.0, lt=80.0)]
MOST_CONDITIONS = 20_000
"""Cost limit. Largest number of conditions of a map."""


class SkewGears(Section):
    """A bevel or hypoid pair by the basic data and tooth data of ISO 23509."""

    method: Literal[0, 1, 2, 3] = key(
        "pitch cones by this method of ISO 23509: 0 bevel gears without offset, 1 Gleason, 2 Oerlikon, 3 Klingelnberg",
        0,
        example=1,
    )
    teeth: tuple[Whole, Whole] = key("numbers of teeth, pinion and wheel", example=[13, 42])
    shaft_angle_deg: Annotated[Number, Field(ge=0.0, lt=180.0)] = key("angle between both axes", 90.0)
    offset_mm: NotNegative = key("hypoid offset, towards the wheel's hand of spiral", 0.0, example=15.0)
    wheel_outer_diameter_mm: Positive | None = key(
        "outer pitch diameter of the wheel; of all methods but 2", None, example=170.0
    )
    wheel_mean_diameter_mm: Positive | None = key(
        "mean pitch diameter of the wheel; of method 2", None, example=146.7, alternative=True
    )
    wheel_face_width_mm: Positive = key("face width of the wheel", example=30.0)
    spiral_angle_deg: Angle = key(
        "mean spiral angle, by method 1 of the pinion, else of the wheel; 0 is Zerol, with a large cutter straight",
        0.0,
        example=50.0,
    )
    cutting: Literal["face_milled", "face_hobbed"] = key(
        "how the teeth are cut, which gives their lengthwise curve",
        "face_milled",
        values={"face_milled": "a circle", "face_hobbed": "an epicycloid"},
    )
    cutter_radius_mm: Positive = key("radius of the cutter", example=63.5)
    blade_groups: Whole | None = key(
        "blade groups of the cutter of face-hobbed teeth", None, example=13, alternative=True, ge=1, le=100
    )
    pressure_angle_deg: Pair = key("nominal pressure angles, drive and coast side", (20.0, 20.0))
    limit_angle_share: Annotated[Number, Field(ge=0.0, le=1.0)] = key(
        "part of the limit pressure angle by which both generated angles differ from the nominal ones", 1.0
    )
    profile_shift: Annotated[Number, Field(ge=-2.0, le=2.0)] = key(
        "profile shift of the pinion over module, the wheel's its negative", 0.0, example=0.3
    )
    addendum: Annotated[Number, Field(gt=0.0, le=2.0)] = key("addendum of the crown gear over module", 1.0)
    dedendum: Annotated[Number, Field(gt=0.0, le=3.0)] = key("dedendum of the crown gear over module", 1.25)
    thickness: Annotated[Number, Field(ge=-1.0, le=1.0)] = key(
        "thickness modification of the pinion over module, the wheel's its negative", 0.0, example=0.05
    )
    wheel_addendum_angle_deg: Annotated[Number, Field(ge=-10.0, le=20.0)] = key(
        "angle between the wheel's pitch cone and the cone of its tips", 0.0, example=1.0
    )
    wheel_dedendum_angle_deg: Annotated[Number, Field(ge=-10.0, le=20.0)] = key(
        "angle between the wheel's pitch cone and the cone of its roots", 0.0, example=4.0
    )
    backlash_mm: NotNegative = key("outer transverse backlash", 0.0, example=0.2)
    face_share: Annotated[Number, Field(gt=0.0, le=1.0)] = key(
        "part of the face that bears load; 0.85 is ISO 10300's where nothing is known", 0.85
    )
    crowning: Literal["none", "low", "high"] = key(
        "load over the flank, by ISO 10300-2",
        "low",
        values={
            "none": "the same line load on all lines",
            "low": "falls to the edges, slowly over the profile: industrial and vehicle gears",
            "high": "falls to the edges, fast over the profile",
        },
    )
    youngs_modulus_GPa: Annotated[Pair, ranges()["gears.youngs_modulus_GPa"]] = key("Young's moduli", (206.0, 206.0))
    poisson_ratio: Annotated[Pair, ranges()["gears.poisson_ratio"]] = key("Poisson's ratios", (0.3, 0.3))

    @model_validator(mode="after")
    def _consistent(self) -> SkewGears:
        if min(self.teeth) < 3 or max(self.teeth) > 500:
            raise ValueError("teeth: each wheel has 3 to 500 teeth")
        if self.teeth[0] > self.teeth[1]:
            raise ValueError("teeth: the pinion, first, has no more teeth than the wheel")
        name, other = "wheel_outer_diameter_mm", "wheel_mean_diameter_mm"
        name, other = (other, name) if self.method == 2 else (name, other)
        if getattr(self, name) is None:
            raise ValueError(f"method {self.method} needs {name}")
        if getattr(self, other) is not None:
            raise ValueError(f"method {self.method} takes {name}; leave {other} out")
        if self.method == 0 and self.offset_mm > 0.0:
            raise ValueError(
                f"offset_mm {self.offset_mm:g}: method 0 is of gears without offset; take method 1, 2 or 3"
            )
        if (self.blade_groups is None) == (self.cutting == "face_hobbed"):
            raise ValueError("blade_groups: face_hobbed teeth need it, face_milled teeth have none")
        if self.shaft_angle_deg < 5.0:
            raise ValueError(f"shaft_angle_deg {self.shaft_angle_deg:g}: at least 5; `mixedlub gear` has parallel axes")
        if not all(5.0 <= angle <= 35.0 for angle in self.pressure_angle_deg):
            raise ValueError("pressure_angle_deg: both from 5 to 35")
        if self.dedendum < self.addendum:
            raise ValueError(f"dedendum {self.dedendum:g} must not be below addendum {self.addendum:g}")
        return self

    @property
    def basic(self) -> Basic:
        """Basic data in SI."""
        diameter = self.wheel_mean_diameter_mm if self.method == 2 else self.wheel_outer_diameter_mm
        assert diameter is not None
        return Basic(
            method=self.method,
            teeth=self.teeth,
            shaft_angle=math.radians(self.shaft_angle_deg),
            offset=self.offset_mm * 1e-3,
            wheel_diameter=diameter * 1e-3,
            face_width=self.wheel_face_width_mm * 1e-3,
            spiral=math.radians(self.spiral_angle_deg),
            cutter_radius=self.cutter_radius_mm * 1e-3,
            blade_groups=self.blade_groups or 0,
        )

    @property
    def tooth_data(self) -> ToothData:
        """Tooth data in SI."""
        drive, coast = map(math.radians, self.pressure_angle_deg)
        return ToothData(
            pressure_angle=(drive, coast),
            limit_share=self.limit_angle_share,
            profile_shift=self.profile_shift,
            addendum=self.addendum,
            dedendum=self.dedendum,
            thickness=self.thickness,
            wheel_angles=(math.radians(self.wheel_addendum_angle_deg), math.radians(self.wheel_dedendum_angle_deg)),
            backlash=self.backlash_mm * 1e-3,
        )


class Vary(Section):
    """One number of the pair at a time, others as given; conditions: the largest torque and speed, the last oil."""

    offset_mm: Numbers | None = key("offsets", None, example={"from": 0, "to": 40, "count": 9})
    spiral_angle_deg: Numbers | None = key("spiral angles", None, example={"from": 35, "to": 55, "count": 5})
    wheel_teeth: Annotated[tuple[Whole, ...], Field(min_length=1)] | None = key(
        "teeth of the wheel, and with them the ratio", None, example=[36, 42, 48, 54]
    )
    roughness_factor: Numbers | None = key("factors on the rms roughness of both flanks", None, example=[0.5, 1, 2])


class BevelFile(Section):
    """Bevel or hypoid pair with conditions, oil and surfaces."""

    schema_: Literal["mixedlub-bevel/1"] = key("format of the file", example="mixedlub-bevel/1", alias="schema")
    title: str = key("title of the figures", "Bevel gears", example="Hypoid axle")
    driving: Side = key("the side that drives", "pinion", values={"pinion": "the pinion", "gear": "the wheel"})
    flank: Literal["drive", "coast"] = key(
        "the flanks in contact",
        "drive",
        values={"drive": "the pinion's concave on the wheel's convex one", "coast": "the other two"},
    )
    boundary_friction: NotNegative = key("friction coefficient of touching asperities", 0.1)
    gears: SkewGears = key("the pair")
    conditions: Conditions = key("every torque at every speed and oil temperature")
    lubricant: Lubricant | None = key("what is left out is typical of the base stock, and a note says so", None)
    surfaces: Flanks = key("surfaces of both flanks")
    options: Options = key("laws of the contact, as in a study", Options())
    vary: Vary | None = key("efficiency over offset, spiral angle, ratio and roughness", None)

    @model_validator(mode="after")
    def _not_too_many(self) -> BevelFile:
        levels = self.conditions
        count = len(levels.torque_Nm) * len(levels.speed_rpm) * len(levels.oil_temperature_C)
        if count > MOST_CONDITIONS:
            raise ValueError(f"conditions: a map has at most {MOST_CONDITIONS} conditions, not {count}")
        return self


def altered(basic: Basic, name: str, value: float) -> Basic:
    """Basic data with one varied number in the unit of its key."""
    if name == "offset_mm":
        return replace(basic, offset=value * 1e-3)
    if name == "spiral_angle_deg":
        return replace(basic, spiral=math.radians(value))
    return replace(basic, teeth=(basic.teeth[0], int(value)))
