"""File of a worm drive: gears, friction, film, oil and conditions."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from mixedlub.schema.lubricant_section import Lubricant, Pair
from mixedlub.schema.ranges import ranges
from mixedlub.schema.section import Number, Section, Whole, key
from mixedlub.study.schema import Numbers, each_once

Positive = Annotated[Number, Field(gt=0.0)]
NotNegative = Annotated[Number, Field(ge=0.0)]
MOST_CONDITIONS = 100_000
"""Cost limit. Largest number of conditions of a map."""
PRESSURE_ANGLE = 20.0
"""Judgement. Normal pressure angle (deg) of a file without one: the usual angle of worms."""
ISO, AGMA, CONSTANT = "iso_tr_14521", "agma_6034", "constant"
COEFFICIENTS = ("constant", "gain", "shift_m_s", "exponent", "largest")
"""Numbers of the base friction in the form of ISO/TR 14521."""
FACTORS = ("size", "geometry", "roughness")


class Worm(Section):
    """Worm and wheel on axes at right angles."""

    threads: Annotated[Whole, Field(ge=1, le=20)] = key("threads of the worm", example=2)
    wheel_teeth: Annotated[Whole, Field(ge=10, le=1000)] = key("teeth of the wheel", example=41)
    axial_module_mm: Positive = key("module in the axial section of the worm", example=4.0)
    worm_diameter_mm: Positive = key("reference diameter of the worm", example=36.0)
    centre_distance_mm: Positive | None = key("distance of the axes; without it that of no profile shift", None)
    pressure_angle_deg: Annotated[Number, Field(ge=0.0, le=35.0)] | None = key(
        "normal pressure angle, which raises the friction angle; without it 20, but 0 with the law iso_tr_14521, "
        "whose mean friction contains the inclination",
        None,
        example=20.0,
    )
    worm_roughness_Ra_um: Positive | None = key("Ra of the worm, for a roughness factor", None, example=0.5)
    youngs_modulus_GPa: Annotated[Pair, ranges()["gears.youngs_modulus_GPa"]] = key(
        "moduli of worm and wheel, for the film", (206.0, 88.3)
    )
    poisson_ratio: Annotated[Pair, ranges()["gears.poisson_ratio"]] = key(
        "Poisson's ratios of worm and wheel, for the film", (0.3, 0.35)
    )

    @model_validator(mode="after")
    def _fits(self) -> Worm:
        if self.worm_diameter_mm < 2.5 * self.axial_module_mm:
            raise ValueError(
                f"worm_diameter_mm {self.worm_diameter_mm:g}: the roots of the threads leave no body below 2.5 "
                f"modules, {2.5 * self.axial_module_mm:g} mm"
            )
        shift = self.profile_shift
        if not -2.0 <= shift <= 2.0:
            middle = self.unshifted_distance_mm
            raise ValueError(
                f"centre_distance_mm {self.centre_distance_mm:g}: a profile shift of {shift:.4g} modules; from -2 to "
                f"2, that is from {middle - 2 * self.axial_module_mm:g} to {middle + 2 * self.axial_module_mm:g} mm"
            )
        return self

    @property
    def unshifted_distance_mm(self) -> float:
        """Centre distance without profile shift."""
        return 0.5 * (self.worm_diameter_mm + self.axial_module_mm * self.wheel_teeth)

    @property
    def distance_mm(self) -> float:
        """Centre distance."""
        return self.unshifted_distance_mm if self.centre_distance_mm is None else self.centre_distance_mm

    @property
    def profile_shift(self) -> float:
        """Profile shift of the wheel over module."""
        return (self.distance_mm - self.unshifted_distance_mm) / self.axial_module_mm


class Factor(Section):
    """Factor on the base friction: a value over its reference, to an exponent."""

    reference: Positive = key("value of the reference drive", example=100.0)
    exponent: Annotated[Number, Field(ge=-5.0, le=5.0)] = key("exponent of the value over the reference", example=-0.5)


class Friction(Section):
    """Mean friction coefficient of the mesh, the same in both directions of power."""

    law: Literal["iso_tr_14521", "agma_6034", "constant"] = key(
        "the law",
        AGMA,
        values={
            AGMA: "a steel worm on bronze, over the sliding speed",
            ISO: "the form of the standard with your numbers",
            CONSTANT: "one number",
        },
    )
    constant: NotNegative | None = key("friction at high speed, or the one number", None, example=0.02)
    gain: NotNegative | None = key("its rise towards low speed, in (m/s)^exponent", None, example=0.02)
    shift_m_s: NotNegative | None = key("speed added to the sliding speed", None, example=0.2)
    exponent: Annotated[Number, Field(ge=0.0, le=5.0)] | None = key("exponent of the speed", None, example=1.0)
    largest: Annotated[Number, Field(gt=0.0, le=1.0)] | None = key("largest base friction", None, example=0.1)
    material: Positive = key("factor of the materials and the oil supply", 1.0)
    size: Factor | None = key("of the centre distance (mm)", None)
    geometry: Factor | None = key("of the film parameter of [film]", None)
    roughness: Factor | None = key("of worm_roughness_Ra_um", None)

    @model_validator(mode="after")
    def _complete(self) -> Friction:
        given = {name for name in COEFFICIENTS if getattr(self, name) is not None}
        wanted = {ISO: set(COEFFICIENTS), AGMA: set(), CONSTANT: {"constant"}}[self.law]
        if missing := [name for name in COEFFICIENTS if name in wanted - given]:
            why = (
                ": no public source confirms the numbers of the standard, so those of your oil, wheel and oil supply "
                "are read from your copy of it"
            )
            raise ValueError(f"law {self.law!r} needs {', '.join(missing)}{why if self.law == ISO else ''}")
        if spare := [name for name in COEFFICIENTS if name in given - wanted]:
            raise ValueError(f"law {self.law!r} does not take {', '.join(spare)}; leave it out")
        factors = [name for name in FACTORS if getattr(self, name) is not None]
        if factors and self.law != ISO:
            raise ValueError(f"{factors[0]}: only law {ISO!r} has factors")
        return self

    @property
    def base(self) -> dict[str, float]:
        """Numbers of the base friction by the names of its law, 0 for the others."""
        values = {name: getattr(self, name) or 0.0 for name in COEFFICIENTS}
        return {name.removesuffix("_m_s"): value for name, value in values.items()}


class Film(Section):
    """Mean film in the form of ISO/TR 14521; its numbers are yours."""

    parameter: Positive = key("parameter h* of the geometry", example=0.07)
    coefficient: Positive = key(
        "coefficient for um, with m2/N, N s/m2, rpm, mm, N/mm2 and N m as the standard prints it", example=20.0
    )


class WormConditions(Section):
    """Every wheel torque at every worm speed and oil temperature."""

    wheel_torque_Nm: Numbers = key("torques on the wheel, driven or driving", example=[100, 200, 400])
    worm_speed_rpm: Numbers = key("speeds of the worm", example={"from": 100, "to": 3000, "count": 7})
    oil_temperature_C: Annotated[Numbers, ranges()["conditions.oil_temperature_C"]] = key(
        "temperatures of the oil, for the film", (60.0,)
    )

    @model_validator(mode="after")
    def _positive(self) -> WormConditions:
        for name in ("wheel_torque_Nm", "worm_speed_rpm", "oil_temperature_C"):
            values = getattr(self, name)
            try:
                each_once(values)
            except ValueError as error:
                raise ValueError(f"{name}: {error}") from None
            if name != "oil_temperature_C" and min(values) <= 0.0:
                raise ValueError(f"{name} {min(values):g}: above 0; both directions of power are computed")
        count = len(self.wheel_torque_Nm) * len(self.worm_speed_rpm) * len(self.oil_temperature_C)
        if count > MOST_CONDITIONS:
            raise ValueError(f"a map has at most {MOST_CONDITIONS} conditions, not {count}")
        return self


class WormFile(Section):
    """Worm drive with conditions, friction and oil."""

    schema_: Literal["mixedlub-worm/1"] = key("format of the file", example="mixedlub-worm/1", alias="schema")
    title: str = key("title of the figures", "Worm drive", example="Worm drive")
    gears: Worm = key("worm and wheel")
    friction: Friction = key("mean friction coefficient", Friction())
    film: Film | None = key("mean film; needs an oil", None)
    lubricant: Lubricant | None = key("what is left out is typical of the base stock, and a note says so", None)
    conditions: WormConditions = key("every torque at every speed and oil temperature")

    @model_validator(mode="after")
    def _has_what_factors_need(self) -> WormFile:
        if self.friction.geometry is not None and self.film is None:
            raise ValueError("friction.geometry: its value is parameter of [film], which is missing")
        if self.friction.roughness is not None and self.gears.worm_roughness_Ra_um is None:
            raise ValueError("friction.roughness: its value is worm_roughness_Ra_um of [gears], which is missing")
        if self.film is not None and self.lubricant is None:
            raise ValueError("film: needs the oil; add [lubricant]")
        return self

    @property
    def pressure_angle_deg(self) -> float:
        """Normal pressure angle that raises the friction angle."""
        given = self.gears.pressure_angle_deg
        usual = 0.0 if self.friction.law == ISO else PRESSURE_ANGLE
        return usual if given is None else given
